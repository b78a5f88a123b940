#include "reference/single_albedo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wound/optics/adding_doubling.hpp"
#include "wound/optics/fresnel.hpp"

namespace reference {
namespace {

constexpr std::size_t last_node = 128;

/// Of what has entered, not of what arrives: light that the boundary turns away at once is the specular
/// lobe's.
double half_space_albedo(double single, double g, double n)
{
    // Any extinction will do: a half space has no scale. The reduced scattering goes in.
    const optics::LayerOptics layer{.sigma_a = 1 - single,
                                    .sigma_s_reduced = single * (1 - g),
                                    .g = g,
                                    .n = n,
                                    .thickness_mm = std::numeric_limits<double>::infinity()};
    const optics::Stack stack{.layers = {layer}, .n_above = 1, .n_below = n};
    const optics::Response response = optics::adding_doubling(stack, {.angles = 16});
    return response.r_without_specular / (1 - optics::diffuse_fresnel(1, n));
}

} // namespace

AlbedoTable::AlbedoTable(double g, double n)
{
    diffuse_.push_back(1);
    for (std::size_t i = 1; i < last_node; ++i) {
        const double root = double(i) / last_node;
        diffuse_.push_back(half_space_albedo(1 - root * root, g, n));
    }
    diffuse_.push_back(0);
}

double AlbedoTable::diffuse_of(double single) const
{
    const double place = std::sqrt(std::clamp(1 - single, 0.0, 1.0)) * last_node;
    const std::size_t node = std::min(std::size_t(place), last_node - 1);
    return std::lerp(diffuse_[node], diffuse_[node + 1], place - double(node));
}

double AlbedoTable::single_of(double diffuse) const
{
    const double wanted = std::clamp(diffuse, 0.0, largest_diffuse);
    const auto below = std::lower_bound(diffuse_.begin() + 1, diffuse_.end(), wanted, std::greater<>());
    const std::size_t node = std::min(std::size_t(below - diffuse_.begin()), last_node);
    const double share = (diffuse_[node - 1] - wanted) / (diffuse_[node - 1] - diffuse_[node]);
    const double root = (double(node - 1) + share) / last_node;
    return 1 - root * root;
}

base::Color AlbedoTable::single_of(const base::Color& diffuse) const
{
    return {single_of(diffuse[0]), single_of(diffuse[1]), single_of(diffuse[2])};
}

} // namespace reference
