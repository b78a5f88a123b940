#include "wound/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "base/input_error.hpp"
#include "base/smoothstep.hpp"
#include "wound/contour.hpp"
#include "wound/photo/healthy_skin.hpp"

namespace wound {

namespace {

cv::Vec3f mean_of(const cv::Mat3f& color, const cv::Mat1b& where)
{
    const cv::Scalar mean = cv::mean(color, where);
    return {static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])};
}

/// Fills texels outside the picture with the mean of nearby skin, or with `mean` far from skin. Otherwise
/// black, or the red of a wound at the picture's edge, would leak into blurred or stretched skin.
void fill_outside(cv::Mat3f& color, const cv::Mat1f& picture, const cv::Mat1f& skin, const cv::Vec3f& mean)
{
    cv::Mat3f weight, sum;
    cv::Mat1f mass;
    cv::merge(std::vector<cv::Mat>{skin, skin, skin}, weight);
    const double sigma = std::max(color.cols, color.rows) / 12.;
    cv::GaussianBlur(color.mul(weight), sum, {}, sigma);
    cv::GaussianBlur(skin, mass, {}, sigma);
    for (int j = 0; j < color.rows; ++j)
        for (int i = 0; i < color.cols; ++i) {
            const cv::Vec3f nearby = (sum(j, i) + 1e-3F * mean) / (mass(j, i) + 1e-3F);
            color(j, i) = picture(j, i) * color(j, i) + (1 - picture(j, i)) * nearby;
        }
}

/// 1 in the wound and close to it, falling to 0 in the surrounding skin, well inside the patch's frame.
cv::Mat1f first_opacity(const cv::Mat1f& mask, const cv::Mat1f& picture)
{
    cv::Mat1f outward, to_gap;
    cv::distanceTransform(mask <= .5F, outward, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(picture > .99F, to_gap, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const float unit = 2.F / static_cast<float>(mask.cols);
    cv::Mat1f opacity(mask.size());
    for (int j = 0; j < mask.rows; ++j)
        for (int i = 0; i < mask.cols; ++i) {
            const float x = (static_cast<float>(i) + .5F) * unit - 1,
                        y = (static_cast<float>(j) + .5F) * unit - 1;
            const float skin = 1 - base::smoothstep(.02F, .32F, outward(j, i) * unit);
            const float frame = 1 - base::smoothstep(.7F, .92F, std::max(std::abs(x), std::abs(y)));
            // Skin fades towards the picture's edge; a wound cut by the edge does not.
            opacity(j, i) =
                skin * frame * std::max(base::smoothstep(0, .1F, to_gap(j, i) * unit), mask(j, i));
        }
    cv::GaussianBlur(opacity, opacity, {},
                     mask.cols / 100.); // smooths the creases of the distance at the border's concavities
    return opacity;
}

/// 0 in a wound, rising to 1 at 2 % of the patch's side from it, beyond the red rim.
cv::Mat1f away_from(const cv::Mat1f& mask)
{
    cv::Mat1f distance;
    cv::distanceTransform(mask <= .02F, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return cv::min(distance / (.02 * mask.cols), 1);
}

/// Replaces other wounds of the photograph by nearby skin, and scales the opacity between the wounds by the
/// distance to each.
void leave_out(Patch& patch, const cv::Mat1f& others)
{
    cv::Mat1f to_own, to_others;
    cv::distanceTransform(patch.mask <= .5F, to_own, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(others <= .5F, to_others, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const cv::Mat1f share = to_others / (to_own + to_others + 1e-3F);
    patch.opacity = patch.opacity.mul(share);
    const cv::Mat1f own = away_from(others);
    fill_outside(patch.color, own, own, mean_of(patch.color, own > .5F));
}

/// The photograph's square of `side` pixels around `center`, resampled to size x size.
struct Resampling
{
    cv::Matx23d to_photo; // texel -> pixel
    double pixels_per_texel;
    int size;

    Resampling(cv::Point2d center, double side, int texels) : pixels_per_texel(side / texels), size(texels)
    {
        const double offset = (.5 - texels / 2.) * pixels_per_texel;
        to_photo = {pixels_per_texel, 0, center.x + offset, 0, pixels_per_texel, center.y + offset};
    }

    cv::Mat operator()(cv::Mat image, int border) const
    {
        if (pixels_per_texel > 1) {
            cv::Mat smooth; // prevents aliasing of fine detail
            cv::GaussianBlur(image, smooth, {}, .5 * pixels_per_texel);
            image = smooth;
        }
        cv::Mat resampled;
        cv::warpAffine(image, resampled, to_photo, {size, size}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                       border);
        return resampled;
    }
};

/// Coverage with an edge about two texels wide: the binary mask is blurred at photo resolution, then the edge
/// is steepened.
cv::Mat1f resample_mask(const cv::Mat1b& mask, const Resampling& resample)
{
    cv::Mat1f coverage;
    mask.convertTo(coverage, CV_32F, 1 / 255.);
    // Blur less if the wound is only a few pixels wide, because blurring would enlarge it.
    cv::Mat1f inward;
    cv::distanceTransform(mask > 127, inward, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    double half_width = 0;
    cv::minMaxLoc(inward, nullptr, &half_width);
    cv::GaussianBlur(coverage, coverage, {}, std::clamp(.4 * half_width, .5, 1.2));
    cv::Mat1f soft = resample(coverage, cv::BORDER_CONSTANT);
    const double gain = std::max(1 / resample.pixels_per_texel, 1.);
    cv::Mat1f sharp = cv::min(cv::max((soft - .5F) * gain + .5F, 0), 1);
    // Blurring lowers the peak of a wound of a few pixels, so normalise by that peak.
    double peak = 0;
    cv::minMaxLoc(soft, nullptr, &peak);
    if (peak > 0 && peak < .98)
        sharp = cv::min(cv::max((soft / peak - .5F) * gain + .5F, 0), 1);
    return sharp;
}

/// The patch's square in the photograph, pixels.
struct PhotoFrame
{
    cv::Point2d centroid;
    double side = 0;
};

PhotoFrame photo_frame(const cv::Mat1b& mask)
{
    const cv::Rect bounds = cv::boundingRect(mask);
    const cv::Moments moments = cv::moments(mask, true);
    return {{moments.m10 / moments.m00, moments.m01 / moments.m00},
            std::max(bounds.width, bounds.height) / wound_share};
}

/// The checked mask; if it is full, the largest component of picture_area().
cv::Mat1b day0_mask(const Photograph& photograph, const Preparation& preparation)
{
    const cv::Mat1b mask = checked_mask(photograph.mask, photograph.srgb.size(), preparation.where);
    if (cv::countNonZero(mask) < static_cast<int>(mask.total()))
        return mask;
    const cv::Mat1b picture = picture_area(photograph.srgb);
    if (cv::countNonZero(picture) == 0)
        throw base::InputError(preparation.where, "the photograph is black", "give one that shows a wound");
    return components(picture, 1).front();
}

void check(const Photograph& photograph, const Preparation& preparation)
{
    if (photograph.srgb.empty())
        throw base::InputError(preparation.where, "the photograph is empty", "give a PNG or JPEG picture");
    if (!(preparation.width_mm >= least_width_mm && preparation.width_mm <= 200))
        throw base::InputError(fmt::format("{}: width_mm", preparation.where),
                               fmt::format("{} is out of range", preparation.width_mm),
                               "give the wound's longer side, from 0.5 to 200 mm");
    CV_Assert(preparation.patch_size >= 32 && preparation.patch_size <= 4096);
}

} // namespace

int shared_patch_size(double width_mm)
{
    constexpr double widest_texel_mm = 30 / wound_share / 512;
    int size = 512;
    while (size > 64 && width_mm / wound_share / (size / 2) <= widest_texel_mm)
        size /= 2;
    return size;
}

PreparedWound prepare(const Photograph& photograph, const Preparation& preparation)
{
    check(photograph, preparation);
    if (photograph.mask.empty())
        return prepare(separate(photograph, preparation).front().photograph, preparation);
    const cv::Mat1b mask = day0_mask(photograph, preparation);
    const auto [centroid, side] = photo_frame(mask);

    // Shrink a photograph much finer than the patch: its linear colours would need gigabytes.
    constexpr double finest = 4; // pixels per texel
    const double shrink = std::min(1., finest * preparation.patch_size / side);
    cv::Mat3b srgb = photograph.srgb;
    cv::Mat1b working_mask = mask;
    cv::Mat1f layer = photograph.layer;
    if (shrink < 1) {
        cv::resize(photograph.srgb, srgb, {}, shrink, shrink, cv::INTER_AREA);
        cv::resize(mask, working_mask, srgb.size(), 0, 0, cv::INTER_AREA);
        if (!layer.empty())
            cv::resize(photograph.layer, layer, srgb.size(), 0, 0, cv::INTER_AREA);
    }
    const cv::Point2d center = (centroid + cv::Point2d(.5, .5)) * shrink - cv::Point2d(.5, .5);
    const Resampling resample(center, side * shrink, preparation.patch_size);
    cv::Mat1f whole;
    picture_area(srgb).convertTo(whole, CV_32F, 1 / 255.);
    const cv::Mat1f picture = resample(whole, cv::BORDER_CONSTANT);
    Patch patch;
    patch.color = resample(base::linear_from_srgb(srgb), cv::BORDER_REPLICATE);
    patch.mask = resample_mask(working_mask, resample);
    if (!layer.empty())
        patch.layer = resample(layer, cv::BORDER_CONSTANT);
    cv::Mat1f others;
    if (!photograph.other_wounds.empty()) {
        cv::Mat1b working = photograph.other_wounds;
        if (shrink < 1)
            cv::resize(photograph.other_wounds, working, srgb.size(), 0, 0, cv::INTER_AREA);
        others = resample_mask(working, resample);
    }
    cv::Mat1f skin = picture.mul(away_from(patch.mask));
    if (!others.empty())
        skin = skin.mul(away_from(others));
    const cv::Mat1b certain = skin > .5F;
    patch.shows_skin = cv::countNonZero(certain) >= least_skin * static_cast<double>(certain.total());
    if (!patch.shows_skin)
        skin.setTo(0);
    fill_outside(patch.color, picture, skin,
                 patch.shows_skin ? mean_of(patch.color, certain)
                                  : cv::Vec3f(base::linear_from_lab(average_skin)));
    patch.opacity = first_opacity(patch.mask, picture);
    if (!others.empty())
        leave_out(patch, others);
    patch.width_mm = preparation.width_mm / wound_share;
    PreparedWound wound = prepare_patch(std::move(patch), preparation, false);
    wound.photo_mask = mask;
    wound.photo_center = centroid;
    wound.photo_side = side;
    return wound;
}

std::vector<WoundPart> separate(const Photograph& photograph, const Preparation& preparation)
{
    constexpr std::size_t most = 64;
    const auto& [where, width_mm] = std::tie(preparation.where, preparation.width_mm);
    const cv::Mat1b given =
        photograph.mask.empty() ? segment(photograph.srgb, preparation.hints, where) : photograph.mask;
    const cv::Mat1b largest = checked_mask(given, photograph.srgb.size(), where);
    const cv::Mat1b all = given > 127;
    const std::vector<cv::Mat1b> masks = components(all, most + 1);
    if (masks.size() > most)
        throw base::InputError(where, fmt::format("the mask has more than {} components", most),
                               "paint each wound as one white area, without specks");
    const PhotoFrame first = photo_frame(largest);
    const double mm_per_pixel = width_mm / (first.side * wound_share);
    std::vector<WoundPart> parts;
    for (const cv::Mat1b& mask : masks) {
        checked_mask(mask, photograph.srgb.size(), where);
        const PhotoFrame frame = photo_frame(mask);
        parts.push_back({{photograph.srgb, mask, masks.size() > 1 ? cv::Mat1b(all & ~mask) : cv::Mat1b(),
                          photograph.layer},
                         std::max(frame.side * wound_share * mm_per_pixel, least_width_mm),
                         (frame.centroid - first.centroid) * mm_per_pixel});
    }
    return parts;
}

std::vector<PreparedWound> prepare_all(const Photograph& photograph, const Preparation& preparation)
{
    check(photograph, preparation);
    std::vector<PreparedWound> wounds;
    for (const WoundPart& part : separate(photograph, preparation)) {
        Preparation one = preparation;
        one.width_mm = part.width_mm;
        wounds.push_back(prepare(part.photograph, one));
    }
    return wounds;
}

PreparedWound prepare_patch(Patch patch, const Preparation& preparation, bool keep_depth)
{
    PreparedWound wound;
    wound.patch = std::move(patch);
    if (!keep_depth)
        wound.patch.depth_mm = depth_of(wound.patch, preparation.depth);
    const Moments moments = moments_of(wound.patch.mask);
    wound.centroid = moments.centroid;
    wound.area = moments.area;
    wound.border = border_of(wound.patch.mask);
    const double spacing = preparation.control_spacing > 0
                               ? preparation.control_spacing
                               : spacing_from_curvature(wound.border, wound.centroid);
    wound.control_points = control_points(wound.border, wound.centroid, spacing);
    wound.flow = prepare_flow(wound.border, wound.control_points, wound.centroid);
    // The grid's error grows with the square of its cells: so it stays the same in texels.
    wound.flow.grid_share = std::sqrt(std::min(1., wound.patch.mask.cols / 512.));
    return wound;
}

WoundDay wound_at(const PreparedWound& wound, const Healing& healing, double day, WarpModel model)
{
    const HealingState state = healing_at(healing, day);
    WoundDay result;
    result.day = state.day;
    result.unhealed_ratio = state.unhealed_ratio;
    result.border_ratio = state.border_ratio;
    result.recovery_ratio = state.recovery_ratio;
    result.depth_scale = state.depth_scale;
    result.bed_recovery = result.border_recovery =
        state.recovery_ratio; // as in the paper: one r for the whole wound
    if (healing.model == HealingModel::Face) {
        // The open bed hardly recovers; the pink new epithelium has recovered by 25 % when the wound closes.
        result.bed_recovery = 0.12 * state.recovery_ratio;
        result.border_recovery = 0.25 * state.recovery_ratio;
        if (const ScarState scar = scar_at(healing, day);
            scar.months > 0) // after closure the rest follows the scar's redness
            result.border_recovery = 1 - (1 - result.border_recovery) * scar.redness / scar_after(0).redness;
        result.border_softness = std::min(5 * state.recovery_ratio, 1.);
        result.in_phases = true;
        result.phase = phase_at(day, closure_day(healing.curve), healing.age_days);
    }
    result.bed_presence =
        base::smoothstep(static_cast<float>(smallest_scale * smallest_scale),
                         static_cast<float>(closed_ratio), static_cast<float>(state.unhealed_ratio));
    result.scar = scar_at(healing, day);
    result.border_warp = make_warp(wound.flow, state.border_ratio, model);
    result.bed_warp = state.unhealed_ratio == state.border_ratio
                          ? result.border_warp
                          : make_warp(wound.flow, state.unhealed_ratio, model);
    return result;
}

} // namespace wound
