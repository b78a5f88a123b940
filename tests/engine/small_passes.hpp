// Two small passes for tests of the executor: one fills an image, the other shows it.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/gpu/executor.hpp"

namespace small_passes {

struct FillParams
{
    glm::vec3 color{0.25f, 0.5f, 0.75f};
    float step = 0.0f;
};

inline constexpr graph::ImageDesc small_float{20, 12, VK_FORMAT_R32G32B32A32_SFLOAT};

/// A compute pass that fills "filled".
inline graph::ImageId add_fill(graph::Graph& graph, const FillParams& params,
                        const std::vector<glm::vec2>& offsets = {})
{
    const graph::ImageId filled = graph.image("filled", small_float);
    graph::ComputePass& fill = graph.compute("fill", "test_fill.comp");
    fill.store("result", filled);
    fill.uniform("params", params);
    fill.buffer("Offsets", offsets);
    fill.dispatch(small_float.width, small_float.height);
    return filled;
}

/// A raster pass that shows `source` in "shown".
inline graph::ImageId add_show(graph::Graph& graph, graph::ImageId source, glm::vec4 tint = glm::vec4(1.0f))
{
    const graph::ImageId shown = graph.image("shown", small_float);
    graph::RasterPass& show = graph.raster("show");
    show.color(shown, {0, 0, 0, 0});
    show.sample("source", source, graph::Sampler::NearestClamp);
    show.uniform("Tint", tint);
    show.draw("test_quad").index_count = 3;
    return shown;
}

/// One text per pass such as "fill ran: first run", in order of execution.
inline std::vector<std::string> states(const gpu::FrameResult& result)
{
    std::vector<std::string> list;
    for (const gpu::PassResult& pass : result.passes)
        list.push_back(pass.name + " " + graph::name_of(pass.state) + ": " + pass.reason);
    return list;
}

} // namespace small_passes
