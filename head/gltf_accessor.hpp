// Numbers out of a glTF file: every index, range, stride and type is checked before a byte is read.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <vector>

namespace head {

class GltfReader
{
  public:
    /// `file` names the file in errors. Both must outlive the reader.
    GltfReader(const tinygltf::Model& gltf, const std::string& file) : gltf_(gltf), file_(file) {}

    /// count x components numbers, integers normalised where the accessor says so. `field` is the JSON path
    /// that led here.
    std::vector<float> numbers(int accessor, int components, std::string_view field) const;
    /// Unsigned integers, each below `limit`.
    std::vector<std::uint32_t> indices(int accessor, std::size_t limit, std::string_view field) const;
    std::size_t count(int accessor, std::string_view field) const;
    /// The bytes of a buffer view.
    std::span<const std::uint8_t> view(int buffer_view, std::string_view field) const;

    /// How an error names a field: the file, then the field's path.
    std::string where(std::string_view field) const;
    [[noreturn]] void refuse(std::string_view field, std::string_view what,
                             std::string_view cure = "export the model again") const;

  private:
    const tinygltf::Accessor& accessor_at(int accessor, std::string_view field) const;
    template <typename Store>
    void visit(const tinygltf::Accessor& accessor, std::string_view field, Store&& store) const;

    const tinygltf::Model& gltf_;
    const std::string& file_;
};

} // namespace head
