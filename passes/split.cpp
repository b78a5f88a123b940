#include "passes/split.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace passes {

graph::ImageId add_split(graph::Graph& graph, graph::ImageId left, graph::ImageId right, double divider)
{
    const graph::ImageDesc size = graph.images[left.index].desc;
    assert(graph.images[right.index].desc == size);
    const graph::ImageId both = graph.image("split", {size.width, size.height, VK_FORMAT_R8G8B8A8_UNORM});
    graph::ComputePass& pass = graph.compute("split", "split.comp");
    pass.sample("left_picture", left, graph::Sampler::NearestClamp);
    pass.sample("right_picture", right, graph::Sampler::NearestClamp);
    pass.store("both", both);
    pass.uniform("Divider_", std::int32_t(std::lround(std::clamp(divider, 0.0, 1.0) * size.width)));
    pass.dispatch(size.width, size.height);
    return both;
}

} // namespace passes
