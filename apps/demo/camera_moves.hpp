// What a mouse does to a scene's camera. Every result is one that a scene file may hold.
#pragma once
#include "scene/scene.hpp"

namespace demo_command {

/// The camera goes around what it looks at: `right_deg` to the viewer's right, `up_deg` upwards, held at
/// +-89.
scene::Camera orbit(scene::Camera camera, double right_deg, double up_deg);

/// Comes nearer by `factor` > 1, goes away by one < 1; held between 3 cm and 10 m. `distance_m`: of the
/// camera now, Stage::distance().
scene::Camera zoom(scene::Camera camera, double factor, double distance_m);

/// The head follows the mouse: `right` and `down` are in heights of the picture. Held within 1 m of the face.
scene::Camera pan(scene::Camera camera, double right, double down, double distance_m);

} // namespace demo_command
