// Vertices and indices on the device, and which part of a vertex a shader's input means.
#pragma once
#include "engine/memory.hpp"
#include "engine/model.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace engine {

class MeshBuffer
{
  public:
    MeshBuffer(const Device& device, std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
               const std::string& name);
    /// Other triangles of the same vertices, which are shared. The indices are written where the CPU can
    /// reach them, so that nothing waits for the frames in flight.
    MeshBuffer(const Device& device, const MeshBuffer& vertices_of, std::span<const std::uint32_t> indices,
               const std::string& name);

    VkBuffer vertices() const { return vertex_buffer->handle(); }
    VkBuffer indices() const { return index_buffer.handle(); }
    std::uint32_t index_count() const { return count; }
    /// Different for every mesh ever made in this process.
    std::uint64_t content() const { return content_id; }

  private:
    std::shared_ptr<const Buffer> vertex_buffer;
    Buffer index_buffer;
    std::uint32_t count = 0;
    std::uint64_t content_id = 0;
};

/// A member of engine::Vertex by the name a vertex shader gives it.
struct VertexAttribute
{
    std::string_view name;
    std::uint32_t components, offset; // floats, bytes
};

/// Null when a vertex has no such member.
const VertexAttribute* vertex_attribute(std::string_view name);

} // namespace engine
