// Radiative transfer through layered tissue with N angles per panel: the numerical model that fills the
// reflectance table. Exact up to the number of angles, for layers of different index, normal and diffuse
// light (docs/optics.md, section 5).
#pragma once
#include "wound/optics/reflectance.hpp"

namespace optics {

/// options.angles: quadrature nodes per panel (panels end where one of the media starts to reflect
/// totally), 2..64. 8 is within 2e-4 of the published values. Anisotropy beyond +-.99 is taken as .99 at the
/// same reduced scattering.
Response adding_doubling(const Stack& stack, const ReflectanceOptions& options);

} // namespace optics
