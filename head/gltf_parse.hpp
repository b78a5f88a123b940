// From a file's bytes to a parsed glTF document whose buffers are loaded: the first of load_model's two
// steps.
#pragma once
#include <filesystem>
#include <tiny_gltf.h>

namespace head {

/// Parses .glb or .gltf. Pictures are not decoded: an image that is not in a buffer view has its file's bytes
/// in `image`. Other files are read only from the folder the file lies in. Throws base::InputError.
tinygltf::Model parse_gltf(const std::filesystem::path& path);

} // namespace head
