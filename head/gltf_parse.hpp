// Parses a glTF file and loads its buffers: the first step of load_model.
#pragma once
#include <filesystem>
#include <tiny_gltf.h>

namespace head {

/// Parses .glb or .gltf. Does not decode pictures: `image` of an image outside the buffer views holds the
/// encoded bytes. Reads other files only from the folder of `path`. Throws base::InputError.
tinygltf::Model parse_gltf(const std::filesystem::path& path);

} // namespace head
