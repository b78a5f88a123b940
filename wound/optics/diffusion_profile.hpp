// How far light spreads in layered tissue: where it comes out again that entered at a point, by the photon
// walk.
#pragma once
#include <array>
#include <vector>

#include "wound/optics/reflectance.hpp"

namespace optics {

/// A ring's light is what leaves between two radii, as a share of the light that entered the tissue.
struct DiffusionProfile
{
    std::vector<double> rings; // the last one is everything beyond
    double albedo = 0;         // all rings
    double radius_mm = 0;      // mean over the light that leaves

    /// Of so many rings the first ends at ring_end_mm(0); each ends at 1.05 times the radius of the one
    /// before.
    static constexpr std::size_t ring_count = 256;
    static double ring_end_mm(std::size_t ring);

    /// Share of the light that leaves within r.
    double within(double r_mm) const;
    /// Light falls on one half of a plane: the dark half's brightness, relative to full, at this distance
    /// from the border.
    double beyond_edge(double x_mm) const;
};

/// Light enters diffusely; what the first surface turns away does not count. Uses options.photons, seed and
/// threads. Throws as check_walk_cost() does.
DiffusionProfile diffusion_profile(const Stack& stack, const ReflectanceOptions& options);

/// Of R, G and B; tissue of 1, 3 or wavelength_count channels. A spectrum is integrated as its colour is,
/// ring by ring, so that a ring may hold less than nothing of a channel.
std::array<DiffusionProfile, 3> diffusion_profile(const SkinLayers& tissue,
                                                  const ReflectanceOptions& options);

} // namespace optics
