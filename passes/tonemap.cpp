#include "passes/tonemap.hpp"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "base/tone_curve.hpp"

namespace passes {

Backdrop backdrop_of(const ViewportTile& tile)
{
    if (tile.transparent)
        return {.transparent = true};
    const glm::vec3 top = glm::make_vec3(base::backdrop_top), bottom = glm::make_vec3(base::backdrop_bottom);
    const auto at = [&](double y) { return glm::mix(top, bottom, float(y / tile.picture[1])); };
    return {at(tile.corner[1]), at(double(tile.corner[1]) + tile.size[1])};
}

graph::ImageId add_tonemap(graph::Graph& graph, graph::ImageId hdr, float exposure, Highlights highlights,
                           const Backdrop& backdrop)
{
    const graph::ImageDesc size = graph.images[hdr.index].desc;
    const graph::ImageId encoded =
        graph.image("encoded", {size.width, size.height, VK_FORMAT_R8G8B8A8_UNORM});
    graph::ComputePass& pass = graph.compute("tonemap", "tonemap.comp");
    pass.sample("hdr", hdr, graph::Sampler::NearestClamp);
    pass.store("encoded", encoded);
    struct
    {
        float exposure;
        glm::vec3 top, bottom;
    } const block{std::exp2(exposure), backdrop.top, backdrop.bottom};
    pass.uniform("ExposureBlock", block);
    pass.constant("shoulder", highlights == Highlights::SoftShoulder);
    pass.constant("transparent", backdrop.transparent);
    pass.in_place(hdr);
    pass.dispatch(size.width, size.height);
    return encoded;
}

} // namespace passes
