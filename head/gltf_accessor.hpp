// Reads numbers from a glTF file; checks every index, range, stride and type before reading.
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
    /// `file` is the file's name in error messages. Both must outlive the reader.
    GltfReader(const tinygltf::Model& gltf, const std::string& file) : gltf_(gltf), file_(file) {}

    /// count x components numbers; integers are normalised if the accessor says so. `field`: the JSON path of
    /// the reference to the accessor, for error messages.
    std::vector<float> numbers(int accessor, int components, std::string_view field) const;
    /// Unsigned integers, each below `limit`.
    std::vector<std::uint32_t> indices(int accessor, std::size_t limit, std::string_view field) const;
    std::size_t count(int accessor, std::string_view field) const;
    /// The bytes of a buffer view.
    std::span<const std::uint8_t> view(int buffer_view, std::string_view field) const;

    /// "FILE: FIELD" for error messages.
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
