// What a head's hollows make of light that comes from all around, and of light that other skin reflects. `open`: the
// cosine-weighted share of the surroundings that a point sees, its ambient occlusion, 0..1. The float versions are in
// shaders/lib/shading.glsl and specular.glsl.
#pragma once
#include "base/color.hpp"

namespace optics {

/// `open`, after light has gone back and forth in the hollow, which reflects the share `albedo` of it diffusely: `open`
/// or more, and at most 1.
base::Color visibility(double open, const base::Color& albedo);

/// Light of a lamp that reaches the point by way of the skin that hides the surroundings: times the lamp's strength
/// without its shadow, and times the skin's diffuse albedo. `cosine` between normal and lamp, -1..1.
double bounced_share(double open, double cosine);

/// The share of light from all around that occlusion leaves to the highlight, where it leaves `open` (0..1)
/// to diffuse light. `cosine` between normal and viewer. What occludes a head stands at its horizon: the
/// higher a direction, the more is open. cosine^p does that, and p is such that its cosine-weighted mean is
/// `open`.
double specular_occlusion(double open, double cosine);
/// The share of a mirrored direction's lobe above the surface that has no normal map and no wound. `cosine`
/// between the direction and that surface's normal, -1..1. J. Russell, "Horizon Occlusion for Normal Mapped
/// Reflections".
double above_horizon(double cosine);

} // namespace optics
