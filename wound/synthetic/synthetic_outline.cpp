#include "wound/synthetic/synthetic_outline.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace wound {
namespace {

using cv::Point2f;

/// Distance to an ellipse about the origin, mm, positive inside; exact on the outline, first order near it.
float ellipse(Point2f p, float a, float b)
{
    const float u = p.x / a, v = p.y / b;
    const float k = std::sqrt(u * u + v * v), slope = std::sqrt(u * u / (a * a) + v * v / (b * b));
    return slope > 0 ? (1 - k) * k / slope : std::min(a, b);
}

/// Distance to a tear from `from` to `to` whose half-width falls from `wide` to `narrow`, mm, positive
/// inside.
float tear(Point2f p, Point2f from, Point2f to, float wide, float narrow)
{
    const Point2f axis = to - from, away = p - from;
    const float t = std::clamp(away.dot(axis) / axis.dot(axis), 0.f, 1.f);
    const Point2f rest = away - t * axis;
    return std::lerp(wide, narrow, t) - std::sqrt(rest.dot(rest));
}

/// Union with the inner corner rounded over about k mm (Quilez 2013, polynomial smooth maximum).
float merge(float a, float b, float k)
{
    const float h = std::max(k - std::abs(a - b), 0.f) / k;
    return std::max(a, b) + h * h * k / 4;
}

Point2f turned(Point2f p, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// Factor on the border's deviation from a smooth line: a cut has straighter lips than a graze.
float raggedness(const SyntheticWound& wound)
{
    return wound.shape == WoundShape::Laceration ? .45f : 1;
}

/// Signed distance to the smooth shape, before its border is bent and torn; mm, positive inside.
float body(const SyntheticWound& wound, Point2f p)
{
    const auto vary = [&](int index, float low, float high) {
        return std::lerp(low, high, hash01(wound.seed, index, 71));
    };
    switch (wound.shape) {
    case WoundShape::Laceration: {
        p = turned(p, vary(0, -.15f, .25f));
        const float along = p.x / vary(1, 16, 18), bend = vary(2, -.014f, -.006f);
        const float half_width = vary(3, 2.4f, 3.2f) * (1 - along * along) * (1 + .3f * along);
        const float cut = half_width - std::abs(p.y - bend * p.x * p.x);
        return merge(cut, tear(p, {vary(4, 1, 5), 0}, {vary(5, 6, 9), vary(6, 5, 7)}, 1.5f, .2f), 2);
    }
    case WoundShape::Avulsion: {
        float f = ellipse(p, vary(0, 7, 8.5f), vary(1, 5.5f, 7));
        for (int lobe = 0; lobe < 3; ++lobe) {
            const float angle = 2.1f * float(lobe) + vary(2 + lobe, 0, 1.4f);
            const Point2f centre = turned({vary(6 + lobe, 4.5f, 7.5f), 0}, angle);
            f = merge(f, ellipse(turned(p - centre, -angle), vary(10 + lobe, 3, 5), vary(14 + lobe, 2, 3.5f)),
                      3);
        }
        const float angle = vary(20, 0, 6.28f);
        return merge(f, tear(p, turned({4, 0}, angle), turned({vary(21, 11, 13), 2}, angle), 2.6f, .3f), 2);
    }
    case WoundShape::Abrasion:
        break;
    }
    p = turned(p, vary(0, .2f, .6f));
    const float oval = ellipse(p, vary(1, 11.5f, 12.5f), vary(2, 7.8f, 9));
    const float lobe = ellipse(turned(p - Point2f{vary(3, -9, -6), vary(4, 3, 6)}, .5f), 5.5f, 3.6f);
    return merge(merge(oval, lobe, 4), tear(p, {8, -3}, {vary(5, 13, 15), vary(6, -7, -4)}, 3.2f, .4f), 3);
}

/// The body bent at large and middle scale.
float bent_body(const SyntheticWound& wound, const Noise& noise, Point2f p)
{
    const Point2f large{noise.at(p * .11f + Point2f{3, 1}), noise.at(p * .11f + Point2f{9, 7})};
    const Point2f middle{noise.at(p * .34f + Point2f{21, 2}), noise.at(p * .34f + Point2f{5, 13})};
    return body(wound, p + raggedness(wound) * (1.9f * large + .75f * middle));
}

/// Small-scale tears, added to the distance, mm; torn and smooth stretches alternate along the border.
float tears(const Noise& noise, Point2f p)
{
    const float ragged = std::clamp(.55f + 1.1f * noise.at(p * .13f + Point2f{11, 19}), .1f, 1.f);
    const Point2f q = turned(p, .8f);
    const float notch = 1 - std::abs(noise.at(q * .33f + Point2f{2, 23}));
    return ragged * (1.1f * noise.sum(q * .6f, 4, .6f) - 2.5f * std::max(notch - .8f, 0.f));
}

/// bent_body() at every `sample_step`th pixel, with one more row and column than needed to interpolate.
constexpr int sample_step = 4;
cv::Mat1f coarse_body(const SyntheticWound& wound, const Noise& noise)
{
    const int nodes = wound.size / sample_step + 2;
    cv::Mat1f coarse(nodes, nodes);
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i)
            coarse(j, i) =
                bent_body(wound, noise,
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

cv::Mat1f outline_distance(const SyntheticWound& wound, const Noise& noise)
{
    const int n = wound.size;
    const cv::Mat1f coarse = coarse_body(wound, noise);
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
                    f += raggedness(wound) * tears(noise, synthetic_position_mm(float(x), float(y), n));
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
