#include "stage/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "passes/tonemap.hpp"

namespace stage {
namespace {
using nlohmann::json;

json pass_costs(const gpu::FrameResult& frame)
{
    json passes = json::array();
    for (const gpu::PassResult& pass : frame.passes)
        passes.push_back({{"name", pass.name},
                          {"state", graph::name_of(pass.state)},
                          {"reason", pass.reason},
                          {"refreshed", pass.work.refreshed},
                          {"gpu_ms", pass.gpu_ms ? json(*pass.gpu_ms) : json(nullptr)},
                          {"cpu_ms", pass.cpu_ms}});
    return passes;
}

/// Adds a further tile's times. Every tile has the same passes as the first, of which it may skip some.
void add_costs(json& passes, const gpu::FrameResult& tile)
{
    for (std::size_t i = 0; i < tile.passes.size(); ++i) {
        json& pass = passes[i];
        if (tile.passes[i].gpu_ms)
            pass["gpu_ms"] =
                (pass["gpu_ms"].is_null() ? 0 : pass["gpu_ms"].get<double>()) + *tile.passes[i].gpu_ms;
        pass["cpu_ms"] = pass["cpu_ms"].get<double>() + tile.passes[i].cpu_ms;
    }
}

/// Area of the open bed in the warped mask, in texels.
double bed_texels(const cv::Mat& state)
{
    cv::Mat4f values;
    state.convertTo(values, CV_32F);
    return cv::sum(values)[2];
}

/// Composites linear light over the backdrop, which is divided by the exposure because it is not exposed.
cv::Mat with_backdrop(const cv::Mat& premultiplied, const passes::ViewportTile& tile, double exposure_stops)
{
    cv::Mat4f light;
    premultiplied.convertTo(light, CV_32F);
    if (tile.transparent)
        return light;
    const passes::Backdrop backdrop = passes::backdrop_of(tile);
    const float unexposed = float(std::exp2(-exposure_stops));
    cv::Mat3f result(light.size());
    for (int y = 0; y < light.rows; ++y) {
        const glm::vec3 behind =
            unexposed * glm::mix(backdrop.top, backdrop.bottom, (float(y) + 0.5f) / float(light.rows));
        for (int x = 0; x < light.cols; ++x) {
            const cv::Vec4f& pixel = light(y, x);
            const float through = 1 - std::clamp(pixel[3], 0.0f, 1.0f);
            for (int c = 0; c < 3; ++c)
                result(y, x)[c] = pixel[c] + through * behind[c];
        }
    }
    return result;
}

} // namespace

gpu::DeviceOptions device_options(const scene::SceneOptions& options)
{
    gpu::DeviceOptions device;
    device.device = options.device;
    device.validation = options.validation;
    return device;
}

void fail_on_validation(const gpu::Device& device)
{
    const std::vector<std::string> messages = device.validation_messages();
    if (!messages.empty())
        throw std::runtime_error(
            fmt::format("{} validation messages; the first: {}", messages.size(), messages.front()));
}

std::vector<passes::ViewportTile> tiles_of(const DrawOptions& options)
{
    return passes::tiles({options.size, options.transparent}, options.tile, options.apron);
}

Drawing draw(Renderer& renderer, const Stage& stage, const scene::Shot& shot, const DrawOptions& options)
{
    Drawing drawing;
    DrawOptions cut = options;
    if (tiles_of(options).size() > 1)
        cut.apron = std::max(options.apron, stage.apron(shot.camera, options.size[1]));
    for (const passes::ViewportTile& tile : tiles_of(cut)) {
        const bool first = drawing.picture.empty();
        graph::Graph graph;
        const Frame declared = stage.declare(graph, {.day = shot.day,
                                                     .tile = tile,
                                                     .camera = shot.camera,
                                                     .every_frame = false,
                                                     .light_scale = options.light_scale,
                                                     .radiance = options.radiance});
        const passes::FrameImages& images = declared.images;
        drawing.wounds = declared.wounds;
        const graph::ReadbackId picture = graph.readback("picture", images.picture);
        graph::ReadbackId radiance;
        if (options.radiance)
            radiance = graph.readback("radiance", images.radiance);
        std::vector<graph::ReadbackId> states;
        if (first && options.areas)
            for (const passes::WoundTexture& wound : images.wounds)
                states.push_back(graph.readback(fmt::format("state {}", states.size()), wound.state));

        const gpu::FrameResult frame = renderer.executor.run(graph);
        cv::Mat encoded;
        if (options.transparent)
            encoded = frame.mat(picture);
        else
            cv::cvtColor(frame.mat(picture), encoded, cv::COLOR_RGBA2RGB);
        passes::place(drawing.picture, encoded, tile);
        if (options.radiance)
            passes::place(drawing.radiance,
                          with_backdrop(frame.mat(radiance), tile, stage.scene().exposure_stops), tile);
        for (const graph::ReadbackId state : states)
            drawing.bed_texels.push_back(bed_texels(frame.mat(state)));
        drawing.frame_ms += frame.frame_ms;
        if (first)
            drawing.passes = pass_costs(frame);
        else
            add_costs(drawing.passes, frame);
    }
    return drawing;
}

} // namespace stage
