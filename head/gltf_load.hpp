// From a parsed glTF document to a mesh and materials: the second of load_model's two steps.
#pragma once
#include <string>
#include <tiny_gltf.h>
#include <vector>

#include "head/gltf_accessor.hpp"
#include "head/raw_mesh.hpp"

namespace head {

/// The triangles of the default scene, node transforms applied; material indices are the document's own, one
/// past its last for primitives without a material. `notes` takes what was left out.
RawMesh gather_mesh(const tinygltf::Model& gltf, const GltfReader& reader, std::vector<std::string>& notes);

/// The `wanted` ones of the document's materials with their pictures; one past its last is the default
/// material.
std::vector<Material> gather_materials(const tinygltf::Model& gltf, const GltfReader& reader,
                                       const std::vector<std::uint32_t>& wanted,
                                       std::vector<std::string>& notes);

} // namespace head
