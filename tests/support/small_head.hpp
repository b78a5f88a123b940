// Heads made by code, small enough for tests: a rounded one with a nose, and a wall of skin whose every point
// is known.
#pragma once
#include "head/model.hpp"
#include "scene/scene.hpp"

namespace small {

/// 23 cm high, the nose towards +z, with a colour and a normal map.
head::Model head();

/// A square of 24 cm at z = 0, facing +z, of one plain colour, with a vertex in its middle.
head::Model wall(const glm::vec3& linear_color);

/// The model as a .glb that lasts as long as the process.
std::filesystem::path saved(const head::Model& model);

/// The default scene on `model`, in a small picture.
scene::Scene scene(const head::Model& model, std::uint32_t side = 256);

} // namespace small
