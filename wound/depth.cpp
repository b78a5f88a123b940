#include "wound/depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "base/smoothstep.hpp"

namespace wound {

namespace {

struct Site
{
    cv::Point2d face;
    double dermis_mm;
    double soft_tissue_mm; // skin to bone
};

// Dermis: thickest on the lower side of the nose (1.97 mm), thinnest on the upper eyelid (.76 mm) (Chopra et
// al. 2015, Aesthetic Surgery Journal 35(8):1007); forehead 2.8 times the eyelid's skin (Ha et al. 2005,
// Plast. Reconstr. Surg. 115(6):1769); the other sites within the 1.1 to 1.9 mm of six facial regions (Selcuk
// Med. J., "Epidermis, dermis and total skin thicknesses from six different face regions"). Soft tissue to
// the bone: after the pooled means for adults of Stephan & Simpson 2008, J. Forensic Sci. 53(6):1257,
// rounded.
const Site face_sites[] = {
    {{0, .60}, 1.7, 5.5},   // forehead, glabella
    {{.35, .75}, 1.7, 5},   // forehead, side
    {{.30, .42}, 1.5, 6},   // brow
    {{.30, .28}, .76, 4},   // upper eyelid
    {{.30, .12}, .9, 7},    // lower eyelid
    {{0, .25}, 1.3, 4},     // bridge of the nose
    {{0, 0}, 1.97, 5},      // tip and lower side of the nose
    {{.50, -.10}, 1.5, 19}, // cheek
    {{.70, .15}, 1.5, 8},   // cheekbone
    {{.75, -.35}, 1.5, 14}, // jaw
    {{0, -.25}, 1.3, 11},   // upper lip
    {{0, -.50}, 1.2, 12},   // lower lip
    {{0, -.75}, 1.5, 11},   // chin
};
constexpr double thickest_subcutis = 9; // mm, Table 1; deeper tissue is muscle

cv::Vec3f masked_mean(const cv::Mat3f& image, const cv::Mat1b& where)
{
    const cv::Scalar mean = cv::mean(image, where);
    return {static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])};
}

double hue_deg(const cv::Vec3f& lab)
{
    return std::atan2(lab[2], lab[1]) * 180 / std::numbers::pi;
}

/// Gaussian blur of `values`, weighted by `weight`.
cv::Mat1f blur_inside(const cv::Mat1f& values, const cv::Mat1f& weight, double sigma)
{
    cv::Mat1f sum, mass;
    cv::GaussianBlur(values.mul(weight), sum, {}, sigma, sigma, cv::BORDER_REPLICATE);
    cv::GaussianBlur(weight, mass, {}, sigma, sigma, cv::BORDER_REPLICATE);
    return sum / (mass + 1e-6F);
}

double depth_of_layer(double layer, const TissueThickness& tissue)
{
    if (layer < 0)
        return layer * tissue.dermis;
    return tissue.epidermis * std::min(layer, 1.) + tissue.dermis * std::clamp(layer - 1, 0., 1.) +
           tissue.subcutis * std::clamp(layer - 2, 0., 1.);
}

} // namespace

TissueThickness tissue_thickness(cv::Point2d face)
{
    constexpr double reach = .18; // face units over which a site's value holds
    const cv::Point2d place(std::abs(face.x), face.y);
    double weights = 0, dermis = 0, soft = 0;
    for (const Site& site : face_sites) {
        const cv::Point2d offset = place - site.face;
        // Inverse powers instead of Gaussians: far from every site the weights do not underflow to 0/0.
        const double squared = offset.dot(offset) / (reach * reach);
        const double weight = 1 / ((1 + squared) * (1 + squared) * (1 + squared));
        weights += weight;
        dermis += weight * site.dermis_mm;
        soft += weight * site.soft_tissue_mm;
    }
    TissueThickness tissue;
    tissue.dermis = dermis / weights;
    tissue.subcutis = std::clamp(soft / weights - tissue.dermis - tissue.epidermis, .5, thickest_subcutis);
    return tissue;
}

optics::HealingTissue at_place(optics::HealingTissue tissue, const TissueThickness& thickness)
{
    auto* const table = std::get_if<optics::SkinLayers>(&tissue);
    if (table == nullptr || !table->facial)
        return tissue;
    CV_Assert(table->layers.size() == 3);
    table->layers[0].thickness_mm = thickness.epidermis;
    table->layers[1].thickness_mm = std::clamp(thickness.dermis, 1., 4.);
    table->layers[2].thickness_mm = std::clamp(thickness.subcutis, 4., thickest_subcutis);
    return tissue;
}

double layer_reached(const cv::Vec3f& lab, const cv::Vec3f& skin)
{
    // Blood makes the dermis redder and more saturated than the yellowish skin. Fat is yellower than skin;
    // dried or deep tissue is much darker. Skin colour varies by about 5 CIELAB units.
    const double difference = cv::norm(lab - skin);
    const double exposed = base::smoothstep(5, 14, difference); // 0: epidermis intact
    const double redder = base::smoothstep(4, 30, double(lab[1] - skin[1]));
    const double darker = base::smoothstep(.25, .7, double(1 - lab[0] / std::max(skin[0], 1.F)));
    const double chroma = std::hypot(lab[1], lab[2]);
    const double yellower =
        base::smoothstep(8, 30, hue_deg(lab) - hue_deg(skin)) * base::smoothstep(8, 20, chroma);
    const double within_dermis = std::clamp(.35 + .65 * std::max(redder, darker), 0., 1.);
    const double within_subcutis = std::max(.5 * yellower, .6 * darker * redder);
    return exposed * (1 + within_dermis * exposed + within_subcutis * exposed);
}

cv::Mat1f depth_map(const cv::Mat3f& color, const cv::Mat1f& mask, double width_mm,
                    const DepthOptions& options)
{
    CV_Assert(color.size() == mask.size() && width_mm > 0);
    const double texel_mm = width_mm / mask.cols;
    const cv::Mat1b inside = mask > .5;
    const cv::Mat3f lab = base::lab_from_linear(color);
    cv::Mat1f outward, inward;
    cv::distanceTransform(~inside, outward, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(inside, inward, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const double extent = std::sqrt(static_cast<double>(cv::countNonZero(inside))); // texels

    // Healthy skin: a band outside the swollen rim.
    const cv::Mat1b band = (outward > .15 * extent) & (outward < .5 * extent);
    const cv::Vec3f skin = masked_mean(lab, band);
    const TissueThickness& tissue = options.tissue;
    cv::Mat1f depth(mask.size());
    std::transform(lab.begin(), lab.end(), depth.begin(), [&](const cv::Vec3f& pixel) {
        return static_cast<float>(depth_of_layer(layer_reached(pixel, skin), tissue));
    });
    cv::Mat1f weight;
    inside.convertTo(weight, CV_32F, 1 / 255.);
    depth = blur_inside(depth, weight, std::max(.14 * extent, 1.)); // one floor under clot and fibrin

    const double widest_mm = .16 * extent * texel_mm; // of a wall; leaves a floor
    std::array<cv::Mat1f, 3> channels;
    cv::split(lab, channels.data());
    const cv::Mat1f lightness = blur_inside(channels[0], weight, std::max(.05 * extent, 1.));
    const double mean_lightness = cv::mean(lightness, inside)[0];
    const double rim_mm = std::max(.12 * extent * texel_mm, 2 * texel_mm);
    for (int j = 0; j < depth.rows; ++j)
        for (int i = 0; i < depth.cols; ++i) {
            const double in_mm = std::max(inward(j, i) - .5, 0.) * texel_mm;
            const double out_mm = std::max(outward(j, i) - .5, 0.) * texel_mm;
            // A wall slopes over 1.5 times its height, over less where it is dark: a steep wall sees less
            // light.
            const double gentle = std::clamp((double(lightness(j, i)) - mean_lightness) / 12, -1., 1.);
            const double wall_mm = std::min(1.5 * depth(j, i), widest_mm) * (1 + .6 * gentle);
            const double wall = base::smoothstep(0, std::max(wall_mm, 1e-3), in_mm);
            // The rim rises within a third of its width and falls off smoothly over the rest.
            const double rim =
                base::smoothstep(0, rim_mm / 3, out_mm) * (1 - base::smoothstep(rim_mm / 3, rim_mm, out_mm));
            depth(j, i) = inside(j, i) ? static_cast<float>(depth(j, i) * wall)
                                       : static_cast<float>(-options.rim_swelling_mm * rim);
        }
    return depth;
}

cv::Mat1f depth_of_layers(const cv::Mat1f& layer, const TissueThickness& tissue)
{
    cv::Mat1f depth(layer.size());
    std::ranges::transform(layer, depth.begin(),
                           [&](float one) { return static_cast<float>(depth_of_layer(one, tissue)); });
    return depth;
}

cv::Mat1f depth_of(const Patch& patch, const DepthOptions& options)
{
    return patch.layer.empty() ? depth_map(patch.color, patch.mask, patch.width_mm, options)
                               : depth_of_layers(patch.layer, options.tissue);
}

std::vector<double> depth_profile(const cv::Mat1f& depth_mm, cv::Point2d at)
{
    const int row = std::clamp(static_cast<int>((at.y + 1) / 2 * depth_mm.rows), 0, depth_mm.rows - 1);
    return {depth_mm.ptr<float>(row), depth_mm.ptr<float>(row) + depth_mm.cols};
}

} // namespace wound
