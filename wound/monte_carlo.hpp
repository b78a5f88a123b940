// Photon walk in layered tissue: the reference of the ladder. Henyey-Greenstein scattering, exact Fresnel
// reflection at every boundary, Russian roulette. Seeded; the result does not depend on the number of
// threads.
#pragma once
#include "wound/reflectance.hpp"

namespace wound {

/// Response::standard_error is that of r. Anisotropy beyond +-.99 is taken as .99 at the same reduced
/// scattering. Throws cicatrix::InputError for tissue so thick and so free of absorption that the walk would
/// hardly end.
Response monte_carlo(const Stack& stack, const RungOptions& options);

} // namespace wound
