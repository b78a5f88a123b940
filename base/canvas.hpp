// What charts are drawn on: a few shapes in pixels, x to the right, y down, whole numbers between pixels.
// There is one canvas that writes SVG and one that draws into a picture. Both get the same coordinates, so
// that a chart looks the same on either; the widths of texts come from text_width() (base/draw_text.hpp) for
// both.
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
    /// Tooltips appear under the pointer, where there is one.
    virtual void rect(const cv::Rect2d& area, const Fill& fill, std::string_view tooltip = {}) = 0;
    virtual void circle(cv::Point2d center, double radius, const Fill& fill,
                        std::string_view tooltip = {}) = 0;
    virtual void polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke) = 0;
    virtual void polygon(const std::vector<cv::Point2d>& points, const Fill& fill) = 0;
    /// `at`: where the anchor is on the base line.
    virtual void text(cv::Point2d at, const std::string& text, const TextStyle& style) = 0;

    void line(cv::Point2d from, cv::Point2d to, const Stroke& stroke) { polyline({from, to}, stroke); }
};

enum class SvgUse : std::uint8_t
{
    InPage,     // an element of an HTML page that has css_variables() in its style sheet
    StandAlone, // a file of its own, on white
};

class SvgCanvas final : public Canvas
{
  public:
    /// `description` says what the picture shows to those who cannot see it. In a narrower window it shrinks.
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
