#include "wound/healthy_skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "wound/color.hpp"

namespace wound {
namespace {

using cv::Vec3f;

/// Lightness and two colour differences: with log r, g, b an illumination change moves only the first.
Vec3f features(const Vec3f& log_color)
{
    const Vec3f linear{std::exp(log_color[0]), std::exp(log_color[1]), std::exp(log_color[2])};
    return {std::log(luminance(linear)), log_color[0] - log_color[1], log_color[2] - log_color[1]};
}

float median(std::vector<float> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Robust centre and spread of the features of skin.
struct SkinModel
{
    Vec3f centre, spread;

    Vec3f deviation(const Vec3f& feature) const
    {
        Vec3f z = feature - centre;
        for (int k = 0; k < 3; ++k)
            z[k] /= spread[k];
        return z;
    }
};

/// Drops what no skin looks like (grey cloth, a wall, leaves), unless hardly anything would remain: then the
/// light was coloured.
void prefer_skin_colored(std::vector<Vec3f>& samples)
{
    std::vector<Vec3f> skin_colored;
    for (const Vec3f& sample : samples)
        if (sample[1] > .2f && sample[1] < 1.6f && sample[2] < .2f)
            skin_colored.push_back(sample);
    if (skin_colored.size() > samples.size() / 8)
        samples = std::move(skin_colored);
}

const Vec3f least_spread{.22f, .07f, .06f}, greatest_spread{.45f, .22f, .16f};

/// Median and median deviation, refitted without what lies far off (background, shadow, clothes).
SkinModel fit(std::vector<Vec3f> samples)
{
    SkinModel model{{}, greatest_spread};
    for (int round = 0; round < 3; ++round) {
        for (int k = 0; k < 3; ++k) {
            std::vector<float> values;
            for (const Vec3f& sample : samples)
                values.push_back(sample[k]);
            model.centre[k] = median(values);
            for (float& value : values)
                value = std::abs(value - model.centre[k]);
            model.spread[k] = std::clamp(1.4826f * median(values), least_spread[k], greatest_spread[k]);
        }
        std::vector<Vec3f> kept;
        for (const Vec3f& sample : samples)
            if (cv::norm(model.deviation(sample)) < 3)
                kept.push_back(sample);
        if (kept.size() < samples.size() / 3)
            break; // nothing holds together: keep the plain median
        samples = std::move(kept);
    }
    return model;
}

/// Deviation from healthy skin after the best allowance for more or less blood.
float deviation_but_for_blood(const SkinModel& model, const Vec3f& log_color)
{
    const Vec3f z = model.deviation(features(log_color));
    Vec3f along = model.deviation(features(log_color - blood_absorbance)) - z;
    const float amount = std::clamp(-z.dot(along) / along.dot(along), -2.2f, 1.f);
    return float(cv::norm(z + along * amount));
}

/// Cells of `region` that can be reached from the wound through cells of it.
cv::Mat1b reachable(const cv::Mat1b& region, const cv::Mat1b& wound)
{
    cv::Mat1i labels;
    const int count = cv::connectedComponents(region | wound, labels, 4);
    std::vector<bool> touches(std::size_t(count), false);
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
            if (wound(y, x))
                touches[labels(y, x)] = true;
    cv::Mat1b result(region.size());
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
            result(y, x) = labels(y, x) && touches[labels(y, x)] ? 255 : 0;
    return result;
}

float smooth(float low, float high, float x)
{
    const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
    return t * t * (3 - 2 * t);
}

constexpr float darkest_skin =
    -4.2f; // log luminance; below is shadow, hair, clothes or the photo's black frame

} // namespace

HealthySkin find_healthy_skin(const cv::Mat3f& log_color, const cv::Mat1f& coverage, const cv::Mat1f& valid,
                              float reach)
{
    const int n = healthy_skin_grid;
    const cv::Mat1b wound = coverage > .5f;
    cv::Mat1f from_wound;
    cv::distanceTransform(~wound, from_wound, cv::DIST_L2, cv::DIST_MASK_5);

    const auto usable = [&](int x, int y) {
        return valid(y, x) > .98f && features(log_color(y, x))[0] > darkest_skin && x > 1 && y > 1 &&
               x < n - 2 && y < n - 2;
    };
    std::vector<Vec3f> samples;
    cv::Mat1b skin(n, n, uchar(0));
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (coverage(y, x) < .02f && usable(x, y)) {
                skin(y, x) = 255;
                if (from_wound(y, x) > .2f * reach && from_wound(y, x) < 1.3f * reach)
                    samples.push_back(features(log_color(y, x)));
            }
    prefer_skin_colored(samples);

    HealthySkin result{samples.size() > 40, Vec3f::all(0), cv::Mat1f(n, n), cv::Mat1f(n, n, 0.f),
                       cv::Mat1f(n, n, 1.f)};
    if (result.found) {
        const SkinModel model = fit(samples);
        cv::Mat1f within;
        cv::distanceTransform(wound, within, cv::DIST_L2, cv::DIST_MASK_5);
        std::array<std::vector<float>, 3> healthy;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                if (wound(y, x)) {
                    const float off = float(cv::norm(model.deviation(features(log_color(y, x)))));
                    result.rawness(y, x) =
                        std::max(smooth(1.2f, 2.6f, off), smooth(.1f * reach, .5f * reach, within(y, x)));
                } else if (skin(y, x)) {
                    const float near =
                        std::exp(-from_wound(y, x) / (.3f * reach)); // anything may be seen at the rim
                    if (deviation_but_for_blood(model, log_color(y, x)) > 3 + 4 * near)
                        skin(y, x) = 0;
                    const float off = float(cv::norm(model.deviation(features(log_color(y, x)))));
                    result.health(y, x) = off < 3.5f ? std::exp(-.5f * off * off) : 0;
                    if (off < 1.5f)
                        for (int k = 0; k < 3; ++k)
                            healthy[k].push_back(log_color(y, x)[k]);
                }
        for (int k = 0; k < 3; ++k)
            result.log_color[k] = healthy[k].empty() ? 0 : median(healthy[k]);
        result.found = !healthy[0].empty();
    }
    // Specks (a hair, a glint) must not punch holes: closing fills them.
    cv::morphologyEx(skin | wound, skin, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (valid(y, x) < .98f || x < 2 || y < 2 || x >= n - 2 || y >= n - 2)
                skin(y, x) = 0;
    skin = reachable(skin, wound);

    cv::Mat1f to_end;
    cv::distanceTransform(skin & (from_wound < reach), to_end, cv::DIST_L2, cv::DIST_MASK_5);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const float d = from_wound(y, x);
            result.outwardness(y, x) = wound(y, x) ? 0 : d / (d + to_end(y, x));
            result.health(y, x) *=
                skin(y, x) && !wound(y, x) ? smooth(.15f, .7f, result.outwardness(y, x)) : 0;
        }
    cv::GaussianBlur(result.outwardness, result.outwardness, {5, 5}, 1);
    cv::GaussianBlur(result.rawness, result.rawness, {5, 5}, 1);
    return result;
}

} // namespace wound
