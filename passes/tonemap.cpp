#include "passes/tonemap.hpp"

#include <cmath>

namespace passes {

engine::ImageId add_tonemap(engine::Graph& graph, engine::ImageId hdr, float exposure, Highlights highlights,
                            const Backdrop& backdrop)
{
    const engine::ImageDesc size = graph.images[hdr.index].desc;
    const engine::ImageId encoded =
        graph.image("encoded", {size.width, size.height, VK_FORMAT_R8G8B8A8_UNORM});
    engine::ComputePass& pass = graph.compute("tonemap", "tonemap.comp");
    pass.sample("hdr", hdr, engine::Sampler::NearestClamp);
    pass.store("encoded", encoded);
    struct
    {
        float exposure;
        glm::vec3 top, bottom;
    } const block{std::exp2(exposure), backdrop.top, backdrop.bottom};
    pass.uniform("ExposureBlock", block);
    pass.constant("shoulder", highlights == Highlights::SoftShoulder);
    pass.dispatch(size.width, size.height);
    return encoded;
}

} // namespace passes
