#include "wound/optics/diffusion_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parallel.hpp"
#include "wound/optics/monte_carlo.hpp"
#include "wound/optics/photon_walk.hpp"
#include "wound/optics/spectrum.hpp"

namespace optics {
namespace {

constexpr double first_end_mm = 1e-3, growth = 1.05;

std::size_t ring_of(double radius_mm)
{
    if (radius_mm <= first_end_mm)
        return 0;
    const double ring = std::ceil(std::log(radius_mm / first_end_mm) / std::log(growth));
    return std::min(std::size_t(ring), DiffusionProfile::ring_count - 1);
}

DiffusionProfile empty_profile()
{
    DiffusionProfile profile;
    profile.rings.assign(DiffusionProfile::ring_count, 0);
    return profile;
}

/// radius_mm holds the moment, not yet divided by the albedo.
void add(DiffusionProfile& sum, const DiffusionProfile& part, double weight)
{
    for (std::size_t i = 0; i < sum.rings.size(); ++i)
        sum.rings[i] += weight * part.rings[i];
    sum.albedo += weight * part.albedo;
    sum.radius_mm += weight * part.radius_mm;
}

} // namespace

double DiffusionProfile::ring_end_mm(std::size_t ring)
{
    return first_end_mm * std::pow(growth, double(ring));
}

double DiffusionProfile::within(double r_mm) const
{
    const std::size_t ring = ring_of(r_mm);
    const double begin = ring == 0 ? 0 : ring_end_mm(ring - 1);
    const double share = std::clamp((r_mm - begin) / (ring_end_mm(ring) - begin), 0.0, 1.0);
    return (std::accumulate(rings.begin(), rings.begin() + std::ptrdiff_t(ring), 0.0) + share * rings[ring]) /
           albedo;
}

double DiffusionProfile::beyond_edge(double x_mm) const
{
    double sum = 0; // of a circle of radius r about the point, this much lies beyond the border
    for (std::size_t i = ring_of(x_mm); i < rings.size(); ++i) {
        const double r = i == 0 ? ring_end_mm(0) / 2 : (ring_end_mm(i - 1) + ring_end_mm(i)) / 2;
        if (r > x_mm)
            sum += rings[i] * std::acos(x_mm / r) / std::numbers::pi;
    }
    return sum / albedo;
}

DiffusionProfile diffusion_profile(const Stack& stack, const ReflectanceOptions& options)
{
    constexpr std::uint64_t per_batch = 1000;
    const std::uint64_t photons = std::max<std::uint64_t>(options.photons, 1);
    check_walk_cost(stack, photons);
    std::vector<DiffusionProfile> batches((photons + per_batch - 1) / per_batch, empty_profile());
    base::in_parallel(batches.size(), options.threads, [&](std::size_t b) {
        Random random(options.seed, b);
        PhotonWalk<Track::Surface> walk(stack, Incidence::Diffuse);
        for (std::uint64_t i = b * per_batch; i < std::min(photons, (b + 1) * per_batch); ++i) {
            const Returned photon = walk.send(random);
            batches[b].rings[ring_of(photon.radius_mm)] += photon.reflected;
            batches[b].albedo += photon.reflected;
            batches[b].radius_mm += photon.reflected * photon.radius_mm;
        }
    });
    const double entered =
        1 - diffuse_fresnel(stack.n_above, stack.layers.empty() ? stack.n_below : stack.layers.front().n);
    DiffusionProfile profile = empty_profile();
    for (const DiffusionProfile& batch : batches) // in order, so that the threads' order does not show
        add(profile, batch, 1 / (entered * double(photons)));
    profile.radius_mm /= profile.albedo > 0 ? profile.albedo : 1;
    return profile;
}

std::array<DiffusionProfile, 3> diffusion_profile(const SkinLayers& tissue, const ReflectanceOptions& options)
{
    const std::span<const base::Color> weights = channel_weights(tissue.channels());
    assert(!weights.empty());
    std::array<DiffusionProfile, 3> profiles{empty_profile(), empty_profile(), empty_profile()};
    // Of many wavelengths each is a short walk: they share the threads.
    std::vector<DiffusionProfile> parts(tissue.channels());
    const bool spectral = parts.size() > profiles.size();
    ReflectanceOptions alone = options;
    if (spectral)
        alone.threads = 1;
    base::in_parallel(parts.size(), spectral ? options.threads : 1,
                      [&](std::size_t i) { parts[i] = diffusion_profile(tissue.channel(i), alone); });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        DiffusionProfile& profile = parts[i];
        profile.radius_mm *= profile.albedo;
        for (int c = 0; c < 3; ++c)
            add(profiles[std::size_t(c)], profile, weights[i][c]);
    }
    for (DiffusionProfile& profile : profiles)
        profile.radius_mm /= profile.albedo > 0 ? profile.albedo : 1;
    return profiles;
}

} // namespace optics
