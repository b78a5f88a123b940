// Heads made by code, small enough for tests: a rounded one with a nose, and a wall of skin whose every point
// is known.
#pragma once
#include "apps/scene.hpp"
#include "engine/model.hpp"

namespace small {

/// 23 cm high, the nose towards +z, with a colour and a normal map.
engine::Model head();

/// A square of 24 cm at z = 0, facing +z, of one plain colour, with a vertex in its middle.
engine::Model wall(const glm::vec3& linear_color);

/// The model as a .glb that lasts as long as the process.
std::filesystem::path saved(const engine::Model& model);

/// The default scene on `model`, in a small picture.
app::Scene scene(const engine::Model& model, std::uint32_t side = 256);

} // namespace small
