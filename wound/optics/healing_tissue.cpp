#include "wound/optics/healing_tissue.hpp"

#include <algorithm>

namespace optics {

TissueDay restored_skin(const SkinLayers& intact, double depth_scale)
{
    const std::vector<double> nothing(intact.channels(), 0.0);
    const Layer none{.name = "", .sigma_a = nothing, .sigma_s_reduced = nothing};
    return {
        .intact = intact, .missing_ratio = depth_scale, .regrown_ratio = 0, .regrown = none, .cover = none};
}

double deepest_injury_mm(const SkinLayers& intact)
{
    double depth = 0;
    for (std::size_t i = 0; i < intact.layers.size(); ++i) {
        const double thickness = intact.layers[i].thickness_mm;
        depth += i + 1 < intact.layers.size() ? thickness : std::min(0.5 * thickness, 5.0);
    }
    return depth;
}

SkinLayers layers_at(const TissueDay& day, double injury_depth_mm, bool keep_indices)
{
    const double injury = std::clamp(injury_depth_mm, 0.0, deepest_injury_mm(day.intact));
    SkinLayers result{.layers = {}, .n_above = day.intact.n_above, .n_below = day.intact.n_below};
    if (const double thickness = std::min(day.cover.thickness_mm, injury); thickness > 0) {
        result.layers.push_back(day.cover);
        result.layers.back().thickness_mm = thickness;
    }
    if (day.regrown_ratio * injury > 0) {
        result.layers.push_back(day.regrown);
        result.layers.back().thickness_mm = day.regrown_ratio * injury;
    }
    double removed = std::min(day.missing_ratio + day.regrown_ratio, 1.0) * injury;
    for (std::size_t i = 0; i < day.intact.layers.size(); ++i) {
        Layer layer = day.intact.layers[i];
        const double whole = layer.thickness_mm;
        layer.thickness_mm = whole - std::min(removed, whole);
        removed -= std::min(removed, whole);
        if (layer.thickness_mm <= 0 && i + 1 < day.intact.layers.size())
            continue;
        if (!keep_indices && i + 1 < day.intact.layers.size()) {
            const double share = std::min(1.0, 4 * layer.thickness_mm / whole);
            layer.n = share * layer.n + (1 - share) * day.intact.layers[i + 1].n;
        }
        result.layers.push_back(layer);
    }
    return result;
}

} // namespace optics
