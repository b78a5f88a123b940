// The drawing surface of charts. Coordinates are in pixels, x right, y down; integers are pixel borders.
// SvgCanvas writes SVG and PictureCanvas draws into a picture. Both receive the same coordinates and take
// text widths from text_width() (base/draw_text.hpp), so a chart looks the same on both.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/draw_text.hpp"
#include "base/palette.hpp"

namespace base {

struct Stroke
{
    Paint paint = palette::ink;
    double width = 1; // px
};

struct Fill
{
    Paint paint = palette::ink;
    double opacity = 1;
};

class Canvas
{
  public:
    virtual ~Canvas() = default;
    /// SVG shows `tooltip` under the mouse pointer; a picture ignores it.
    virtual void rect(const cv::Rect2d& area, const Fill& fill, std::string_view tooltip = {}) = 0;
    virtual void circle(cv::Point2d center, double radius, const Fill& fill,
                        std::string_view tooltip = {}) = 0;
    virtual void polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke) = 0;
    virtual void polygon(const std::vector<cv::Point2d>& points, const Fill& fill) = 0;
    /// `at`: the position of the text's anchor on the baseline.
    virtual void text(cv::Point2d at, const std::string& text, const TextStyle& style) = 0;

    void line(cv::Point2d from, cv::Point2d to, const Stroke& stroke) { polyline({from, to}, stroke); }
};

enum class SvgUse : std::uint8_t
{
    InPage,     // an element of an HTML page whose style sheet contains css_variables()
    StandAlone, // a separate file with a white background
};

class SvgCanvas final : public Canvas
{
  public:
    /// `description` is read aloud by screen readers. In a page, the picture shrinks with a narrow window.
    SvgCanvas(cv::Size2d size, std::string_view description, SvgUse use);

    void rect(const cv::Rect2d& area, const Fill& fill, std::string_view tooltip = {}) override;
    void circle(cv::Point2d center, double radius, const Fill& fill, std::string_view tooltip = {}) override;
    void polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke) override;
    void polygon(const std::vector<cv::Point2d>& points, const Fill& fill) override;
    void text(cv::Point2d at, const std::string& text, const TextStyle& style) override;

    std::string finished() const { return svg_ + "</svg>\n"; }

  private:
    std::string css(Paint paint) const;
    std::string attributes(const Fill& fill) const;
    void close(std::string_view element, std::string_view tooltip);

    SvgUse use_;
    std::string svg_;
};

/// Draws into the caller's picture (RGB), which must outlive it.
class PictureCanvas final : public Canvas
{
  public:
    explicit PictureCanvas(cv::Mat3b& picture) : picture_(picture) {}

    void rect(const cv::Rect2d& area, const Fill& fill, std::string_view tooltip = {}) override;
    void circle(cv::Point2d center, double radius, const Fill& fill, std::string_view tooltip = {}) override;
    void polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke) override;
    void polygon(const std::vector<cv::Point2d>& points, const Fill& fill) override;
    void text(cv::Point2d at, const std::string& text, const TextStyle& style) override;

  private:
    void stroke(const std::vector<cv::Point2d>& points, double radius, const Fill& fill);

    cv::Mat3b& picture_;
};

} // namespace base
