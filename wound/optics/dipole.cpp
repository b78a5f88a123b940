#include "wound/optics/dipole.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wound/optics/diffusion_profile.hpp"
#include "wound/optics/fresnel.hpp"
#include "wound/optics/spectrum.hpp"
#include "wound/optics/transport.hpp"

namespace optics {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int images = 24; // of a multipole's sources on each side; the authors take 10

/// Flux through the surface from a source at distance z from it, and r^2 along it.
double flux_from(double transport, double z, double r2)
{
    const double d2 = r2 + z * z, d = std::sqrt(d2);
    return z * (1 + transport * d) * std::exp(-transport * d) / (4 * pi * d2 * d);
}

double side_of(double z)
{
    return z < 0 ? -1 : 1;
}

} // namespace

// ---- The dipole ----------------------------------------------------------------------------------------

double DiffusiveMedium::transport() const
{
    return extinction * std::sqrt(3 * (1 - albedo));
}

double DiffusiveMedium::outside() const
{
    return 2 * boundary / (3 * extinction);
}

double boundary_factor(double n)
{
    const double inside = diffuse_fresnel(n, 1);
    return (1 + inside) / (1 - inside);
}

double DipoleSources::at_squared(double r2) const
{
    return flux_from(transport, depth, r2) + flux_from(transport, image, r2);
}

double DipoleSources::within(double r) const
{
    double sum = 0;
    for (const double z : {depth, image}) {
        const double d = std::hypot(r, z);
        sum += (std::exp(-transport * z) - z / d * std::exp(-transport * d)) / 2;
    }
    return sum;
}

double DipoleSources::total() const
{
    return (std::exp(-transport * depth) + std::exp(-transport * image)) / 2;
}

Dipole::Dipole(const DiffusiveMedium& medium)
    : strength(medium.albedo), sources{medium.transport(), 1 / medium.extinction,
                                       1 / medium.extinction + 2 * medium.outside()}
{
}

// ---- The multipole -------------------------------------------------------------------------------------

Multipole::Multipole(const DiffusiveMedium& medium, double thickness)
    : transport_(medium.transport()), outside_(medium.outside()), thickness_(thickness),
      period_(2 * (thickness + 2 * outside_))
{
    const double path = 1 / medium.extinction, depth = thickness / path; // optical
    unscattered_ = std::exp(-depth);
    strength_ = medium.albedo * -std::expm1(-depth);
    depth_ = depth < 30 ? path - thickness * unscattered_ / -std::expm1(-depth) : path;
}

double Multipole::reflected_at(double r) const
{
    double sum = 0;
    for (int i = std::isinf(thickness_) ? 0 : -images; i <= (std::isinf(thickness_) ? 0 : images); ++i) {
        const double shift = i == 0 ? 0 : i * period_, real = shift + depth_,
                     image = shift - depth_ - 2 * outside_;
        sum += flux_from(transport_, real, r * r) - flux_from(transport_, image, r * r);
    }
    return strength_ * sum;
}

double Multipole::transmitted_at(double r) const
{
    if (std::isinf(thickness_))
        return 0;
    double sum = 0;
    for (int i = -images; i <= images; ++i) {
        const double real = i * period_ + depth_, image = i * period_ - depth_ - 2 * outside_;
        sum += flux_from(transport_, thickness_ - real, r * r) -
               flux_from(transport_, thickness_ - image, r * r);
    }
    return strength_ * sum;
}

// The transform of flux_from(s, z, r^2) is side_of(z) e^(-g |z|) / 2 with g = sqrt(s^2 + k^2). Over all
// images this is a geometric series; e^(-g period) multiplies no growing exponential here, so that nothing
// overflows.
double Multipole::frequency(double k) const
{
    return std::max(std::hypot(transport_, k), 1e-6 / period_);
}

double Multipole::reflected(double k) const
{
    const double g = frequency(k), far = depth_ + 2 * outside_;
    if (std::isinf(thickness_))
        return strength_ / 2 * (std::exp(-g * depth_) + std::exp(-g * far));
    const auto e = [g](double z) { return std::exp(-g * z); };
    const double sum = e(depth_) - e(period_ - depth_) + e(far) - e(period_ - far);
    return strength_ / 2 * sum / (1 - e(period_));
}

double Multipole::transmitted(double k) const
{
    if (std::isinf(thickness_))
        return 0;
    const double g = frequency(k);
    const auto e = [g](double z) { return std::exp(-g * z); };
    const double below = thickness_ - depth_, above = thickness_ + depth_ + 2 * outside_;
    const double sum =
        side_of(below) * e(std::abs(below)) - e(period_ - below) - e(above) + e(period_ - above);
    return strength_ / 2 * sum / (1 - e(period_));
}

// ---- Layers --------------------------------------------------------------------------------------------

namespace {

constexpr double nearest_mm = 1e-3, farthest_mm = 40;
const double steps_per_log = 255 / std::log(farthest_mm / nearest_mm); // of 256 radii

double radius_mm(std::size_t i)
{
    return nearest_mm * std::exp(double(i) / steps_per_log);
}

std::vector<Multipole> multipoles(const Stack& stack)
{
    std::vector<Multipole> slabs;
    double above = stack.n_above;
    for (const LayerOptics& layer : stack.layers) {
        if (layer.thickness_mm <= 0)
            continue;
        const double extinction = std::max(layer.sigma_a + layer.sigma_s_reduced, 1e-6);
        // A differs from 1 where light leaves the skin; between layers indices differ by little.
        const double boundary = slabs.empty() ? boundary_factor(layer.n / above) : 1;
        slabs.emplace_back(DiffusiveMedium{layer.sigma_s_reduced / extinction, extinction, boundary},
                           layer.thickness_mm);
        above = layer.n;
    }
    return slabs;
}

/// From the lowest layer up: R = R1 + T1 R2 T1 / (1 - R1 R2).
double reflected_by(const std::vector<Multipole>& slabs, double k)
{
    double below = 0;
    for (auto slab = slabs.rbegin(); slab != slabs.rend(); ++slab) {
        const double own = slab->reflected(k), passed = slab->transmitted(k) + slab->unscattered();
        below = own + passed * below * passed / (1 - own * below);
    }
    return below;
}

/// The transform of a profile, by channel, at frequencies even in their logarithm, and between them.
class Transform
{
  public:
    Transform(const SkinLayers& tissue, double blur_mm) : values_(count)
    {
        const auto weights = channel_weights(tissue.channels());
        for (std::size_t c = 0; c < tissue.channels(); ++c) {
            const std::vector<Multipole> slabs = multipoles(tissue.channel(c));
            whole_ += weights[c] * reflected_by(slabs, 0);
            for (std::size_t i = 0; i < count; ++i) {
                const double k = lowest * std::exp(double(i) / per_log);
                values_[i] += weights[c] * (reflected_by(slabs, k) * std::exp(-std::pow(k * blur_mm, 2) / 2));
            }
        }
    }
    const base::Color& whole() const { return whole_; } // at k = 0

    base::Color at(double k) const
    {
        const double place = std::clamp(std::log(k / lowest) * per_log, 0.0, double(count - 1) - 1e-9);
        const auto i = std::size_t(place);
        const double share = place - double(i);
        return (1 - share) * values_[i] + share * values_[i + 1];
    }

  private:
    static constexpr double lowest = 1e-3, per_log = 100; // 1/mm
    static constexpr std::size_t count = 1800;            // up to 6.5e4 / mm
    std::vector<base::Color> values_;
    base::Color whole_{0, 0, 0};
};

} // namespace

LayeredProfile::LayeredProfile(const SkinLayers& tissue, double blur_mm) : values_(radius_count)
{
    const Transform transform(tissue, blur_mm);
    for (int c = 0; c < 3; ++c)
        albedo_[std::size_t(c)] = transform.whole()[c];
    // R(r) = 1 / (2 pi) int R^(k) J0(k r) k dk, with x = k r. A Gaussian window ends the integral, which
    // blurs the profile by a thirtieth of the radius.
    constexpr double step = .05, window = 30;
    std::vector<std::array<double, 2>> bessel; // x, and J0(x) x dx under the window
    for (double x = step / 2; x < 5 * window; x += step)
        bessel.push_back({x, std::cyl_bessel_j(0., x) * x * step * std::exp(-x * x / (2 * window * window))});
    for (std::size_t i = 0; i < radius_count; ++i) {
        base::Color sum(0, 0, 0);
        for (const auto& [x, weight] : bessel)
            sum += weight * transform.at(x / radius_mm(i));
        for (int c = 0; c < 3; ++c)
            values_[i][std::size_t(c)] =
                float(std::max(sum[c], 0.0) / (2 * pi * radius_mm(i) * radius_mm(i)));
    }
    // What is normalised is the profile as it is looked up: its integral is 1 whatever the table's steps do.
    const auto ring = [&](std::size_t i, std::size_t c) {
        const double ends = i == 0 || i + 1 == radius_count ? .5 : 1;
        const double area = ends * 2 * pi * std::pow(radius_mm(i), 2) / steps_per_log +
                            (i == 0 ? pi * nearest_mm * nearest_mm : 0);
        return area * double(values_[i][c]);
    };
    for (std::size_t c = 0; c < 3; ++c) {
        double integral = 0, beyond = 0;
        for (std::size_t i = 0; i < radius_count; ++i)
            integral += ring(i, c);
        for (auto& value : values_)
            value[c] = integral > 0 ? float(double(value[c]) / integral) : 0;
        std::size_t last = radius_count - 1;
        while (last > 0 && (beyond += ring(last, c)) < 1e-3)
            --last;
        reach_mm_ = std::max(reach_mm_, radius_mm(last));
    }
}

std::array<float, 3> LayeredProfile::at_squared(double r2) const
{
    static const double log_nearest_squared = 2 * std::log(nearest_mm);
    const double place = std::max((std::log(r2) - log_nearest_squared) / 2 * steps_per_log, 0.0);
    if (!(place < double(radius_count - 1)))
        return {};
    const auto i = std::size_t(place);
    const float share = float(place - double(i));
    std::array<float, 3> value;
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = std::lerp(values_[i][c], values_[i + 1][c], share);
    return value;
}

// ---- Albedo inversion ----------------------------------------------------------------------------------

namespace {

constexpr std::size_t albedo_nodes = 48;
constexpr double largest_albedo = .97; // nearer to 1 no dipole reflects so much at A = 1 within its domain

double total_of(double albedo, double boundary)
{
    return Dipole({albedo, 1, boundary}).total();
}

/// The alpha' whose R_d this is; R_d grows with alpha'.
double inverted(double diffuse, double boundary)
{
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (total_of(middle, boundary) < diffuse ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// A profile of the given share within a radius, as rings.
template <class Within>
DiffusionProfile profile_from(const Within& within)
{
    DiffusionProfile profile;
    double before = 0;
    for (std::size_t i = 0; i < DiffusionProfile::ring_count; ++i) {
        const double now = within(DiffusionProfile::ring_end_mm(i));
        profile.rings.push_back(now - before);
        before = now;
    }
    profile.albedo = before;
    return profile;
}

/// Mean free path over the width of Burley's profile at which the edge responses differ least.
double nearest_path(double albedo, double boundary)
{
    const DiffusionProfile burley = profile_from([](double r) { return left_within(r, 1); });
    std::vector<std::array<double, 2>> wanted; // x and brightness, x even in its logarithm
    for (double x = .02; x < 40; x *= 1.3)
        wanted.push_back({x, burley.beyond_edge(x)});
    const auto misfit = [&](double path) {
        const Dipole dipole({albedo, 1 / path, boundary});
        const double total = dipole.total();
        const DiffusionProfile profile = profile_from([&](double r) { return dipole.within(r) / total; });
        double squares = 0;
        for (const auto& [x, brightness] : wanted)
            squares += x * std::pow(profile.beyond_edge(x) - brightness, 2);
        return squares;
    };
    double low = std::log(.02), high = std::log(20.);
    constexpr double golden = 0.6180339887498949;
    while (high - low > 1e-3) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (misfit(std::exp(a)) < misfit(std::exp(b)))
            high = b;
        else
            low = a;
    }
    return std::exp((low + high) / 2);
}

} // namespace

DipoleInversion::DipoleInversion(double refractive_index) : boundary_(boundary_factor(refractive_index))
{
    for (std::size_t i = 0; i < albedo_nodes; ++i) {
        const double diffuse = std::clamp(double(i) / (albedo_nodes - 1), 1e-3, largest_albedo);
        const double albedo = inverted(diffuse, boundary_);
        nodes_.push_back({albedo, nearest_path(albedo, boundary_)});
    }
}

Dipole DipoleInversion::dipole_of(double albedo, double scattering_length) const
{
    const double diffuse = std::clamp(albedo, 1e-3, largest_albedo), place = diffuse * (albedo_nodes - 1);
    const auto i = std::min(std::size_t(place), albedo_nodes - 2);
    const double share = place - double(i);
    const double path_over_width = std::lerp(nodes_[i].path_over_width, nodes_[i + 1].path_over_width, share);
    Dipole dipole({std::lerp(nodes_[i].albedo, nodes_[i + 1].albedo, share),
                   1 / (path_over_width * diffusion_width(diffuse, scattering_length)), boundary_});
    dipole.strength *= diffuse / dipole.total(); // between the nodes alpha' is off by a little
    return dipole;
}

} // namespace optics
