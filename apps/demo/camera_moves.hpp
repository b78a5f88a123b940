// Camera moves by mouse. Every result is valid in a scene file.
#pragma once
#include "scene/scene.hpp"

namespace demo_command {

/// Turns the camera around its target: `right_deg` to the viewer's right, `up_deg` upwards; the elevation is
/// clamped to +-89 degrees.
scene::Camera orbit(scene::Camera camera, double right_deg, double up_deg);

/// Divides the camera's distance by `factor` (> 0) and clamps it to 0.03..10 m. `distance_m`: the present
/// distance, from scene::LoadedScene::distance().
scene::Camera zoom(scene::Camera camera, double factor, double distance_m);

/// Moves the camera so that the head follows the mouse by `right` and `down`, in picture heights. Each
/// coordinate of the target is clamped to +-1 m.
scene::Camera pan(scene::Camera camera, double right, double down, double distance_m);

} // namespace demo_command
