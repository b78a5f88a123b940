// Ambient occlusion of a still mesh: what share of the sky each vertex sees.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "head/bvh.hpp"

namespace head {

/// Per point, the cosine-weighted share of its hemisphere that is open up to `reach`: 0 enclosed .. 1 open.
/// The same `rays` stratified directions everywhere, turned by a different angle at each point;
/// deterministic.
std::vector<float> ambient_occlusion(const Bvh& bvh, std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals, int rays, float reach);

} // namespace head
