// Radiative transfer through layered tissue with N angles per panel: the numerical model that fills the
// reflectance table. Exact up to the number of angles, for layers of different index, normal and diffuse
// light (docs/optics.md, section 5).
#pragma once
#include "wound/optics/reflectance.hpp"

namespace optics {

/// options.angles: quadrature nodes per panel, 2..64; a panel ends at the critical angle of one of the media.
/// 8 nodes are within 2e-4 of the published values. Anisotropy is clamped to +-.99 at constant reduced
/// scattering.
Response adding_doubling(const Stack& stack, const ReflectanceOptions& options);

} // namespace optics
