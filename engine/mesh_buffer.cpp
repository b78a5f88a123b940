#include "engine/mesh_buffer.hpp"

#include "engine/texture.hpp"

#include <array>
#include <cassert>
#include <cstddef>

namespace engine {

MeshBuffer::MeshBuffer(const Device& device, std::span<const Vertex> vertices,
                       std::span<const std::uint32_t> indices, const std::string& name)
    : count(static_cast<std::uint32_t>(indices.size())), content_id(new_content_id())
{
    assert(!vertices.empty() && !indices.empty());
    vertex_buffer =
        upload_buffer(device, std::as_bytes(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, name + " vertices");
    index_buffer =
        upload_buffer(device, std::as_bytes(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, name + " indices");
}

const VertexAttribute* vertex_attribute(std::string_view name)
{
    static constexpr std::array<VertexAttribute, 4> attributes{{
        {"position", 3, offsetof(Vertex, position)},
        {"normal", 3, offsetof(Vertex, normal)},
        {"tangent", 4, offsetof(Vertex, tangent)},
        {"uv", 2, offsetof(Vertex, uv)},
    }};
    for (const VertexAttribute& attribute : attributes)
        if (attribute.name == name)
            return &attribute;
    return nullptr;
}

} // namespace engine
