// Passes to be scheduled, and what a plan says of them.
#pragma once
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "engine/graph/schedule.hpp"

namespace scheduled_passes {

inline constexpr graph::ImageDesc target{64, 32, VK_FORMAT_R16G16B16A16_SFLOAT};
inline constexpr graph::ImageDesc depth_target{64, 32, VK_FORMAT_D32_SFLOAT};

/// The state of every pass: "warp ran: first run | lut culled: unused: nothing samples lut"
inline std::string trace(const graph::Plan& plan)
{
    std::string text;
    for (const graph::PassPlan& pass : plan.passes)
        text +=
            (text.empty() ? "" : " | ") + pass.name + " " + graph::name_of(pass.state) + ": " + pass.reason;
    return text;
}

inline const graph::PassPlan& pass_plan(const graph::Plan& plan, std::string_view name)
{
    for (const graph::PassPlan& pass : plan.passes)
        if (pass.name == name)
            return pass;
    throw std::out_of_range(std::string(name));
}

inline graph::ImageId add_compute(graph::Graph& graph, const std::string& name,
                                  std::initializer_list<graph::ImageId> inputs = {}, float value = 0)
{
    const graph::ImageId output = graph.image(name + "_out", target);
    graph::ComputePass& pass = graph.compute(name, name + ".comp");
    int i = 0;
    for (const graph::ImageId input : inputs)
        pass.sample("input" + std::to_string(i++), input, graph::Sampler::NearestClamp);
    pass.store("output", output);
    pass.uniform("value", value);
    pass.dispatch(target.width, target.height);
    return output;
}

inline graph::ImageId add_raster(graph::Graph& graph, const std::string& name,
                                 std::initializer_list<graph::ImageId> inputs, bool always = false)
{
    const graph::ImageId output = graph.image(name + "_out", target);
    graph::RasterPass& pass = graph.raster(name);
    pass.color(output, {0, 0, 0, 1});
    graph::Draw& draw = pass.draw(name);
    draw.index_count = 3;
    int i = 0;
    for (const graph::ImageId input : inputs)
        draw.sample("input" + std::to_string(i++), input);
    if (always)
        pass.every_frame();
    return output;
}

} // namespace scheduled_passes
