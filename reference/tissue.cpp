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

/// Even in the logarithm of the distance, so that dx is in proportion to x.
Misfit misfit(const DiffusionProfile& layers, const DiffusionProfile& medium, double mean_free_path_mm)
{
    Misfit result;
    for (double x_mm = .01; x_mm < 20; x_mm *= 1.15) {
        const double off = layers.beyond_edge(x_mm) - medium.beyond_edge(x_mm / mean_free_path_mm);
        result.squares += off * off * x_mm;
        result.worst = std::max(result.worst, std::abs(off));
    }
    return result;
}

Fit fit(const DiffusionProfile& layers, const DiffusionProfile& medium)
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

json to_json(const base::Color& color)
{
    return {color[0], color[1], color[2]};
}

/// Throws json::exception for what is not there or no three numbers.
base::Color color_from(const json& object, const char* name)
{
    const json& list = object.at(name);
    return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

} // namespace

Medium ReducedTissue::with_albedo(const base::Color& diffuse, const AlbedoTable& table,
                                  const MediumChoice& choice) const
{
    Medium medium{.g = choice.anisotropy, .n = choice.index};
    medium.single_albedo = table.single_of(diffuse);
    for (int c = 0; c < 3; ++c) {
        const double scattering = table.single_of(albedo[c]) / (1e-3 * mean_free_path_mm[c]);
        medium.extinction[c] = scattering / std::max(medium.single_albedo[c], .05);
    }
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
                              : fit(profile, profile_of_medium(single, choice, 50'000));
        reduced.mean_free_path_mm[c] = found.mean_free_path_mm;
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
        const json kept = base::read_json(path);
        return {color_from(kept, "albedo"), color_from(kept, "mean_free_path_mm"),
                color_from(kept, "diffuse_mean_free_path_mm"), color_from(kept, "worst_edge")};
    } catch (const base::InputError&) {
        // not there yet
    } catch (const json::exception&) {
        // somebody else's: it is replaced
    }
    const ReducedTissue reduced = reduce(layers, table, choice, photons);
    try {
        base::make_folder(folder);
        base::write_json(path, {{"albedo", to_json(reduced.albedo)},
                                {"mean_free_path_mm", to_json(reduced.mean_free_path_mm)},
                                {"diffuse_mean_free_path_mm", to_json(reduced.diffuse_mean_free_path_mm)},
                                {"worst_edge", to_json(reduced.worst_edge)}});
    } catch (const base::InputError&) {
        // the next run takes as long
    }
    return reduced;
}

} // namespace reference
