#include "wound/synthetic/synthetic_outline.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace wound {

using cv::Point2f;

float vary(std::uint32_t seed, int index, float low, float high)
{
    return std::lerp(low, high, hash01(seed, index, 71));
}

Point2f turned(Point2f p, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

float ellipse(Point2f p, float a, float b)
{
    const float u = p.x / a, v = p.y / b;
    const float k = std::sqrt(u * u + v * v), slope = std::sqrt(u * u / (a * a) + v * v / (b * b));
    return slope > 0 ? (1 - k) * k / slope : std::min(a, b);
}

float tear(Point2f p, Point2f from, Point2f to, float wide, float narrow)
{
    const Point2f axis = to - from, away = p - from;
    const float t = std::clamp(away.dot(axis) / axis.dot(axis), 0.f, 1.f);
    const Point2f rest = away - t * axis;
    return std::lerp(wide, narrow, t) - std::sqrt(rest.dot(rest));
}

float merge(float a, float b, float k)
{
    const float h = std::max(k - std::abs(a - b), 0.f) / k;
    return std::max(a, b) + h * h * k / 4;
}

namespace {

/// The kind's shape bent at large and middle scale.
float bent_shape(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise, Point2f p)
{
    const Point2f large{noise.at(p * .11f + Point2f{3, 1}), noise.at(p * .11f + Point2f{9, 7})};
    const Point2f middle{noise.at(p * .34f + Point2f{21, 2}), noise.at(p * .34f + Point2f{5, 13})};
    return kind.shape(wound.seed, p + kind.raggedness * (1.9f * large + .75f * middle));
}

/// Small-scale tears, added to the distance, mm; torn and smooth stretches alternate along the border.
float tears(const Noise& noise, Point2f p)
{
    const float ragged = std::clamp(.55f + 1.1f * noise.at(p * .13f + Point2f{11, 19}), .1f, 1.f);
    const Point2f q = turned(p, .8f);
    const float notch = 1 - std::abs(noise.at(q * .33f + Point2f{2, 23}));
    return ragged * (1.1f * noise.sum(q * .6f, 4, .6f) - 2.5f * std::max(notch - .8f, 0.f));
}

/// bent_shape() at every `sample_step`th pixel, with one more row and column than needed to interpolate.
constexpr int sample_step = 4;
cv::Mat1f coarse_shape(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise)
{
    const int nodes = wound.size / sample_step + 2;
    cv::Mat1f coarse(nodes, nodes);
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i)
            coarse(j, i) =
                bent_shape(kind, wound, noise,
                           synthetic_position_mm(float(i * sample_step), float(j * sample_step), wound.size));
    return coarse;
}

/// The largest connected region of a binary image, its holes filled.
cv::Mat1b largest_region(const cv::Mat1b& binary)
{
    cv::Mat1i labels;
    cv::Mat stats, centroids;
    const int count = cv::connectedComponentsWithStats(binary, labels, stats, centroids, 4);
    int largest = 1;
    for (int label = 2; label < count; ++label)
        if (stats.at<int>(label, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA))
            largest = label;
    cv::Mat1b outside = labels != largest;
    cv::floodFill(outside, cv::Point{0, 0}, 128, nullptr, 0, 0, 4);
    return outside != 128;
}

} // namespace

cv::Mat1f outline_distance(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise)
{
    const int n = wound.size;
    const cv::Mat1f coarse = coarse_shape(kind, wound, noise);
    cv::Mat1b inside(n, n, uchar(0));
    const int margin = n / 12; // no shape reaches into this margin
    cv::parallel_for_({margin, n - margin}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = margin; x < n - margin; ++x) {
                const int i = x / sample_step, j = y / sample_step;
                const float u = float(x % sample_step) / sample_step,
                            v = float(y % sample_step) / sample_step;
                float f = std::lerp(std::lerp(coarse(j, i), coarse(j, i + 1), u),
                                    std::lerp(coarse(j + 1, i), coarse(j + 1, i + 1), u), v);
                if (std::abs(f) < 3) // farther away, tears cannot change the sign
                    f += kind.raggedness * tears(noise, synthetic_position_mm(float(x), float(y), n));
                inside(y, x) = f > 0 ? 255 : 0;
            }
    });
    inside = largest_region(inside);

    cv::Mat1f within, without, distance;
    cv::distanceTransform(inside, within, cv::DIST_L2, cv::DIST_MASK_5);
    cv::distanceTransform(~inside, without, cv::DIST_L2, cv::DIST_MASK_5);
    cv::subtract(within, without, distance); // +-1 next to the outline, which runs between pixels
    cv::GaussianBlur(distance, distance, {5, 5}, 1.1);
    return distance * (synthetic_width_mm / n);
}

} // namespace wound
