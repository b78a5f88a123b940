#include "passes/reflectance_lut.hpp"

#include <algorithm>
#include <cassert>

#include <opencv2/imgproc.hpp>

#include "wound/optics/spectrum.hpp"

namespace passes {

namespace {

// The three channels of a band. Past the end it repeats the last channel, where the weights are zero.
shared::vec3 three(std::span<const double> channels, std::size_t band)
{
    const auto at = [&](std::size_t i) {
        return static_cast<float>(channels[std::min(i, channels.size() - 1)]);
    };
    return {at(3 * band), at(3 * band + 1), at(3 * band + 2)};
}

std::vector<shared::mat3> band_weights(std::size_t channels)
{
    const std::span<const base::Color> weights = optics::channel_weights(channels);
    assert(!weights.empty());
    std::vector<shared::mat3> bands((channels + 2) / 3, shared::mat3(0.0f));
    for (std::size_t i = 0; i < channels; ++i) // a column holds one channel's contribution to R, G and B
        for (int c = 0; c < 3; ++c)
            bands[i / 3][static_cast<int>(i % 3)][c] = static_cast<float>(weights[i][c]);
    return bands;
}

/// The arrays of a LutTissue.
struct Rows
{
    std::vector<shared::LutLayer> layers;
    std::vector<shared::LutBand> bands;
    std::vector<shared::mat3> weights;
    std::vector<shared::LutDay> days;
};

void append(Rows& tissue, const optics::Layer& layer)
{
    constexpr double thickest_mm = 1e9; // instead of infinity, which would give inf / inf
    tissue.layers.push_back({.g = static_cast<float>(layer.g),
                             .n = static_cast<float>(layer.n),
                             .thickness_mm = static_cast<float>(std::min(layer.thickness_mm, thickest_mm))});
    for (std::size_t band = 0; band < tissue.weights.size(); ++band)
        tissue.bands.push_back({three(layer.sigma_a, band), three(layer.sigma_s_reduced, band)});
}

} // namespace

LutTissue lut_tissue(std::span<const optics::TissueDay> rows, double last_day)
{
    assert(!rows.empty());
    Rows result;
    result.weights = band_weights(rows.front().intact.channels());
    for (const optics::TissueDay& day : rows) {
        assert(day.intact.layers.size() == rows.front().intact.layers.size());
        append(result, day.cover);
        append(result, day.regrown);
        for (const optics::Layer& layer : day.intact.layers)
            append(result, layer);
        result.days.push_back({static_cast<float>(day.missing_ratio), static_cast<float>(day.regrown_ratio)});
    }
    const optics::SkinLayers& skin = rows.front().intact;
    return {.layers = graph::Bytes::of(result.layers),
            .bands = graph::Bytes::of(result.bands),
            .weights = graph::Bytes::of(result.weights),
            .days = graph::Bytes::of(result.days),
            .rows = static_cast<std::uint32_t>(result.days.size()),
            .parameters = {.axes = {.deepest_mm = static_cast<float>(deepest_injury_mm(skin)),
                                    .last_day = static_cast<float>(last_day)},
                           .n_above = static_cast<float>(skin.n_above),
                           .n_below = static_cast<float>(skin.n_below),
                           .layers_per_day = static_cast<shared::uint>(skin.layers.size() + 2),
                           .bands = static_cast<shared::uint>(result.weights.size())},
            .table = nullptr};
}

ReflectanceLut add_reflectance_lut(graph::Graph& graph, std::string_view name, const LutTissue& tissue,
                                   optics::ReflectanceModel model, std::uint32_t width)
{
    if (tissue.table) {
        graph.keep(tissue.table);
        return {graph.import(name, *tissue.table)};
    }
    assert(model <= optics::ReflectanceModel::Calibrated);
    const std::uint32_t height = tissue.rows;
    // Half floats: every device can filter them linearly. Their relative error, 2.4e-4, is below the error of
    // the table itself.
    const graph::ImageId lut = graph.image(name, {width, height, VK_FORMAT_R16G16B16A16_SFLOAT});
    graph::ComputePass& pass = graph.compute(name, "reflectance_lut.comp");
    pass.constant("MODEL", static_cast<std::int32_t>(model));
    pass.uniform("Parameters", tissue.parameters);
    pass.buffer("Layers", tissue.layers);
    pass.buffer("Bands", tissue.bands);
    pass.buffer("Weights", tissue.weights);
    pass.buffer("Days", tissue.days);
    pass.store("lut_out", lut);
    pass.dispatch(width, height);
    return {lut};
}

gpu::Texture upload_reflectance_table(const gpu::Device& device, const cv::Mat3f& table,
                                      const std::string& name)
{
    cv::Mat rgba, half;
    cv::cvtColor(table, rgba, cv::COLOR_RGB2RGBA);
    rgba.convertTo(half, CV_16F);
    return gpu::Texture(device, half, gpu::Encoding::Linear, false, name);
}

} // namespace passes
