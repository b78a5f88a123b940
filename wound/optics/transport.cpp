#include "wound/optics/transport.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

#include "wound/optics/diffusion_profile.hpp"

namespace optics {
namespace {

constexpr double least_width_m = 1e-6; // where no light enters

bool same_layers(const SkinLayers& a, const SkinLayers& b)
{
    return a.n_above == b.n_above && a.n_below == b.n_below &&
           std::ranges::equal(a.layers, b.layers, [](const Layer& x, const Layer& y) {
               return x.sigma_a == y.sigma_a && x.sigma_s_reduced == y.sigma_s_reduced && x.g == y.g &&
                      x.n == y.n && x.thickness_mm == y.thickness_mm;
           });
}

TissueSpread walked_spread(const SkinLayers& tissue)
{
    const std::uint64_t photons = tissue.channels() > 3 ? 400 : 4000; // of each wavelength
    const auto profiles = diffusion_profile(tissue, {.photons = photons});
    TissueSpread spread;
    for (int c = 0; c < 3; ++c)
        if (const DiffusionProfile& profile = profiles[std::size_t(c)]; profile.albedo > 1e-3) {
            spread.scattering_length_mm[c] = std::max(profile.radius_mm, 0.0) / (2.5 * profile.albedo);
            spread.width_mm[c] = diffusion_width(profile.albedo, spread.scattering_length_mm[c]);
        }
    return spread;
}

double squared(double x)
{
    return x * x;
}

/// Schlick's 1 - F over its cosine-weighted mean.
double through_gloss(double cosine)
{
    const double f0 = shared::SKIN_F0, mean = f0 + (1 - f0) / 21;
    return (1 - f0) * (1 - std::pow(std::clamp(1 - cosine, 0., 1.), 5)) / (1 - mean);
}

double width_m(const ShadedPoint& point, double albedo, int channel)
{
    return std::max(diffusion_width(albedo, 1e-3 * point.scattering_length_mm[channel]), least_width_m);
}

base::Color spread(const Shading& shading, const ShadedPoint& point, const cv::Vec3d& to_light,
                   const cv::Vec3d& incident, double visibility, const ShadowMap& map)
{
    const double facing = point.smooth ? point.smooth->dot(to_light) : incident[2];
    base::Color sum;
    for (int c = 0; c < 3; ++c) {
        const double albedo = shading.rho_d * point.albedo[c];
        const double width = width_m(point, albedo, c);
        const double cosine = std::lerp(facing, incident[2], detail_left(width));
        const double received = shading.transport == Transport::Diffused
                                    ? std::max(incident[2], 0.0) * visibility
                                    : received_bent(cosine, point.curvature[1] * width) *
                                          softened(visibility, width, map.filter_m);
        const double reflected = albedo * bend_gain(albedo, point.curvature[0] * width) * received;
        const double through = // nothing passes what no light enters
            width > least_width_m ? std::max(0.0, -facing) * passed(map.through_m, width) : 0;
        sum[c] = std::max(reflected, through);
    }
    return sum;
}

/// Beside what is lit, what comes through a thin part, before both spread in the picture.
base::Color lit_and_passed(const Shading& shading, const ShadedPoint& point, const cv::Vec3d& to_light,
                           const cv::Vec3d& incident, double visibility, const ShadowMap& map)
{
    const double facing = point.smooth ? point.smooth->dot(to_light) : incident[2];
    base::Color sum;
    for (int c = 0; c < 3; ++c) {
        const double albedo = shading.rho_d * point.albedo[c];
        const double through = 1 - left_within(map.through_m, width_m(point, albedo, c));
        sum[c] = albedo * (std::max(incident[2], 0.) * visibility + std::max(-facing, 0.) * through);
    }
    return sum;
}

} // namespace

TissueSpread tissue_spread(const SkinLayers& tissue)
{
    static std::mutex mutex;
    static std::vector<std::pair<SkinLayers, TissueSpread>> known;
    {
        const std::scoped_lock lock(mutex);
        for (const auto& [layers, spread] : known)
            if (same_layers(layers, tissue))
                return spread;
    }
    const TissueSpread spread = walked_spread(tissue);
    const std::scoped_lock lock(mutex);
    if (known.size() >= 16)
        known.erase(known.begin());
    known.emplace_back(tissue, spread);
    return spread;
}

base::Color scattering_length_mm(const SkinLayers& tissue)
{
    return tissue_spread(tissue).scattering_length_mm;
}

double diffusion_width(double albedo, double scattering_length)
{
    return albedo * scattering_length;
}

double left_within(double radius, double width)
{
    const double t = std::exp(-radius / (3 * width));
    return 1 - t * (t * t + 3) / 4;
}

const std::array<cv::Vec3d, shared::DIFFUSION_TAPS>& diffusion_taps()
{
    static const auto known = [] {
        std::array<cv::Vec3d, shared::DIFFUSION_TAPS> taps;
        const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
        for (std::size_t k = 0; k < taps.size(); ++k) {
            // t = e^(-r/3) solves (t^3 + 3 t) / 4 = share beyond r.
            const double beyond = 1 - (double(k) + 0.5) / double(taps.size());
            const double root = std::cbrt(2 * beyond + std::sqrt(4 * beyond * beyond + 1));
            const double t = root - 1 / root, radius = -3 * std::log(t), angle = golden_angle * double(k);
            taps[k] = {radius * std::cos(angle), radius * std::sin(angle), radius / (t * t * t + t)};
        }
        return taps;
    }();
    return known;
}

double received_bent(double cosine, double turn)
{
    const double within = squared(std::min(turn, 0.25)), bend = within / (1 + 7 * within);
    const double peak = 1 - 7 * bend; // where the ball faces the light; sqrt(bend) at the terminator
    const double slope = peak - bend / peak;
    return (slope * cosine + std::sqrt(squared(slope * cosine) + 4 * bend)) / 2;
}

double bend_gain(double albedo, double turn)
{
    const double more = std::max(5.6 - 6.6 * albedo, 0.0) * std::clamp(turn, -0.25, 0.25);
    return more >= 0 ? 1 + more : 1 / (1 - more);
}

// The edge response of Burley's profile is near .5 / (1 + u / .8) at u widths from the edge (.31 at .5, .22
// at 1; .14 instead of .13 at 2). This is it over its values at the filter's ends.
double softened(double visibility, double width, double filter)
{
    const double side = 2 * visibility - 1, blur = 0.8 * width / filter + 1e-4;
    return 0.5 + 0.5 * side * (1 + blur) / (std::abs(side) + blur);
}

double passed(double thickness, double width)
{
    return std::exp(-thickness / (3 * width));
}

double surroundings_passed(double albedo, double thickness, double width)
{
    const double a = std::clamp(albedo, 1e-3, .99);
    const double share = std::exp(-thickness * (1 - std::pow(a, 2.5)) / (3 * width));
    return (1 - a * a) * share / (a * (1 + a * share));
}

base::Color surroundings_left(const Shading& shading, const ShadedPoint& point, const base::Color& seen)
{
    if (shading.transport != Transport::Preintegrated && shading.transport != Transport::Diffused)
        return seen;
    base::Color left;
    for (int c = 0; c < 3; ++c) {
        const double albedo = shading.rho_d * point.albedo[c], width = width_m(point, albedo, c);
        const double gain = bend_gain(albedo, point.curvature[0] * width);
        const double through = width > least_width_m && point.thinness > 0
                                   ? surroundings_passed(albedo, 1 / point.thinness, width)
                                   : 0;
        left[c] = seen[c] * std::min(gain, 1.) + std::max(seen[c] * (gain - 1), through);
    }
    return left;
}

double layered_oren_nayar(const cv::Vec3d& i, const cv::Vec3d& o, double sigma)
{
    if (i[2] <= 0)
        return 0;
    const double theta_i = std::acos(std::min(i[2], 1.)), theta_o = std::acos(std::clamp(o[2], 1e-4, 1.));
    const double turn = std::atan2(i[1], i[0]) - std::atan2(o[1], o[0]);
    const double variance = squared(sigma), a = 1 - .5 * variance / (variance + .57),
                 b = .45 * variance / (variance + .09);
    const double rough = a + b * std::max(0., std::cos(turn)) * std::sin(std::max(theta_i, theta_o)) *
                                 std::tan(std::min(theta_i, theta_o));
    return rough * through_gloss(std::cos(theta_i)) * through_gloss(std::cos(theta_o));
}

// Share of the light that leaves within PORE_WIDTH, about.
double detail_left(double width_m)
{
    return shared::PORE_WIDTH / (shared::PORE_WIDTH + 1.6 * width_m);
}

base::Color leaving(const Shading& shading, const ShadedPoint& point, const cv::Vec3d& to_light,
                    const cv::Vec3d& incident, double visibility, const ShadowMap& map)
{
    if (shading.transport == Transport::Preintegrated || shading.transport == Transport::Diffused)
        return spread(shading, point, to_light, incident, visibility, map);
    if (shading.transport == Transport::Separable || shading.transport == Transport::Burley)
        return lit_and_passed(shading, point, to_light, incident, visibility, map);
    if (shading.transport == Transport::OrenNayar)
        return shading.rho_d * visibility *
               layered_oren_nayar(incident, point.frame * point.to_viewer, shared::FACET_SLOPE) *
               std::max(0.0, incident[2]) / shared::FACETS_RETURN * point.albedo;
    return shading.rho_d * visibility * std::max(0.0, incident[2]) * point.albedo;
}

} // namespace optics
