#include "reference/tissue.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/input_error.hpp"
#include "wound/optics/diffusion_profile.hpp"

namespace reference {
namespace {
using nlohmann::json;
using optics::DiffusionProfile;

constexpr int reduction_version = 1;  // goes up when reduce() gives other numbers
constexpr double least_albedo = 1e-3; // of what is blacker, no profile can be told

/// Whose mean free path is 1 mm.
DiffusionProfile profile_of_medium(double single_albedo, const MediumChoice& choice, std::uint64_t photons)
{
    const double g = choice.anisotropy;
    const optics::LayerOptics layer{.sigma_a = 1 - single_albedo,
                                    .sigma_s_reduced = single_albedo * (1 - g),
                                    .g = g,
                                    .n = choice.index,
                                    .thickness_mm = std::numeric_limits<double>::infinity()};
    return optics::diffusion_profile({.layers = {layer}, .n_above = 1, .n_below = choice.index},
                                     {.photons = photons});
}

struct Fit
{
    double mean_free_path_mm, worst;
};
struct Misfit
{
    double squares = 0, worst = 0;
};

/// Brightness at distances from the border of a half-lit plane. The distances are even in their logarithm, so
/// that dx is in proportion to x.
struct EdgeResponse
{
    std::vector<double> x_mm, brightness;

    explicit EdgeResponse(const DiffusionProfile& layers)
    {
        for (double x = .01; x < 20; x *= 1.15) {
            x_mm.push_back(x);
            brightness.push_back(layers.beyond_edge(x));
        }
    }
};

Misfit misfit(const EdgeResponse& layers, const DiffusionProfile& medium, double mean_free_path_mm)
{
    Misfit result;
    for (std::size_t i = 0; i < layers.x_mm.size(); ++i) {
        const double x_mm = layers.x_mm[i];
        const double off = layers.brightness[i] - medium.beyond_edge(x_mm / mean_free_path_mm);
        result.squares += off * off * x_mm;
        result.worst = std::max(result.worst, std::abs(off));
    }
    return result;
}

Fit fit(const EdgeResponse& layers, const DiffusionProfile& medium)
{
    constexpr double shortest_mm = 1e-3, longest_mm = 100, step = 1.01;
    Fit best{shortest_mm, 0};
    double least = std::numeric_limits<double>::max();
    for (double path = shortest_mm; path < longest_mm; path *= step)
        if (const Misfit found = misfit(layers, medium, path); found.squares < least) {
            least = found.squares;
            best = {path, found.worst};
        }
    return best;
}

std::uint64_t key_of(const optics::SkinLayers& layers, const MediumChoice& choice, std::uint64_t photons)
{
    base::Hash hash;
    hash.add(reduction_version).add(photons).add(choice.anisotropy).add(choice.index);
    hash.add(layers.n_above).add(layers.n_below).add(layers.layers.size());
    for (const optics::Layer& layer : layers.layers) {
        hash.add(layer.g).add(layer.n).add(layer.thickness_mm).add(layer.sigma_a.size());
        for (const double sigma : layer.sigma_a)
            hash.add(sigma);
        for (const double sigma : layer.sigma_s_reduced)
            hash.add(sigma);
    }
    return hash.value();
}

json list(const base::Color& color)
{
    return {color[0], color[1], color[2]};
}

/// Throws json::exception for what is missing or not three numbers.
base::Color color_from(const json& object, const char* name)
{
    const json& values = object.at(name);
    return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

} // namespace

void to_json(json& to, const ReducedTissue& tissue)
{
    to = {{"albedo", list(tissue.albedo)},
          {"mean_free_path_mm", list(tissue.mean_free_path_mm)},
          {"diffuse_mean_free_path_mm", list(tissue.diffuse_mean_free_path_mm)},
          {"worst_edge", list(tissue.worst_edge)},
          {"scattering_per_m", list(tissue.scattering_per_m)}};
}

void from_json(const json& from, ReducedTissue& tissue)
{
    tissue = {color_from(from, "albedo"), color_from(from, "mean_free_path_mm"),
              color_from(from, "diffuse_mean_free_path_mm"), color_from(from, "worst_edge"),
              color_from(from, "scattering_per_m")};
}

Medium medium_of(const base::Color& scattering_per_m, const base::Color& single_albedo,
                 const MediumChoice& choice)
{
    Medium medium{.single_albedo = single_albedo, .g = choice.anisotropy, .n = choice.index};
    for (int c = 0; c < 3; ++c)
        medium.extinction[c] = scattering_per_m[c] / std::max(single_albedo[c], .05);
    return medium;
}

ReducedTissue reduce(const optics::SkinLayers& layers, const AlbedoTable& table, const MediumChoice& choice,
                     std::uint64_t photons)
{
    const auto profiles = optics::diffusion_profile(layers, {.photons = photons});
    ReducedTissue reduced;
    for (int c = 0; c < 3; ++c) {
        const DiffusionProfile& profile = profiles[std::size_t(c)];
        reduced.albedo[c] = std::clamp(profile.albedo, least_albedo, AlbedoTable::largest_diffuse);
        const double single = table.single_of(reduced.albedo[c]);
        const Fit found = profile.albedo < least_albedo
                              ? Fit{.05, 0}
                              : fit(EdgeResponse(profile), profile_of_medium(single, choice, 50'000));
        reduced.mean_free_path_mm[c] = found.mean_free_path_mm;
        reduced.scattering_per_m[c] = single / (1e-3 * found.mean_free_path_mm);
        reduced.worst_edge[c] = found.worst;
        const double absorption = 1 - single, scattering = single * (1 - choice.anisotropy);
        reduced.diffuse_mean_free_path_mm[c] =
            found.mean_free_path_mm / std::sqrt(3 * absorption * (absorption + scattering));
    }
    return reduced;
}

ReducedTissue kept_reduction(const std::filesystem::path& folder, const optics::SkinLayers& layers,
                             const AlbedoTable& table, const MediumChoice& choice)
{
    const std::uint64_t photons = layers.channels() > 3 ? 10'000 : 100'000;
    const std::filesystem::path path =
        folder / fmt::format("medium-{:016x}.json", key_of(layers, choice, photons));
    try {
        return base::read_json(path).get<ReducedTissue>();
    } catch (const base::InputError&) {
        // not there yet
    } catch (const json::exception&) {
        // somebody else's: it is replaced
    }
    const ReducedTissue reduced = reduce(layers, table, choice, photons);
    try {
        base::make_folder(folder);
        base::write_json(path, reduced);
    } catch (const base::InputError&) {
        // the next run takes as long
    }
    return reduced;
}

} // namespace reference
