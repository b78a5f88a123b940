// How far light spreads by diffusion theory, as the systems have it that the paper compares with: the dipole
// of H. Jensen, S. Marschner, M. Levoy, P. Hanrahan 2001, "A practical model for subsurface light transport",
// and the multipole and layers of C. Donner, H. Jensen 2005, "Light diffusion in multi-layered translucent
// materials". Double precision.
//
// A profile is the share of the light that entered at a point which leaves at a distance, per area. Lengths
// have any unit, the same everywhere. Single scattering, which the authors of 2001 compute apart, counts as
// part of the diffuse albedo, as in H. Jensen, J. Buhler 2002, "A rapid hierarchical rendering technique for
// translucent materials".
#pragma once
#include <array>
#include <limits>
#include <vector>

#include "wound/optics/tissue.hpp"

namespace optics {

/// One wavelength.
struct DiffusiveMedium
{
    double albedo = .5;    // alpha' = sigma_s' / sigma_t', 0..1
    double extinction = 1; // sigma_t', 1/length, > 0
    double boundary = 1;   // A = (1 + F_dr) / (1 - F_dr), boundary_factor(); 1: the index is that of the air

    double transport() const; // sigma_tr = sqrt(3 sigma_a sigma_t'), 1/length
    double outside() const;   // z_b = 2 A D, D = 1 / (3 sigma_t'): so far above the surface the fluence is 0
};
/// A of a medium of refractive index n >= 1 in air.
double boundary_factor(double n);

/// The light of a source at depth z and of its image beyond the surface, whose depth is -image: z (1 + s d)
/// e^(-s d) / (4 pi d^3) for each, d the distance. Times a source's strength this is what leaves per area.
struct DipoleSources
{
    double transport = 1, depth = 1, image = 1;

    double at_squared(double r2) const; // r^2 along the surface from above the source
    double within(double r) const;      // integral over a disc, in closed form
    double total() const;               // over the plane
};

/// Jensen et al. 2001, eq. (4): a half space.
struct Dipole
{
    explicit Dipole(const DiffusiveMedium& medium);
    double at_squared(double r2) const { return strength * sources.at_squared(r2); }
    double within(double r) const { return strength * sources.within(r); }
    double total() const { return strength * sources.total(); } // the diffuse albedo R_d

    double strength; // alpha'
    DipoleSources sources;
};

/// A slab of Donner & Jensen 2005, section 3: reflected (eq. 8) and transmitted (eq. 9) light. The authors
/// put the source one mean free path deep, which lies beyond a thin epidermis. Here light scatters first at
/// the mean depth of those events that happen in the slab, and the rest passes unscattered: for a thick slab
/// that is theirs.
class Multipole
{
  public:
    /// thickness > 0, may be infinite: then it is the dipole.
    Multipole(const DiffusiveMedium& medium, double thickness);

    double reflected_at(double r) const;
    double transmitted_at(double r) const; // without what passes unscattered
    /// 2D Fourier transforms of both at the spatial frequency k (1/length), in closed form; k = 0: their
    /// integrals.
    double reflected(double k) const;
    double transmitted(double k) const;
    double unscattered() const { return unscattered_; } // passes where it entered

  private:
    double frequency(double k) const;

    double strength_, transport_, depth_, outside_, thickness_, period_, unscattered_;
};

/// What layered tissue reflects of light that enters at a point, each layer a multipole, put together in the
/// Fourier domain (Donner & Jensen 2005, section 4, eqs. 15-18). Per mm^2, for R, G and B, of a diffuse
/// albedo of 1: textures multiply it.
class LayeredProfile
{
  public:
    /// Tissue of 1, 3 or wavelength_count channels. `blur_mm`: standard deviation of a Gaussian with which
    /// the profile is blurred, for irradiance that is known at samples so far apart.
    explicit LayeredProfile(const SkinLayers& tissue, double blur_mm = 0);

    /// r^2 in mm^2; 0 beyond 40 mm.
    std::array<float, 3> at_squared(double r2) const;
    /// Beyond it leaves less than a thousandth of each channel's light.
    double reach_mm() const { return reach_mm_; }
    /// Diffuse albedo of the layers by this theory.
    const std::array<double, 3>& albedo() const { return albedo_; }
    static constexpr std::size_t bytes() { return radius_count * sizeof(std::array<float, 3>); }

  private:
    static constexpr std::size_t radius_count = 256;
    std::vector<std::array<float, 3>> values_; // at radii even in their logarithm
    std::array<double, 3> albedo_{};
    double reach_mm_ = 0;
};

/// Albedo inversion for the dipole (Jensen & Buhler 2002, section 5): for every diffuse albedo, the alpha'
/// that gives it, and the mean free path with which the edge response - brightness beyond the border of a
/// half-lit plane - is nearest to that of the reference's medium, in the integral of the squared difference.
/// So the dipole is as near to the truth as its shape permits. The medium's response is Burley's
/// (transport.hpp), which is within 9 % of its width.
class DipoleInversion
{
  public:
    explicit DipoleInversion(double refractive_index);

    /// `albedo` 0..1, of which the dipole's total() is .001 to .97; `scattering_length` > 0: mean free path
    /// between two scatterings in the reference's medium, and the unit of the dipole's lengths.
    Dipole dipole_of(double albedo, double scattering_length) const;

  private:
    struct Node
    {
        double albedo, path_over_width; // alpha', mean free path over diffusion_width()
    };
    double boundary_;
    std::vector<Node> nodes_; // even in the diffuse albedo
};

} // namespace optics
