// Drawing a chart as SVG inside a page. Colours are CSS: "var(--c0)", "currentColor".
#pragma once
#include <string>
#include <string_view>

namespace base {

/// &, <, > and quotes as HTML wants them.
std::string escaped(std::string_view text);

class Svg
{
  public:
    /// Pixels; narrower windows shrink it. `label` says to those who cannot see it what it shows.
    Svg(double width, double height, std::string_view label);

    /// `title` appears under the pointer. Sizes below a tenth of a pixel are drawn as that.
    void rect(double x, double y, double width, double height, std::string_view fill,
              std::string_view title = {}, double opacity = 1);
    void line(double x0, double y0, double x1, double y1, std::string_view stroke, double width = 1);
    void circle(double x, double y, double radius, std::string_view fill, double opacity = 1);
    /// `anchor`: start, middle, end.
    void text(double x, double y, std::string_view text, std::string_view anchor = "start",
              std::string_view fill = "currentColor");
    std::string finished() const { return svg_ + "</svg>\n"; }

  private:
    std::string svg_;
};

} // namespace base
