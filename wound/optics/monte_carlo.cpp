#include "wound/optics/monte_carlo.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <mutex>

#include "base/input_error.hpp"
#include "base/parallel.hpp"
#include "wound/optics/photon_walk.hpp"

namespace optics {

namespace {

struct Tally
{
    double reflected = 0, reflected_squared = 0, transmitted = 0;
    std::vector<double> absorbed;

    void add(const Returned& photon)
    {
        reflected += photon.reflected;
        reflected_squared += photon.reflected * photon.reflected;
        transmitted += photon.transmitted;
    }
};

// Estimated steps of one photon in a layer, within a factor of about two for the first layer. Without
// absorption diffuse light fills the tissue evenly, so its path in a layer is 4 n^2 d for any scattering
// (Blanco & Fournier 2003, "An invariance property of diffusive random walks"). A photon lives until its
// weight is 1e-3 = exp(-7), so in a thick layer it reaches the diffusion length at 1/7 of the absorption.
double steps_in(const LayerOptics& layer, double n_above)
{
    const double extinction = layer.sigma_a + layer.sigma_s_reduced / (1 - std::clamp(layer.g, -0.99, 0.99));
    const double reach = std::sqrt(7 / (3 * layer.sigma_a * (layer.sigma_a + layer.sigma_s_reduced)));
    const double depth = std::min(layer.thickness_mm, reach), index = layer.n / n_above;
    return extinction > 0 && depth > 0 ? 4 * index * index * depth * extinction : 0;
}

} // namespace

void check_walk_cost(const Stack& stack, std::uint64_t photons)
{
    double steps = 0;
    for (const LayerOptics& layer : stack.layers)
        steps += steps_in(layer, stack.n_above);
    const double allowed = most_walk_steps / steps;
    if (static_cast<double>(photons) <= allowed)
        return;
    const std::string what =
        std::isinf(steps)
            ? "a photon's walk through an infinite layer without absorption never ends"
            : fmt::format("{} photons of about {:.0e} steps each would take hours", photons, steps);
    const double digit = std::pow(10, std::floor(std::log10(allowed))); // round to one significant digit
    throw base::InputError("monte-carlo", what,
                           allowed >= 1000 ? fmt::format("use {:.0f} photons or fewer, or adding-doubling",
                                                         std::floor(allowed / digit) * digit)
                                           : "use adding-doubling");
}

Response monte_carlo(const Stack& stack, const ReflectanceOptions& options)
{
    constexpr std::uint64_t per_batch = 10'000;
    const std::uint64_t photons = std::max<std::uint64_t>(options.photons, 1);
    check_walk_cost(stack, photons);
    const std::uint64_t batches = (photons + per_batch - 1) / per_batch;
    std::vector<Tally> tallies(batches);
    std::uint64_t finished = 0;
    std::mutex mutex;
    base::in_parallel(batches, options.threads, [&](std::size_t b) {
        Random random(options.seed, b);
        PhotonWalk<Track::Depth> walk(stack, options.incidence);
        for (std::uint64_t i = b * per_batch; i < std::min(photons, (b + 1) * per_batch); ++i)
            tallies[b].add(walk.send(random));
        tallies[b].absorbed = walk.absorbed();
        const std::lock_guard lock(mutex);
        ++finished;
        if (options.progress)
            options.progress(static_cast<double>(finished) / static_cast<double>(batches));
    });

    // Summed in the order of the batches, so that the result does not depend on the threads' order.
    Tally total;
    total.absorbed.assign(stack.layers.size(), 0);
    for (const Tally& tally : tallies) {
        total.reflected += tally.reflected;
        total.reflected_squared += tally.reflected_squared;
        total.transmitted += tally.transmitted;
        for (std::size_t i = 0; i < total.absorbed.size(); ++i)
            total.absorbed[i] += tally.absorbed[i];
    }
    const auto n = static_cast<double>(photons);
    Response response;
    response.r_without_specular = total.reflected / n;
    response.r = response.r_without_specular + specular_reflectance(stack, {.incidence = options.incidence});
    response.t = total.transmitted / n;
    for (double absorbed : total.absorbed)
        response.absorbed.push_back(absorbed / n);
    const double mean = total.reflected / n;
    response.standard_error = std::sqrt(std::max(0.0, total.reflected_squared / n - mean * mean) / n);
    return response;
}

} // namespace optics
