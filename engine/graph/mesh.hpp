// What the graph knows of a mesh on the device: what its vertices hold, how many indices there are, and
// whether it has changed. Its buffers are the device's business (engine/gpu/mesh_buffer.hpp).
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/graph/find_named.hpp"

namespace graph {

/// A member of a vertex struct, by the name that vertex shaders give it. All are floats.
struct VertexAttribute
{
    std::string_view name;
    std::uint32_t components, offset; // floats, bytes
};

struct VertexLayout
{
    std::uint32_t stride = 0; // bytes
    std::span<const VertexAttribute> attributes;

    /// Null when a vertex has no such member.
    const VertexAttribute* find(std::string_view name) const { return find_named(attributes, name); }
};

class Mesh
{
  public:
    const VertexLayout& layout() const { return *layout_; }
    std::uint32_t index_count() const { return index_count_; }
    /// Different for every mesh ever made in this process.
    std::uint64_t content() const { return content_; }

  protected:
    /// The layout must outlive the mesh: it is a constant of the program.
    Mesh(const VertexLayout& layout, std::uint32_t index_count, std::uint64_t content)
        : layout_(&layout), index_count_(index_count), content_(content)
    {
    }
    ~Mesh() = default;

  private:
    const VertexLayout* layout_;
    std::uint32_t index_count_;
    std::uint64_t content_;
};

} // namespace graph
