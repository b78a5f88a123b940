#include "base/draw_text.hpp"

#include <opencv2/imgproc.hpp>

namespace base {
namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double font_height = 22; // px, of a capital letter at scale 1

} // namespace

double text_width(const std::string& text, double height)
{
    int baseline = 0;
    return text.empty() ? 0 : cv::getTextSize(text, font, height / font_height, 1, &baseline).width;
}

void draw_text(cv::Mat3b& picture, const std::string& text, cv::Point at, const TextStyle& style)
{
    if (style.anchor != Anchor::Start) {
        const double width = text_width(text, style.height);
        at.x -= cvRound(style.anchor == Anchor::Middle ? width / 2 : width);
    }
    cv::putText(picture, text, at, font, style.height / font_height, scalar_of(style.paint), 1, cv::LINE_AA);
}

} // namespace base
