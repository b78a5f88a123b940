#include "engine/mesh_buffer.hpp"

#include "engine/texture.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace engine {

MeshBuffer::MeshBuffer(const Device& device, std::span<const Vertex> vertices,
                       std::span<const std::uint32_t> indices, const std::string& name)
    : count(static_cast<std::uint32_t>(indices.size())), content_id(new_content_id())
{
    assert(!vertices.empty() && !indices.empty());
    vertex_buffer = std::make_shared<const Buffer>(upload_buffer(
        device, std::as_bytes(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, name + " vertices"));
    index_buffer =
        upload_buffer(device, std::as_bytes(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, name + " indices");
}

MeshBuffer::MeshBuffer(const Device& device, const MeshBuffer& vertices_of,
                       std::span<const std::uint32_t> indices, const std::string& name)
    : vertex_buffer(vertices_of.vertex_buffer),
      index_buffer(device, indices.size_bytes(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, HostAccess::Write,
                   name + " indices"),
      count(static_cast<std::uint32_t>(indices.size())), content_id(new_content_id())
{
    assert(!indices.empty());
    std::ranges::copy(std::as_bytes(indices), index_buffer.mapped().begin());
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
