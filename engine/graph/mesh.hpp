// What the graph knows of a mesh on the device: vertex layout, number of indices, content number. The
// buffers are in engine/gpu/mesh_buffer.hpp.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/graph/find_named.hpp"

namespace graph {

/// A float or float vector in a vertex struct, by its name in vertex shaders.
struct VertexAttribute
{
    std::string_view name;
    std::uint32_t components, offset; // floats, bytes
};

struct VertexLayout
{
    std::uint32_t stride = 0; // bytes
    std::span<const VertexAttribute> attributes;

    /// Null when a vertex has no such attribute.
    const VertexAttribute* find(std::string_view name) const { return find_named(attributes, name); }
};

class Mesh
{
  public:
    const VertexLayout& layout() const { return *layout_; }
    std::uint32_t index_count() const { return index_count_; }
    /// Unique to this mesh in the process.
    std::uint64_t content() const { return content_; }

  protected:
    /// `layout` must outlive the mesh; it is a constant of the program.
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
