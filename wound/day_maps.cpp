#include "wound/day_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/color.hpp"
#include "base/sampling.hpp"
#include "base/smoothstep.hpp"

namespace wound {

namespace {

constexpr double occlusion_reach_mm = 4;
constexpr double filled_ratio = .25; // of the area; a smaller bed lies ever less deep: our choice
constexpr double bump_mm = .25; // height of the bed for e times the luminance: our choice, by photographs
constexpr double bump_reach_mm = .25; // slopes between points twice as far apart show bumps of 1 mm best
constexpr double slope_limit =
    .7; // no slope is steeper than 1.4, so that walls do not turn into mirrors of lights
constexpr double soft_edge_mips = 3; // blurs the border of new skin by about 1 mm
constexpr double patch_mips = 2.5;   // blurs the bed so that clot and slough come in patches with soft edges

/// The day-0 position of a point of today.
struct Origin
{
    cv::Point2d uv;
    double mip; // mip level for the several day-0 texels that contraction squeezes into one of today's
};

Origin origin_of(cv::Point2d today, const Warp& warp)
{
    const cv::Point2d day0 = warp.apply(today);
    const double squeeze = cv::norm(day0 - warp.centroid) / std::max(cv::norm(today - warp.centroid), 1e-6);
    return {(day0 + cv::Point2d(1, 1)) * .5, std::log2(std::max(squeeze, 1.))};
}

/// Fills today's colour and state texel by texel.
class Warping
{
  public:
    Warping(const Patch& patch, const WoundDay& today)
        : today_(today), bed_apart_(today.unhealed_ratio != today.border_ratio),
          bed_luminance_(bed_luminance(patch)), color_(base::mip_levels(day0_color(patch))),
          shape_(base::mip_levels(day0_shape(patch)))
    {
    }

    void fill(cv::Point2d patch_point, cv::Vec4f& color_today, cv::Vec4f& state_today) const
    {
        const Origin border = origin_of(patch_point, today_.border_warp);
        cv::Vec4d color = base::sample<4>(color_, border.uv, border.mip);
        cv::Vec2d border_shape = base::sample<2>(shape_, border.uv, border.mip);
        cv::Vec2d bed_shape = border_shape;
        if (bed_apart_) {
            const Origin bed = origin_of(patch_point, today_.bed_warp);
            bed_shape = base::sample<2>(shape_, bed.uv, bed.mip);
        }
        if (today_.in_phases) {
            const cv::Vec2d soft = base::sample_smooth<2>(shape_, border.uv, border.mip + soft_edge_mips);
            border_shape += today_.border_softness * (soft - border_shape);
            const cv::Vec4d around = base::sample<4>(color_, border.uv, border.mip + patch_mips);
            const cv::Vec3d day0(color[0], color[1], color[2]),
                turned = tinted(day0, {around[0], around[1], around[2]}, today_.phase, bed_luminance_);
            for (int c = 0; c < 3; ++c)
                color[c] = std::lerp(day0[c], turned[c], bed_shape[1]);
            color[3] *= std::lerp(today_.phase.rim, 1., border_shape[1]);
        }
        color_today = color;
        state_today =
            cv::Vec4d(bed_shape[0], border_shape[0], bed_shape[1] * today_.bed_presence, border_shape[1]);
    }

  private:
    const WoundDay& today_;
    bool bed_apart_; // the bed has another warp than the border
    double bed_luminance_;
    std::vector<cv::Mat> color_, shape_; // of day 0, with mip levels
};

/// Horizon-based ambient occlusion over six directions, 1 open. cos^2 of the horizon's elevation is the
/// cosine-weighted share of the sky that is visible in a direction's slice.
double openness(const cv::Mat1f& depth_mm, cv::Point at, const shared::Relief& relief)
{
    constexpr int directions = 6, steps = 4;
    const double here = depth_mm(at);
    double open = 0;
    for (int k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * (k + .5) / directions;
        double steepest = 0; // tangent of the horizon's elevation
        for (int step = 1; step <= steps; ++step) {
            const double texels = double(relief.reach_texels) * (step * step) / (steps * steps);
            const int x = at.x + cvRound(std::cos(angle) * texels),
                      y = at.y + cvRound(std::sin(angle) * texels);
            const double there =
                depth_mm(std::clamp(y, 0, depth_mm.rows - 1), std::clamp(x, 0, depth_mm.cols - 1));
            steepest = std::max(steepest, (here - there) / (std::max(texels, 1.) * relief.texel_mm));
        }
        open += 1 / (1 + steepest * steepest);
    }
    return open / directions;
}

/// ln of the mean luminance of the four texels around a corner of `at`, which lies towards `side` (-1 or 1
/// each).
double log_luminance(const cv::Mat4f& color, cv::Point at, cv::Point side, int reach)
{
    double sum = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const cv::Vec4f& texel = color(std::clamp(at.y + side.y * (reach + j), 0, color.rows - 1),
                                           std::clamp(at.x + side.x * (reach + i), 0, color.cols - 1));
            sum += .25 * double(base::luminance(cv::Vec3f(texel.val)));
        }
    return std::log(std::max(sum, 1e-3));
}

/// Slope of the bed's bumps where it is as high as it is light: pits of granulation tissue are dark. As of a
/// depth.
cv::Vec2d bump_slope(const cv::Mat4f& color, cv::Point at, const shared::Relief& relief)
{
    const int reach = static_cast<int>(relief.bump_texels);
    const auto corner = [&](int x, int y) { return log_luminance(color, at, {x, y}, reach); };
    const double a = corner(-1, -1), b = corner(1, -1), c = corner(-1, 1), d = corner(1, 1);
    const double per_mm = relief.bump_mm / (4 * double(relief.bump_texels) * relief.texel_mm);
    return per_mm * cv::Vec2d(a + c - b - d, a + b - c - d);
}

cv::Mat4f relief_of(const cv::Mat4f& color, const cv::Mat4f& state, const shared::Relief& parameters)
{
    cv::Mat1f depth_mm(state.size());
    std::transform(state.begin(), state.end(), depth_mm.begin(), [&](const cv::Vec4f& s) {
        return parameters.depth_scale * s[0] - parameters.scar_mm * std::max(s[3] - s[2], 0.f);
    });
    cv::Mat1f along_u, along_v, open(state.size());
    const double per_mm = 1 / (8. * parameters.texel_mm); // 8: the sum of Sobel's weights on either side
    cv::Sobel(depth_mm, along_u, CV_32F, 1, 0, 3, per_mm, 0, cv::BORDER_REPLICATE);
    cv::Sobel(depth_mm, along_v, CV_32F, 0, 1, 3, per_mm, 0, cv::BORDER_REPLICATE);
    cv::parallel_for_({0, state.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < state.cols; ++x) {
                open(y, x) = static_cast<float>(openness(depth_mm, {x, y}, parameters));
                cv::Vec2d slope(along_u(y, x), along_v(y, x));
                if (const double bed = state(y, x)[2]; bed > 0 && parameters.bump_mm > 0)
                    slope += bed * bump_slope(color, {x, y}, parameters);
                slope /= 1 + double(parameters.slope_limit) * cv::norm(slope);
                along_u(y, x) = static_cast<float>(slope[0]);
                along_v(y, x) = static_cast<float>(slope[1]);
            }
    });
    cv::Mat4f relief;
    cv::merge(std::array<cv::Mat, 4>{along_u, along_v, open, depth_mm}, relief);
    return relief;
}

} // namespace

cv::Mat4f day0_color(const Patch& patch)
{
    cv::Mat4f color(patch.color.size());
    const cv::Mat sources[] = {patch.color, patch.opacity};
    const int channels[] = {0, 0, 1, 1, 2, 2, 3, 3};
    cv::mixChannels(sources, 2, &color, 1, channels, 4);
    return color;
}

cv::Mat2f day0_shape(const Patch& patch)
{
    cv::Mat2f shape;
    cv::merge(std::array<cv::Mat, 2>{patch.depth_mm, patch.mask}, shape);
    return shape;
}

shared::Relief relief_parameters(const WoundDay& today, double texel_mm)
{
    const bool as_tissue = today.in_phases; // else as in the paper: the hollow alone
    // Granulation fills a wound before it closes, so that no miniature of its hollow remains.
    const double filled = as_tissue ? base::smoothstep(0, filled_ratio, today.unhealed_ratio) : 1;
    return {.depth_scale = static_cast<float>(today.depth_scale * filled),
            .scar_mm = as_tissue ? static_cast<float>(today.scar.height_mm) : 0.f,
            .texel_mm = static_cast<float>(texel_mm),
            .reach_texels = static_cast<float>(occlusion_reach_mm / texel_mm),
            .bump_mm = as_tissue ? static_cast<float>(bump_mm) : 0.f,
            .bump_texels = static_cast<float>(std::floor(bump_reach_mm / texel_mm) + .5),
            .slope_limit = as_tissue ? static_cast<float>(slope_limit) : 0.f};
}

cv::Point2d DayMaps::uv(cv::Point2d patch_point) const
{
    const cv::Point2d texels = (patch_point + cv::Point2d(1, 1)) * (.5 * patch_size);
    return {(texels.x - region.x) / region.width, (texels.y - region.y) / region.height};
}

DayMaps maps_on(const PreparedWound& wound, const WoundDay& today, cv::Rect region)
{
    const int size = wound.patch.color.rows;
    DayMaps maps{region, size, cv::Mat4f(region.size()), cv::Mat4f(region.size()), {}};
    const Warping warping(wound.patch, today);
    cv::parallel_for_({0, region.height}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < region.width; ++x)
                warping.fill({(region.x + x + .5) * 2 / size - 1, (region.y + y + .5) * 2 / size - 1},
                             maps.color(y, x), maps.state(y, x));
    });
    maps.relief = relief_of(maps.color, maps.state, relief_parameters(today, wound.patch.width_mm / size));
    return maps;
}

MapSample sample(const DayMaps& maps, cv::Point2d patch_point, cv::Point2d footprint)
{
    const cv::Point2d uv = maps.uv(patch_point);
    if (!(std::abs(uv.x - .5) <= .5 && std::abs(uv.y - .5) <= .5))
        return {};
    const cv::Point2d before = maps.uv(patch_point - footprint), after = maps.uv(patch_point + footprint);
    const auto mean = [](const cv::Vec4d& a, const cv::Vec4d& b) { return .5 * (a + b); };
    const cv::Vec4d first = base::sample<4>(maps.relief, after),
                    second = base::sample<4>(maps.relief, before), off = first - second;
    // Of two samples the variance is half their squared difference; here the mean of the axes, twice.
    return {mean(base::sample<4>(maps.color, after), base::sample<4>(maps.color, before)),
            base::sample<4>(maps.state, uv), mean(first, second), .5 * (off[0] * off[0] + off[1] * off[1])};
}

} // namespace wound
