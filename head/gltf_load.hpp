// Converts a parsed glTF document to a mesh and materials: the second step of load_model.
#pragma once
#include <string>
#include <tiny_gltf.h>
#include <vector>

#include "head/gltf_accessor.hpp"
#include "head/raw_mesh.hpp"

namespace head {

/// The triangles of the default scene with node transforms applied. Material indices are those of the
/// document; its material count is the index for primitives without a material. Appends skipped parts to
/// `notes`.
RawMesh gather_mesh(const tinygltf::Model& gltf, const GltfReader& reader, std::vector<std::string>& notes);

/// The document's materials with the indices `wanted`, with their pictures; the document's material count is
/// the index of the default material.
std::vector<Material> gather_materials(const tinygltf::Model& gltf, const GltfReader& reader,
                                       const std::vector<std::uint32_t>& wanted,
                                       std::vector<std::string>& notes);

} // namespace head
