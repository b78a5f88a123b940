// Photon walk in layered tissue: the reference for every model. Henyey-Greenstein scattering, exact Fresnel
// reflection at every boundary, Russian roulette. Seeded; the result does not depend on the number of
// threads.
#pragma once
#include "wound/optics/reflectance.hpp"

namespace optics {

/// Steps that a walk may take: an hour or two of one core.
inline constexpr double most_walk_steps = 1e11;

/// Response::standard_error is that of r. Anisotropy beyond +-.99 is taken as .99 at the same reduced
/// scattering. Throws base::InputError where the photons would take more than about most_walk_steps:
/// tissue that scatters much and absorbs little.
Response monte_carlo(const Stack& stack, const ReflectanceOptions& options);

} // namespace optics
