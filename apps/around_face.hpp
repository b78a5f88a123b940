// Where lights and cameras of a scene stand: about the middle of the face.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "apps/scene.hpp"
#include "passes/placement.hpp"
#include "wound/shading.hpp"

namespace app {

/// Metres, in the head's coordinates.
glm::dvec3 face_middle(const passes::FaceFrame& face);

/// From the face's middle; unit length.
glm::dvec3 unit_towards(const Direction& from);

/// The scene's lights about this face. Throws cicatrix::InputError for one that is out of range, or where eq.
/// (6) has no value.
std::vector<wound::Light> make_lights(const Scene& scene, const passes::FaceFrame& face);

} // namespace app
