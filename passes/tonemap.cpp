#include "passes/tonemap.hpp"

#include <cmath>

namespace passes {

engine::ImageId add_tonemap(engine::Graph& graph, engine::ImageId hdr, float exposure, Highlights highlights)
{
    const engine::ImageDesc size = graph.images[hdr.index].desc;
    const engine::ImageId encoded =
        graph.image("encoded", {size.width, size.height, VK_FORMAT_R8G8B8A8_UNORM});
    engine::ComputePass& pass = graph.compute("tonemap", "tonemap.comp");
    pass.sample("hdr", hdr, engine::Sampler::NearestClamp);
    pass.store("encoded", encoded);
    pass.uniform("ExposureBlock", std::exp2(exposure));
    pass.constant("shoulder", highlights == Highlights::SoftShoulder);
    pass.dispatch(size.width, size.height);
    return encoded;
}

} // namespace passes
