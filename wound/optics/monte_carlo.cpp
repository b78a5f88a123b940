#include "wound/optics/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <mutex>
#include <numbers>
#include <thread>
#include <utility>

#include "base/input_error.hpp"
#include "wound/optics/fresnel.hpp"

namespace optics {

namespace {

// xoshiro256+ (Blackman & Vigna 2018), seeded through splitmix64; one generator per batch of photons.
class Random
{
  public:
    Random(std::uint64_t seed, std::uint64_t stream)
    {
        std::uint64_t x = seed * 0x9E3779B97F4A7C15u ^ (stream + 1) * 0xD1B54A32D192ED03u;
        for (std::uint64_t& word : state_) {
            x += 0x9E3779B97F4A7C15u;
            std::uint64_t z = x;
            z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
            z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
            word = z ^ (z >> 31);
        }
    }
    /// Uniform in [0, 1).
    double operator()()
    {
        const std::uint64_t result = state_[0] + state_[3], t = state_[1] << 17;
        state_[2] ^= state_[0];
        state_[3] ^= state_[1];
        state_[1] ^= state_[2];
        state_[0] ^= state_[3];
        state_[2] ^= t;
        state_[3] = std::rotl(state_[3], 45);
        return static_cast<double>(result >> 11) * 0x1p-53;
    }

  private:
    std::array<std::uint64_t, 4> state_;
};

struct Tally
{
    double reflected = 0, reflected_squared = 0, transmitted = 0;
    std::vector<double> absorbed;
};

// A layer; lengths in mm, `survival` is the single-scattering albedo.
struct Medium
{
    double extinction, survival, g, n, thickness;
};

struct Photon
{
    double weight, cosine; // cosine > 0: downward
    double z;              // mm below the top of its layer
    std::ptrdiff_t layer;
};

// The walk tracks depth only: by symmetry the azimuth of the direction does not matter.
class Walk
{
  public:
    Walk(const Stack& stack, Incidence incidence)
        : incidence_(incidence), n_above_(stack.n_above), n_below_(stack.n_below),
          n_first_(stack.layers.empty() ? stack.n_below : stack.layers.front().n),
          absorbed_(stack.layers.size())
    {
        for (const LayerOptics& layer : stack.layers) {
            const double g = std::clamp(layer.g, -0.99, 0.99);
            const double sigma_s = layer.sigma_s_reduced / (1 - g), extinction = layer.sigma_a + sigma_s;
            media_.push_back(
                {extinction, extinction > 0 ? sigma_s / extinction : 0, g, layer.n, layer.thickness_mm});
        }
    }

    /// Sends one photon; adds its reflected and transmitted weight to the tally, without the reflection at
    /// the first surface.
    void send(Random& random, Tally& tally)
    {
        double outside = 1, passed = 1 - fresnel(n_above_, n_first_, 1);
        if (incidence_ == Incidence::Diffuse) {
            // Cosine-weighted, rejected by Fresnel reflectance; the weight is the mean transmittance.
            do
                outside = std::sqrt(1 - random());
            while (random() < fresnel(n_above_, n_first_, outside));
            passed = 1 - diffuse_fresnel(n_above_, n_first_);
        }
        if (media_.empty())
            return finish(tally, 0, passed);
        const double ratio = n_above_ / n_first_;
        photon_ = {passed, std::sqrt(std::max(0.0, 1 - ratio * ratio * (1 - outside * outside))), 0, 0};
        double reflected = 0, transmitted = 0;
        while (photon_.weight > 0) {
            const std::ptrdiff_t side = step(random);
            if (side < 0)
                reflected += std::exchange(photon_.weight, 0);
            else if (side > 0)
                transmitted += std::exchange(photon_.weight, 0);
        }
        finish(tally, reflected, transmitted);
    }

    const std::vector<double>& absorbed() const { return absorbed_; }

  private:
    static void finish(Tally& tally, double reflected, double transmitted)
    {
        tally.reflected += reflected;
        tally.reflected_squared += reflected * reflected;
        tally.transmitted += transmitted;
    }

    // To the next scattering event or boundary. Returns -1 if the photon left upward, 1 downward, or 0.
    std::ptrdiff_t step(Random& random)
    {
        const Medium& medium = media_[static_cast<std::size_t>(photon_.layer)];
        const bool down = photon_.cosine > 0;
        const double free_path = -std::log(1 - random()) / medium.extinction; // infinite in a clear layer
        const double z = photon_.z + free_path * photon_.cosine;
        if (down ? z < medium.thickness : z > 0) {
            photon_.z = z;
            scatter(medium, random);
            return 0;
        }
        return cross(medium, down, random);
    }

    void scatter(const Medium& medium, Random& random)
    {
        absorbed_[static_cast<std::size_t>(photon_.layer)] += photon_.weight * (1 - medium.survival);
        photon_.weight *= medium.survival;
        if (photon_.weight < 1e-3) { // roulette
            constexpr double chance = 0.1;
            photon_.weight = random() < chance ? photon_.weight / chance : 0;
        }
        // Cosine of the deflection after Henyey & Greenstein; isotropic within rounding for small g.
        const double xi = random(), g = medium.g;
        double deflection = 2 * xi - 1;
        if (std::abs(g) > 1e-6) {
            const double q = (1 - g * g) / (1 - g + 2 * g * xi);
            deflection = (1 + g * g - q * q) / (2 * g);
        }
        const double azimuth = std::cos(2 * std::numbers::pi * random());
        const double c = photon_.cosine;
        const double turned =
            c * deflection + std::sqrt(std::max(0.0, (1 - c * c) * (1 - deflection * deflection))) * azimuth;
        photon_.cosine = std::clamp(turned, -1.0, 1.0);
    }

    std::ptrdiff_t cross(const Medium& medium, bool down, Random& random)
    {
        const std::ptrdiff_t next = photon_.layer + (down ? 1 : -1),
                             last = static_cast<std::ptrdiff_t>(media_.size());
        const double n_next = next < 0       ? n_above_
                              : next == last ? n_below_
                                             : media_[static_cast<std::size_t>(next)].n;
        const double c = std::abs(photon_.cosine);
        if (n_next != medium.n) {
            const double r = fresnel(medium.n, n_next, c);
            if (r >= 1 || random() < r) {
                photon_.cosine = -photon_.cosine;
                photon_.z = down ? medium.thickness : 0;
                return 0;
            }
            const double ratio = medium.n / n_next;
            const double refracted = std::sqrt(std::max(0.0, 1 - ratio * ratio * (1 - c * c)));
            photon_.cosine = down ? refracted : -refracted;
        }
        if (next < 0)
            return -1;
        if (next == last)
            return 1;
        photon_.layer = next;
        photon_.z = down ? 0 : media_[static_cast<std::size_t>(next)].thickness;
        return 0;
    }

    Incidence incidence_;
    double n_above_, n_below_, n_first_;
    std::vector<Medium> media_;
    std::vector<double> absorbed_;
    Photon photon_{};
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

void check_cost(const Stack& stack, std::uint64_t photons)
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

} // namespace

Response monte_carlo(const Stack& stack, const ReflectanceOptions& options)
{
    constexpr std::uint64_t per_batch = 10'000;
    const std::uint64_t photons = std::max<std::uint64_t>(options.photons, 1);
    check_cost(stack, photons);
    const std::uint64_t batches = (photons + per_batch - 1) / per_batch;
    std::vector<Tally> tallies(batches);
    std::atomic<std::uint64_t> next{0};
    std::uint64_t finished = 0;
    std::mutex mutex;
    const auto work = [&] {
        for (std::uint64_t b; (b = next++) < batches;) {
            Random random(options.seed, b);
            Walk walk(stack, options.incidence);
            for (std::uint64_t i = b * per_batch; i < std::min(photons, (b + 1) * per_batch); ++i)
                walk.send(random, tallies[b]);
            tallies[b].absorbed = walk.absorbed();
            const std::lock_guard lock(mutex);
            ++finished;
            if (options.progress)
                options.progress(static_cast<double>(finished) / static_cast<double>(batches));
        }
    };
    const unsigned cores =
        options.threads ? options.threads : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads(std::min<std::uint64_t>(cores, batches) - 1);
    for (std::jthread& thread : threads)
        thread = std::jthread(work);
    work();
    threads.clear(); // joins

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
