// Vertices and indices on the device.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "engine/gpu/memory.hpp"
#include "engine/graph/mesh.hpp"

namespace gpu {

class MeshBuffer : public graph::Mesh
{
  public:
    /// `vertices`: packed vertices of `layout`. Neither list may be empty.
    MeshBuffer(const Device& device, const graph::VertexLayout& layout, std::span<const std::byte> vertices,
               std::span<const std::uint32_t> indices, const std::string& name);
    /// Shares the vertices of another mesh. The new indices are in host-visible memory, so that no upload has
    /// to wait for the frames in flight.
    MeshBuffer(const Device& device, const MeshBuffer& vertices_of, std::span<const std::uint32_t> indices,
               const std::string& name);

    VkBuffer vertices() const { return vertex_buffer_->handle(); }
    VkBuffer indices() const { return index_buffer_.handle(); }

  private:
    std::shared_ptr<const Buffer> vertex_buffer_;
    Buffer index_buffer_;
};

} // namespace gpu
