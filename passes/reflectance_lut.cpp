#include "passes/reflectance_lut.hpp"

#include <algorithm>
#include <cassert>

namespace passes {

namespace {

shared::vec3 rgb(const std::vector<double>& channels)
{
    assert(channels.size() == 3);
    return {static_cast<float>(channels[0]), static_cast<float>(channels[1]),
            static_cast<float>(channels[2])};
}

shared::LutLayer shader_layer(const wound::Layer& layer)
{
    constexpr double thickest_mm = 1e9; // an infinite layer would give inf / inf
    return {.sigma_a = rgb(layer.sigma_a),
            .sigma_s_reduced = rgb(layer.sigma_s_reduced),
            .g = static_cast<float>(layer.g),
            .n = static_cast<float>(layer.n),
            .thickness_mm = static_cast<float>(std::min(layer.thickness_mm, thickest_mm))};
}

} // namespace

double lut_row_day(std::size_t row, std::size_t rows, double last_day)
{
    return shared::lut_value(static_cast<float>(row), static_cast<float>(rows), static_cast<float>(last_day));
}

LutTissue lut_tissue(std::span<const wound::TissueDay> rows, double last_day)
{
    assert(!rows.empty());
    LutTissue result;
    for (const wound::TissueDay& day : rows) {
        assert(day.intact.layers.size() == rows.front().intact.layers.size());
        result.layers.push_back(shader_layer(day.cover));
        result.layers.push_back(shader_layer(day.regrown));
        for (const wound::Layer& layer : day.intact.layers)
            result.layers.push_back(shader_layer(layer));
        result.days.push_back({static_cast<float>(day.missing_ratio), static_cast<float>(day.regrown_ratio)});
    }
    const wound::SkinLayers& skin = rows.front().intact;
    result.parameters = {.axes = {.deepest_mm = static_cast<float>(deepest_injury_mm(skin)),
                                  .last_day = static_cast<float>(last_day)},
                         .n_above = static_cast<float>(skin.n_above),
                         .n_below = static_cast<float>(skin.n_below),
                         .layers_per_day = static_cast<shared::uint>(skin.layers.size() + 2)};
    return result;
}

ReflectanceLut add_reflectance_lut(engine::Graph& graph, std::string_view name, const LutTissue& tissue,
                                   wound::Rung rung, std::uint32_t width)
{
    const auto height = static_cast<std::uint32_t>(tissue.days.size());
    // Half floats: every device filters them linearly; their error, 2.4e-4 of the value, is below the table's
    // own.
    const engine::ImageId lut = graph.image(name, {width, height, VK_FORMAT_R16G16B16A16_SFLOAT});
    engine::ComputePass& pass = graph.compute(name, "reflectance_lut.comp");
    pass.constant("MODEL", static_cast<std::int32_t>(rung));
    pass.uniform("Parameters", tissue.parameters);
    pass.buffer("Layers", std::span(tissue.layers));
    pass.buffer("Days", std::span(tissue.days));
    pass.store("lut_out", lut);
    pass.dispatch(width, height);
    return {lut};
}

} // namespace passes
