// What of the light of even surroundings reaches a head, by ray casting, and its baking at load: ambient
// occlusion for heads that bring no map of it, and what comes through thin parts.
#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "head/bvh.hpp"

namespace head {

/// How far skin darkens other skin, m: about half a head.
inline constexpr float occlusion_reach = 0.15f;

/// For each point the cosine-weighted share of its hemisphere without hits up to a distance of `reach`: 0
/// enclosed .. 1 open. Uses the same `rays` stratified directions at every point, rotated about the normal by
/// a different angle. Deterministic, for any number of threads. `accept`: the triangles that occlude.
std::vector<float> ambient_occlusion(const Bvh& bvh, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach,
                                     HitFilter accept = {});

/// Whether some material has an occlusion map. Then the head's author has decided, also for the others.
bool has_occlusion_map(const Model& model);

/// Sets Vertex::thinness of the opaque materials and, if there is no occlusion map, Vertex::occlusion, by
/// rays against the opaque triangles; brows and lashes are too thin to occlude, and stay open. `bvh`: of the
/// model's solid triangles. Takes about 5 CPU seconds for a mesh of 100,000 triangles, and at most about 20
/// for a larger one.
///
/// Thinness is 1 / the thickness of a slab, its far side in the open, through which as much of the
/// surroundings' light comes as to the vertex from the far sides of its body, whose occlusion counts. Light
/// is followed along straight rays inward; it falls to 1/e over 2 mm, as red light does in skin. 0 where the
/// body is thicker than about 15 mm.
///
/// By vertex and not in a map, because a file's texture coordinates may be missing, mirrored or overlapping
/// (then a texel has several places on the head), and because a vertex attribute costs a pixel less than a
/// fetch. On a coarse mesh the occlusion is as coarse as the mesh.
///
/// Both are kept in the folder by the mesh's contents, and so computed once. Returns why it could not be
/// kept; nothing when it was.
std::string bake_occlusion(Model& model, const Bvh& bvh, const std::filesystem::path& folder);

} // namespace head
