// Ambient occlusion of a static mesh, by ray casting.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "head/bvh.hpp"

namespace head {

/// For each point the cosine-weighted share of its hemisphere without hits up to a distance of `reach`: 0
/// enclosed .. 1 open. Uses the same `rays` stratified directions at every point, rotated about the normal by
/// a different angle. Deterministic.
std::vector<float> ambient_occlusion(const Bvh& bvh, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach);

} // namespace head
