// Which parts of light transport a reference picture has. Each is a switch, so that a picture of the
// rasteriser can be compared with the truth at its own level.
#pragma once
#include "reference/tissue.hpp"

namespace reference {

/// What the scene itself leaves out (its Shading's lambert, ward, normal_map, shadow, bounce, ambient) stays
/// out.
struct Levels
{
    bool shadows = true; // of every light; eyebrows and lashes cast none, as in the rasteriser
    int bounces = 8; // of light from skin to skin, 0..64; 0: light comes from lights and surroundings alone
    bool ambient = true;    // the surroundings' light, with true occlusion
    bool subsurface = true; // random walk under the skin; else it is Lambertian
    bool specular = true;   // the scene's lobes
    MediumChoice medium;
};

} // namespace reference
