#include "wound/photo/healthy_skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "base/smoothstep.hpp"

namespace wound {
namespace {

using cv::Vec3f;

/// Log luminance, log r/g and log b/g: a change of illumination strength changes only the first.
Vec3f features(const Vec3f& log_color)
{
    const Vec3f linear{std::exp(log_color[0]), std::exp(log_color[1]), std::exp(log_color[2])};
    return {std::log(base::luminance(linear)), log_color[0] - log_color[1], log_color[2] - log_color[1]};
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

/// Removes samples without skin colour (grey cloth, a wall, leaves), unless less than an eighth would remain:
/// then the light is coloured.
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

/// Median and median absolute deviation, refitted without outliers (background, shadow, clothes).
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
            break; // no cluster: keep the current median
        samples = std::move(kept);
    }
    return model;
}

/// Deviation from healthy skin after subtracting the best-fitting amount of blood.
float deviation_but_for_blood(const SkinModel& model, const Vec3f& log_color)
{
    const Vec3f z = model.deviation(features(log_color));
    Vec3f along = model.deviation(features(log_color - blood_absorbance)) - z;
    const float amount = std::clamp(-z.dot(along) / along.dot(along), -2.2f, 1.f);
    return float(cv::norm(z + along * amount));
}

/// 255 in cells of `region` and `wound` that are connected to the wound.
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

constexpr float darkest_skin =
    -4.2f; // log luminance; darker cells are shadow, hair, clothes or the photo's black frame

/// The inputs of the steps below.
struct Surroundings
{
    const cv::Mat3f& log_color;
    const cv::Mat1f &coverage, &valid;
    float reach;
    cv::Mat1b wound;
    cv::Mat1f outside, within; // distances to the wound's border from outside and inside, cells

    bool has_data(int x, int y) const
    {
        const int last = wound.rows - 3; // excludes a frame of two cells
        return valid(y, x) > .98f && x > 1 && y > 1 && x <= last && y <= last;
    }
    bool may_be_skin(int x, int y) const
    {
        return coverage(y, x) < .02f && has_data(x, y) && features(log_color(y, x))[0] > darkest_skin;
    }
};

std::vector<Vec3f> skin_samples(const Surroundings& around)
{
    std::vector<Vec3f> samples;
    for (int y = 0; y < around.wound.rows; ++y)
        for (int x = 0; x < around.wound.cols; ++x)
            if (around.may_be_skin(x, y) && around.outside(y, x) > .2f * around.reach &&
                around.outside(y, x) < 1.3f * around.reach)
                samples.push_back(features(around.log_color(y, x)));
    prefer_skin_colored(samples);
    return samples;
}

/// Fills `skin.health`, `skin.rawness` and `skin.foreignness`; returns 255 in cells outside the wound that
/// are healthy or inflamed skin.
cv::Mat1b judge(const Surroundings& around, const SkinModel& model, HealthySkin& skin)
{
    cv::Mat1b is_skin(around.wound.size(), uchar(0));
    for (int y = 0; y < is_skin.rows; ++y)
        for (int x = 0; x < is_skin.cols; ++x) {
            const Vec3f& color = around.log_color(y, x);
            const float off = float(cv::norm(model.deviation(features(color))));
            if (around.wound(y, x)) {
                const float inner =
                    base::smoothstep(.1f * around.reach, .5f * around.reach, around.within(y, x));
                skin.rawness(y, x) = std::max(base::smoothstep(1.2f, 2.6f, off), inner);
            } else if (around.may_be_skin(x, y)) {
                const float foreign = deviation_but_for_blood(model, color);
                const float near = std::exp(-around.outside(y, x) / (.3f * around.reach));
                is_skin(y, x) = foreign < 3 + 4 * near ? 255 : 0; // tolerates more deviation near the rim
                skin.health(y, x) = off < 3.5f ? std::exp(-.5f * off * off) : 0;
                skin.foreignness(y, x) = base::smoothstep(2.2f, 4, foreign) *
                                         base::smoothstep(.35f, .1f, around.outside(y, x) / around.reach);
            }
        }
    return is_skin;
}

/// Median over the cells of health above .3; false if there are none.
bool find_color(const cv::Mat3f& log_color, const cv::Mat1f& health, Vec3f& color)
{
    for (int k = 0; k < 3; ++k) {
        std::vector<float> values;
        for (int y = 0; y < health.rows; ++y)
            for (int x = 0; x < health.cols; ++x)
                if (health(y, x) > .3f)
                    values.push_back(log_color(y, x)[k]);
        if (values.empty())
            return false;
        color[k] = median(std::move(values));
    }
    return true;
}

/// Skin connected to the wound, after closing specks (a hair, a highlight).
cv::Mat1b continuous_skin(const Surroundings& around, const cv::Mat1b& is_skin)
{
    cv::Mat1b skin;
    cv::morphologyEx(is_skin | around.wound, skin, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
    for (int y = 0; y < skin.rows; ++y)
        for (int x = 0; x < skin.cols; ++x)
            if (!around.has_data(x, y))
                skin(y, x) = 0;
    return reachable(skin, around.wound);
}

} // namespace

HealthySkin find_healthy_skin(const cv::Mat3f& log_color, const cv::Mat1f& coverage, const cv::Mat1f& valid,
                              float reach)
{
    const int n = healthy_skin_grid;
    Surroundings around{log_color, coverage, valid, reach, coverage > .5f, {}, {}};
    cv::distanceTransform(~around.wound, around.outside, cv::DIST_L2, cv::DIST_MASK_5);
    cv::distanceTransform(around.wound, around.within, cv::DIST_L2, cv::DIST_MASK_5);

    HealthySkin skin;
    skin.outwardness = cv::Mat1f(n, n, 1.f);
    skin.health = cv::Mat1f(n, n, 0.f);
    skin.foreignness = cv::Mat1f(n, n, 0.f);
    skin.rawness = cv::Mat1f(n, n, 1.f);
    std::vector<Vec3f> samples = skin_samples(around);
    if (static_cast<double>(samples.size()) < least_skin * n * n)
        return skin;
    const cv::Mat1b connected = continuous_skin(around, judge(around, fit(std::move(samples)), skin));

    cv::Mat1f to_end;
    cv::distanceTransform(connected & (around.outside < reach), to_end, cv::DIST_L2, cv::DIST_MASK_5);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const float d = around.outside(y, x);
            skin.outwardness(y, x) = around.wound(y, x) ? 0 : d / (d + to_end(y, x));
            skin.health(y, x) *= connected(y, x) ? base::smoothstep(.15f, .7f, skin.outwardness(y, x)) : 0;
        }
    cv::GaussianBlur(skin.outwardness, skin.outwardness, {5, 5}, 1);
    cv::GaussianBlur(skin.rawness, skin.rawness, {9, 9}, 2);
    cv::GaussianBlur(skin.foreignness, skin.foreignness, {7, 7}, 1.4);
    skin.found = find_color(log_color, skin.health, skin.log_color);
    return skin;
}

} // namespace wound
