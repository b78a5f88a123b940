// Reflectance of layered tissue: every model, from the printed equations to a photon walk, behind one
// interface. All take layers at one wavelength; equations are numbered as in docs/optics.md.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "shaders/shared/models.h"
#include "wound/optics/tissue.hpp"

namespace optics {

enum class ReflectanceModel : int
{
    Printed = shared::REFLECTANCE_PRINTED, // eqs. (2), (3) at any thickness; leaves 0..1 outside their domain
    /// Eqs. (2), (3) in the domain that the paper gives them: each layer's d, per channel, is at most
    /// 1/(sigma_a + sigma_s' P(g)). outside_domain() lists the layers that this limits.
    Published = shared::REFLECTANCE_PUBLISHED,
    Exponential = shared::REFLECTANCE_EXPONENTIAL, // eqs. (2), (3), exponential instead of linear attenuation
    TwoStreamPaper = shared::REFLECTANCE_TWO_STREAM_PAPER, // Kubelka-Munk layers with the paper's S = P
                                                           // sigma_s', K = sigma_a; adding
    TwoStream = shared::REFLECTANCE_TWO_STREAM, // Kubelka-Munk layers with Eddington's S = 3/4 sigma_s' - 1/4
                                                // sigma_a, K = 2 sigma_a; adding
    Calibrated =
        shared::REFLECTANCE_CALIBRATED, // Kubelka-Munk layers with S and K fitted to the photon walk; adding
    AddingDoubling,                     // radiative transfer with N angles (adding_doubling.hpp)
    MonteCarlo,                         // photon walk (monte_carlo.hpp)
};

enum class Incidence
{
    Diffuse,
    Normal, // analytic models: light is diffuse inside the tissue
};

enum class DiffuseFresnel
{
    Exact,
    Polynomial,
};

/// The variable of adding-doubling's Gauss-Legendre nodes in each panel.
enum class Quadrature
{
    Smooth, // cosine in the medium of least index that carries the light; Fresnel's formulas are smooth in it
    Slab,   // cosine in the medium of greatest index, as in Prahl 1995 and his tables; converges slowly at
            // the critical angle
};

struct ReflectanceOptions
{
    Incidence incidence = Incidence::Diffuse;
    DiffuseFresnel fresnel = DiffuseFresnel::Exact; // used by the analytic models
    int angles = 8;                                 // adding-doubling, per panel
    Quadrature quadrature = Quadrature::Smooth;     // adding-doubling
    /// Calibrated: S = c0 s^2 / (s + c1 a), K = a (c2 - c3 a / (a + s)) with a = sigma_a, s = sigma_s'. All
    /// >= 0, c2 >= c3. Fitted by `cicatrix bake --calibrate`; shaders/lib/reflectance.glsl has equal values.
    std::array<double, 4> calibration{.6433, 2.2131, 1.9179, .7631};
    std::uint64_t photons = 1'000'000, seed = 1; // Monte Carlo
    unsigned threads = 0;                        // Monte Carlo; 0: one per core
    std::function<void(double)> progress = {};   // gets the finished share 0..1, from one thread at a time
};

struct Response
{
    double r = 0;                  // all reflected light
    double r_without_specular = 0; // r minus specular_reflectance()
    double t = 0;                  // transmitted into the medium below
    /// Per layer. The first three models: what is neither reflected nor transmitted. Of Printed and Published
    /// both t and this are shares of the light inside the skin, as T of eq. (2) is.
    std::vector<double> absorbed = {};
    double standard_error = 0; // of r; 0 for deterministic models
};

/// All models, from the crudest to the reference.
std::span<const ReflectanceModel> all_reflectance_models();
/// Whether the model is eqs. (2) and (3) themselves: Printed and Published. Nothing of ours is added to them.
constexpr bool is_the_papers(ReflectanceModel model)
{
    return model <= ReflectanceModel::Published;
}
/// Name on the command line and in JSON: "printed", "published", "exponential", "two-stream-paper",
/// "two-stream", ...
std::string_view name(ReflectanceModel model);
/// Throws base::InputError that lists the known names.
ReflectanceModel reflectance_model_named(std::string_view name);

/// Guarantees for sigma in 0..1e6, thickness in 0..1e9 or infinite, n in 1..3, g in -1..1:
/// TwoStreamPaper, TwoStream, Calibrated: 0 <= r, t; r + t <= 1 (rounding: 1e-14); r + t = 1 without
/// absorption, within 1e-12; splitting a layer in two changes nothing. AddingDoubling: the same with r + t <=
/// 1 within 1e-11 and a split layer within 1e-9. Exponential: the bounds only. Published: the bounds, of
/// r_without_specular and t. Printed: none.
Response reflectance(const Stack& stack, ReflectanceModel model, const ReflectanceOptions& options = {});

/// Reflectance of the first surface alone.
double specular_reflectance(const Stack& stack, const ReflectanceOptions& options = {});

/// r_without_specular of every channel.
std::vector<double> diffuse_color(const SkinLayers& tissue, ReflectanceModel model,
                                  const ReflectanceOptions& options = {});

/// A layer that is thicker than the domain of eqs. (2) and (3), so that T(d) < 0 unless d is limited.
struct OutsideDomain
{
    std::size_t layer, channel;
    double thickness_mm, limit_mm; // limit: 1 / (sigma_a + P sigma_s')
};
std::vector<OutsideDomain> outside_domain(const SkinLayers& tissue);

/// Reflectance and transmittance of a layer or a boundary for diffuse light from above (top) and below
/// (bottom).
struct Element
{
    double r_top = 0, r_bottom = 0, t_down = 1, t_up = 1;
};

/// Kubelka-Munk slab without boundaries, for back-scattering S and absorption K per mm; continuous down to S
/// = K = 0 and up to an infinite thickness.
Element slab(double S, double K, double thickness_mm);
Element over(const Element& upper, const Element& lower); // adding

} // namespace optics
