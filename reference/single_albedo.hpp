// Albedo inversion: which single-scattering albedo gives a body of given diffuse albedo.
//
// The diffuse albedo of a half space for light that has entered it diffusely is computed by radiative
// transfer (adding-doubling) at nodes that are even in sqrt(1 - single-scattering albedo), in which it is
// smooth, and interpolated in between. It is within .0002 of the random walk for isotropic scattering and
// within .0015 for an anisotropy of .8 (a million walks each; tests/reference has a shorter check).
#pragma once
#include <vector>

#include "base/color.hpp"

namespace reference {

class AlbedoTable
{
  public:
    /// Anisotropy -.99...99; refractive index 1..3 (1: the boundary is index-matched).
    AlbedoTable(double g, double n);

    /// Share of the light that has entered a half space which comes out of it again, 0..1.
    double diffuse_of(double single) const;
    /// The inverse. Diffuse albedos above `largest_diffuse` count as that: nearer to 1 a walk hardly ends.
    double single_of(double diffuse) const;
    base::Color single_of(const base::Color& diffuse) const;

    static constexpr double largest_diffuse = 0.995;

  private:
    std::vector<double> diffuse_; // at sqrt(1 - single) = 0, 1/last, ... 1: falls from 1 to 0
};

} // namespace reference
