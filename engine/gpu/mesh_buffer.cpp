#include "engine/gpu/mesh_buffer.hpp"

#include <algorithm>
#include <cassert>

#include "engine/gpu/texture.hpp"

namespace gpu {

MeshBuffer::MeshBuffer(const Device& device, const graph::VertexLayout& layout,
                       std::span<const std::byte> vertices, std::span<const std::uint32_t> indices,
                       const std::string& name)
    : Mesh(layout, static_cast<std::uint32_t>(indices.size()), new_content_id())
{
    assert(!vertices.empty() && vertices.size() % layout.stride == 0 && !indices.empty());
    vertex_buffer_ = std::make_shared<const Buffer>(
        upload_buffer(device, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, name + " vertices"));
    index_buffer_ =
        upload_buffer(device, std::as_bytes(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, name + " indices");
}

MeshBuffer::MeshBuffer(const Device& device, const MeshBuffer& vertices_of,
                       std::span<const std::uint32_t> indices, const std::string& name)
    : Mesh(vertices_of.layout(), static_cast<std::uint32_t>(indices.size()), new_content_id()),
      vertex_buffer_(vertices_of.vertex_buffer_),
      index_buffer_(device, indices.size_bytes(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, HostAccess::Write,
                    name + " indices")
{
    assert(!indices.empty());
    std::ranges::copy(std::as_bytes(indices), index_buffer_.mapped().begin());
}

} // namespace gpu
