#include "reference/wounds.hpp"

#include <algorithm>
#include <cmath>

#include "base/file.hpp"
#include "base/statistics.hpp"
#include "head/albedo_under.hpp"
#include "head/vectors.hpp"
#include "wound/drawn_region.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/reflectance_table.hpp"

namespace reference {
namespace {

/// As Stage has them.
cv::Mat3f reflectance_table(const wound::LutRows& rows, optics::ReflectanceModel model)
{
    return model > optics::ReflectanceModel::Calibrated
               ? wound::kept_table(rows, wound::lut_size, model, wound::picture_table_options)
               : wound::bake_reflectance_table(rows.days, wound::lut_size, model);
}

/// Median of day 0's depth where one of the maps' coverages is above a half; a millimetre where none is.
/// Channels of DayMaps::state.
double median_depth_mm(const wound::DayMaps& maps, int depth, int coverage)
{
    std::vector<double> depths;
    for (const cv::Vec4f& state : maps.state)
        if (state[coverage] > .5f)
            depths.push_back(double(state[depth]));
    return depths.empty() ? 1 : base::median(depths);
}

} // namespace

DayWounds::DayWounds(const scene::LoadedScene& scene, double day, const std::optional<MediumChoice>& walked)
    : scene_(scene), day_(day), choice_(walked.value_or(MediumChoice{})), today_(scene.wounds_on(day))
{
    if (walked) {
        table_.emplace(choice_.anisotropy, choice_.index);
        skin_ = kept_reduction(base::cache_folder(), optics::layers_of(scene.tissue), *table_, choice_);
    }
    const double last_day = scene::last_day(scene.scene);
    for (std::size_t i = 0; i < scene.wounds.size(); ++i) {
        const scene::PlacedWound& placed = scene.wounds[i];
        const wound::LutRows rows =
            wound::lut_rows(scene.tissue_at(placed), placed.healing, wound::lut_size, last_day);
        const cv::Rect region =
            placed.region.empty() ? cv::Rect({}, placed.prepared().patch.color.size()) : placed.region;
        wounds_.push_back({placed.anchor, wound::maps_on(placed.prepared(), today_[i], region),
                           reflectance_table(rows, scene.scene.reflectance_model), rows.axes,
                           1.8 * placed.anchor.half_width_m});
        if (walked)
            tissues_.push_back(
                {kept_reduction(base::cache_folder(), layers_under(i, true), *table_, choice_),
                 kept_reduction(base::cache_folder(), layers_under(i, false), *table_, choice_)});
    }
}

optics::SkinLayers DayWounds::layers_under(std::size_t wound, bool bed) const
{
    const wound::Healing& healing = scene_.wounds[wound].healing;
    const optics::HealingTissue here = scene_.tissue_at(scene_.wounds[wound]);
    const optics::TissueDay tissue =
        bed ? optics::open_bed(here, day_, wound::healing_at(healing, day_).depth_scale)
            : optics::covered_bed(here, day_, wound::closure_day(healing.curve));
    const wound::DayMaps& maps = wounds_[wound].maps;
    const double depth_mm = bed ? median_depth_mm(maps, 0, 2) : median_depth_mm(maps, 1, 3);
    return optics::layers_at(tissue, depth_mm, optics::is_the_papers(scene_.scene.reflectance_model));
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
                                      .right = head::to_cv(one.anchor.right),
                                      .down = head::to_cv(one.anchor.down),
                                      .geometric = head::to_cv(smooth)};
        look.skin = wound::with_wound(look.skin, {today_[i], one.maps, one.reflectance, one.axes}, place,
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
    base::Color scattering = skin_.scattering_per_m;
    if (const double own = std::max(0.0, 1 - look.bed - look.covered); own < 1) {
        const WoundTissue& tissue = tissues_[look.wound];
        scattering = (own * scattering + look.bed * tissue.bed.scattering_per_m +
                      look.covered * tissue.covered.scattering_per_m) /
                     (own + look.bed + look.covered);
    }
    return medium_of(scattering, table_->single_of(diffuse_albedo), choice_);
}

} // namespace reference
