// Photon walk in layered tissue: the reference for every model. Henyey-Greenstein scattering, exact Fresnel
// reflection at every boundary, Russian roulette. The result depends on the seed, not on the thread count.
#pragma once
#include "wound/optics/reflectance.hpp"

namespace optics {

/// Largest number of steps of all photons together: one to two hours on one core.
inline constexpr double most_walk_steps = 1e11;

/// Throws base::InputError when the photons would take more than about most_walk_steps, as in tissue that
/// scatters much and absorbs little.
void check_walk_cost(const Stack& stack, std::uint64_t photons);

/// Response::standard_error is that of r. Anisotropy is clamped to +-.99 at constant reduced scattering.
/// Throws as check_walk_cost() does.
Response monte_carlo(const Stack& stack, const ReflectanceOptions& options);

} // namespace optics
