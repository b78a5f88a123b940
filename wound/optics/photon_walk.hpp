// One photon after another through layered tissue: Henyey-Greenstein scattering, exact Fresnel reflection at
// every boundary, Russian roulette. What monte_carlo.cpp and diffusion_profile.cpp share.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "wound/optics/fresnel.hpp"
#include "wound/optics/reflectance.hpp" // Incidence

namespace optics {

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

// A layer as the walk needs it.
struct Medium
{
    double extinction, survival, g, n, thickness; // survival: albedo
};

struct Photon
{
    double weight, cosine; // cosine > 0: downward
    double z;              // mm below the top of its layer
    std::ptrdiff_t layer;
    // With Track::Surface: mm from where it came in, and the direction's components along them.
    double x = 0, y = 0, along_x = 0, along_y = 0;
};

// What came back of a photon, what went through, and how far from its entry it came back.
struct Returned
{
    double reflected = 0, transmitted = 0;
    double radius_mm = 0; // with Track::Surface
};

enum class Track
{
    Depth,  // by symmetry the azimuth of the direction does not matter to how much comes back
    Surface // but it does to where
};

template <Track track>
class PhotonWalk
{
  public:
    PhotonWalk(const Stack& stack, Incidence incidence)
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

    /// Sends one photon, less what the first surface reflects.
    Returned send(Random& random)
    {
        double outside = 1, passed = 1 - fresnel(n_above_, n_first_, 1);
        if (incidence_ == Incidence::Diffuse) {
            // Cosine-weighted, and of those only the ones that get in; the weight is what gets in on the
            // whole.
            do
                outside = std::sqrt(1 - random());
            while (random() < fresnel(n_above_, n_first_, outside));
            passed = 1 - diffuse_fresnel(n_above_, n_first_);
        }
        if (media_.empty())
            return {0, passed};
        const double ratio = n_above_ / n_first_;
        photon_ = {passed, std::sqrt(std::max(0.0, 1 - ratio * ratio * (1 - outside * outside))), 0, 0};
        if constexpr (track == Track::Surface)
            photon_.along_x = std::sqrt(std::max(0.0, 1 - photon_.cosine * photon_.cosine));
        while (photon_.weight > 0) {
            const std::ptrdiff_t side = step(random);
            if (side < 0)
                return {photon_.weight, 0, std::hypot(photon_.x, photon_.y)};
            if (side > 0)
                return {0, photon_.weight};
        }
        return {};
    }

    const std::vector<double>& absorbed() const { return absorbed_; }

  private:
    // To the next scattering event or boundary. Returns -1 when the photon left upward, +1 downward, else 0.
    std::ptrdiff_t step(Random& random)
    {
        const Medium& medium = media_[static_cast<std::size_t>(photon_.layer)];
        const bool down = photon_.cosine > 0;
        const double free_path = -std::log(1 - random()) / medium.extinction; // infinite in a clear layer
        const double z = photon_.z + free_path * photon_.cosine;
        if (down ? z < medium.thickness : z > 0) {
            photon_.z = z;
            move_along(free_path);
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
        const double deflection = henyey_greenstein_cosine(medium.g, random());
        const double phi = 2 * std::numbers::pi * random(), azimuth = std::cos(phi);
        const double c = photon_.cosine;
        const double turned =
            c * deflection + std::sqrt(std::max(0.0, (1 - c * c) * (1 - deflection * deflection))) * azimuth;
        turn_along(deflection, phi);
        photon_.cosine = std::clamp(turned, -1.0, 1.0);
    }

    void move_along(double path)
    {
        if constexpr (track == Track::Surface) {
            photon_.x += path * photon_.along_x;
            photon_.y += path * photon_.along_y;
        }
    }

    // The rest of the new direction; `cosine` is still the old one's.
    void turn_along(double deflection, double phi)
    {
        if constexpr (track == Track::Surface) {
            const double azimuth_cosine = std::cos(phi), azimuth_sine = std::sin(phi);
            const double c = photon_.cosine, x = photon_.along_x, y = photon_.along_y;
            const double across = std::sqrt(std::max(0.0, 1 - deflection * deflection)), s = std::hypot(x, y);
            const double ux = s > 1e-9 ? x / s : 1, uy = s > 1e-9 ? y / s : 0;
            // In the frame of the direction, of (-c u, s) towards the vertical and of u turned by 90 degrees.
            photon_.along_x = deflection * x - across * (azimuth_cosine * c * ux + azimuth_sine * uy);
            photon_.along_y = deflection * y - across * (azimuth_cosine * c * uy - azimuth_sine * ux);
        }
    }

    std::ptrdiff_t cross(const Medium& medium, bool down, Random& random)
    {
        const std::ptrdiff_t next = photon_.layer + (down ? 1 : -1),
                             last = static_cast<std::ptrdiff_t>(media_.size());
        const double n_next = next < 0       ? n_above_
                              : next == last ? n_below_
                                             : media_[static_cast<std::size_t>(next)].n;
        const double c = std::abs(photon_.cosine);
        if constexpr (track == Track::Surface)
            move_along(((down ? medium.thickness : 0) - photon_.z) / photon_.cosine);
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
            photon_.along_x *= ratio;
            photon_.along_y *= ratio;
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

} // namespace optics
