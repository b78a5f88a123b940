// The scene's layered tissue, reduced to the homogeneous medium that a random walk needs.
//
// Per channel the layers give two things: their diffuse albedo, and how light spreads along the surface. The
// medium has the same albedo (single_albedo.hpp), and the mean free path at which its edge response - the
// brightness at a distance from the border of a half-lit plane - is nearest to the layers', in the integral
// of the squared difference. Both profiles are the photon walk's (wound/optics/diffusion_profile.hpp).
//
// With the defaults, isotropic and index-matched, the worst difference of the two edge responses is .01 to
// .03 for the presets of skin (table1 .009, light .023, dark .005); with an anisotropy of .8 .02, .01 and
// .02, for four times as many steps. What differs is a free choice of the medium, not of the light: Henyey-
// Greenstein and Fresnel's boundary are there to be compared.
//
// Skin is not of one colour. Where its diffuse albedo is another than the layers', the medium scatters as
// much and absorbs more or less.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "reference/random_walk.hpp"
#include "reference/single_albedo.hpp"
#include "wound/optics/tissue.hpp"

namespace reference {

/// What may be chosen about a medium that stands for layers.
struct MediumChoice
{
    double anisotropy = 0; // g, -.99...99
    double index = 1;      // refractive, 1..3; 1: matched to the air
};

/// Per channel.
struct ReducedTissue
{
    base::Color albedo{0, 0, 0};                    // diffuse, of the layers
    base::Color mean_free_path_mm{0, 0, 0};         // of the medium with that albedo
    base::Color diffuse_mean_free_path_mm{0, 0, 0}; // 1 / sqrt(3 sigma_a (sigma_a + sigma_s'))
    base::Color worst_edge{0, 0, 0};                // largest difference of the edge responses
    base::Color scattering_per_m{0, 0, 0};          // sigma_s of the medium
};
/// As reference.json holds it. from_json() throws json::exception for anything else.
void to_json(nlohmann::json& json, const ReducedTissue& tissue);
void from_json(const nlohmann::json& json, ReducedTissue& tissue);

/// The medium that scatters so much and has this single-scattering albedo.
Medium medium_of(const base::Color& scattering_per_m, const base::Color& single_albedo,
                 const MediumChoice& choice);

/// Tissue of 1, 3 or optics::wavelength_count channels. `photons` per wavelength. All cores work. Throws
/// base::InputError for tissue in which photons walk for ever.
ReducedTissue reduce(const optics::SkinLayers& layers, const AlbedoTable& table, const MediumChoice& choice,
                     std::uint64_t photons);

/// The same from `folder`, where it is kept under a name made from all it depends on. A folder that cannot be
/// written costs the next run its time, nothing else.
ReducedTissue kept_reduction(const std::filesystem::path& folder, const optics::SkinLayers& layers,
                             const AlbedoTable& table, const MediumChoice& choice);

} // namespace reference
