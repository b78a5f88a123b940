#include "reference/wounds.hpp"

#include <algorithm>
#include <cmath>

#include "base/file.hpp"
#include "head/albedo_under.hpp"
#include "wound/drawn_region.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/reflectance_table.hpp"

namespace reference {
namespace {

cv::Vec3d to_cv(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

/// As Stage has them: of the models that no shader knows, with fewer angles and photons.
cv::Mat3f reflectance_table(const wound::LutRows& rows, optics::ReflectanceModel model)
{
    const optics::ReflectanceOptions options{.angles = 4, .photons = 2000};
    return model > optics::ReflectanceModel::Calibrated
               ? wound::kept_table(rows, wound::lut_size, model, options)
               : wound::bake_reflectance_table(rows.days, wound::lut_size, model);
}

/// Of day 0, where the bed is open today; a millimetre where it is not.
double median_depth_mm(const wound::DayMaps& maps)
{
    std::vector<float> depths;
    for (const cv::Vec4f& state : maps.state)
        if (state[2] > .5f)
            depths.push_back(state[0]);
    if (depths.empty())
        return 1;
    const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
    std::ranges::nth_element(depths, middle);
    return *middle;
}

} // namespace

DayWounds::DayWounds(const scene::LoadedScene& scene, double day, const AlbedoTable& table,
                     const MediumChoice& choice, bool with_tissue)
    : scene_(scene), table_(table), choice_(choice), today_(scene.wounds_on(day))
{
    const double last_day = std::max(1.0, *std::ranges::max_element(scene.scene.days));
    if (with_tissue)
        skin_ = kept_reduction(base::cache_folder(), optics::layers_of(scene.tissue), table, choice);
    for (std::size_t i = 0; i < scene.wounds.size(); ++i) {
        const scene::PlacedWound& placed = scene.wounds[i];
        const wound::LutRows rows = wound::lut_rows(scene.tissue, placed.healing, wound::lut_size, last_day);
        tables_.push_back(
            std::make_shared<const cv::Mat3f>(reflectance_table(rows, scene.scene.reflectance_model)));
        const cv::Rect region =
            placed.region.empty() ? cv::Rect({}, placed.prepared().patch.color.size()) : placed.region;
        wounds_.push_back({placed.anchor, wound::maps_on(placed.prepared(), today_[i], region),
                           tables_.back().get(), rows.axes, 1.8 * placed.anchor.half_width_m});
        if (with_tissue)
            tissues_.push_back({tissue_under(i, true, day), tissue_under(i, false, day)});
    }
}

ReducedTissue DayWounds::tissue_under(std::size_t wound, bool bed, double day) const
{
    const wound::Healing& healing = scene_.wounds[wound].healing;
    const optics::TissueDay tissue =
        bed ? optics::open_bed(scene_.tissue, day, wound::healing_at(healing, day).depth_scale)
            : optics::covered_bed(scene_.tissue, day, wound::closure_day(healing.curve));
    return kept_reduction(base::cache_folder(),
                          optics::layers_at(tissue, median_depth_mm(wounds_[wound].maps)), table_, choice_);
}

DayWounds::SkinLook DayWounds::at(const glm::dvec3& position, const glm::dvec3& smooth,
                                  const wound::SkinPoint& own) const
{
    SkinLook look{own};
    for (std::size_t i = 0; i < wounds_.size(); ++i) {
        const One& one = wounds_[i];
        if (glm::distance(position, one.anchor.centre) > one.reach_m)
            continue;
        const glm::dvec3 p = head::in_frame(one.anchor, position);
        const double facing = head::share_received(glm::dot(smooth, one.anchor.normal), p.z);
        if (facing <= 0)
            continue;
        const wound::PatchPlace place{.at = {p.x, p.y},
                                      .facing = facing,
                                      .right = to_cv(one.anchor.right),
                                      .down = to_cv(one.anchor.down),
                                      .geometric = to_cv(smooth)};
        look.skin = wound::with_wound(look.skin, {today_[i], one.maps, *one.reflectance, one.axes}, place,
                                      scene_.scene.shading.blend_model);
        const wound::MapSample here = wound::sample(one.maps, place.at);
        const double opacity = here.color[3] * facing, bed = here.state[2] * opacity;
        const double inside = today_[i].border_softness * std::clamp(here.state[3] - here.state[2], 0., 1.);
        look.bed = std::max(look.bed, bed);
        look.covered = std::max(look.covered, inside * opacity);
        if (bed > 0 || inside > 0)
            look.wound = i;
    }
    return look;
}

Medium DayWounds::medium(const SkinLook& look, const base::Color& diffuse_albedo) const
{
    Medium medium = skin_.with_albedo(diffuse_albedo, table_, choice_);
    if (look.bed + look.covered <= 0)
        return medium;
    const WoundTissue& tissue = tissues_[look.wound];
    const Medium bed = tissue.bed.with_albedo(diffuse_albedo, table_, choice_),
                 covered = tissue.covered.with_albedo(diffuse_albedo, table_, choice_);
    const double own = std::max(0.0, 1 - look.bed - look.covered);
    medium.extinction =
        (own * medium.extinction + look.bed * bed.extinction + look.covered * covered.extinction) /
        (own + look.bed + look.covered);
    return medium;
}

} // namespace reference
