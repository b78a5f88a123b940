// Random layered tissue over the whole range that the models must handle, and the corners of that range.
#pragma once
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "wound/optics/reflectance.hpp"

namespace random_tissue {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr optics::ReflectanceModel two_streams[] = {optics::ReflectanceModel::TwoStream,
                                                           optics::ReflectanceModel::TwoStreamPaper,
                                                           optics::ReflectanceModel::Calibrated};
inline constexpr optics::ReflectanceModel bounded[] = {
    optics::ReflectanceModel::TwoStream, optics::ReflectanceModel::TwoStreamPaper,
    optics::ReflectanceModel::Calibrated, optics::ReflectanceModel::Published,
    optics::ReflectanceModel::Exponential};

/// Quantities of a layer that may be zero; results must be continuous where each one goes to zero.
inline constexpr double optics::LayerOptics::*coefficients[] = {
    &optics::LayerOptics::sigma_a, &optics::LayerOptics::sigma_s_reduced, &optics::LayerOptics::thickness_mm};

/// All numbers are floats, so that single and double precision see the same tissue.
class Draw
{
  public:
    explicit Draw(unsigned seed) : random_(seed) {}

    double uniform(double low, double high)
    {
        return static_cast<float>(std::uniform_real_distribution(low, high)(random_));
    }
    int integer(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
    /// Log-uniform, with zero and the upper end drawn often.
    double coefficient(double high)
    {
        const int corner = integer(0, 9);
        if (corner < 2)
            return corner == 0 ? 0 : high;
        return static_cast<float>(std::exp(uniform(std::log(1e-9), std::log(high))));
    }
    double index() { return integer(0, 3) == 0 ? integer(1, 3) : uniform(1, 3); }
    optics::LayerOptics layer()
    {
        const double g = integer(0, 4) == 0 ? integer(-1, 1) : uniform(-1, 1);
        const double thickness = integer(0, 9) == 0 ? infinity : coefficient(1e9);
        return {coefficient(1e6), coefficient(1e6), g, index(), thickness};
    }
    optics::Stack stack(int most_layers = 5)
    {
        optics::Stack result{.layers = {}, .n_above = index(), .n_below = index()};
        for (int i = integer(1, most_layers); i > 0; --i)
            result.layers.push_back(layer());
        return result;
    }
    std::size_t place(const optics::Stack& stack)
    {
        return static_cast<std::size_t>(integer(0, static_cast<int>(stack.layers.size()) - 1));
    }
    /// The stack with one layer cut at a random depth.
    optics::Stack split(optics::Stack stack)
    {
        const auto at = stack.layers.begin() + static_cast<std::ptrdiff_t>(place(stack));
        const double part = uniform(1e-3, 1 - 1e-3);
        optics::LayerOptics upper = *at;
        upper.thickness_mm *= part;
        at->thickness_mm *= 1 - part;
        stack.layers.insert(at, upper);
        return stack;
    }
    /// The stack with a layer of zero thickness added above one of its layers. Both have the same refractive
    /// index, since a difference would add a boundary.
    optics::Stack with_empty_layer(optics::Stack stack)
    {
        const std::size_t at = place(stack);
        optics::LayerOptics empty = layer();
        empty.n = stack.layers[at].n;
        empty.thickness_mm = 0;
        stack.layers.insert(stack.layers.begin() + static_cast<std::ptrdiff_t>(at), empty);
        return stack;
    }

  private:
    std::mt19937 random_;
};

/// One and two layers between several media, with each quantity at an end of its range, at the smallest
/// positive number (`tiny`), or close to a special case.
inline std::vector<optics::Stack> corners(double tiny)
{
    std::vector<optics::Stack> result;
    const double n_close = static_cast<float>(1 + 2e-6), n_skin = 1.4f;
    for (double a : {0., tiny, 1e6})
        for (double s : {0., tiny, 1e6})
            for (double g : {-1., 0., tiny, 1.})
                for (double n : {1., n_close, 3.})
                    for (double d : {0., tiny, 1e9, infinity})
                        for (double above : {1., n_skin, 3.})
                            for (double below : {1., n_close, 3.}) {
                                const optics::LayerOptics first{a, s, g, n, d}, second{s, a, g, n_skin, d};
                                result.push_back({{first}, above, below});
                                result.push_back({{first, second}, above, below});
                            }
    return result;
}

inline optics::Stack without_absorption(optics::Stack stack)
{
    for (optics::LayerOptics& layer : stack.layers)
        layer.sigma_a = 0;
    return stack;
}

inline std::string text(const optics::Stack& stack)
{
    std::string result = fmt::format("above {}", stack.n_above);
    for (const optics::LayerOptics& layer : stack.layers)
        result += fmt::format(" | a {} s {} g {} n {} d {}", layer.sigma_a, layer.sigma_s_reduced, layer.g,
                              layer.n, layer.thickness_mm);
    return result + fmt::format(" | below {}", stack.n_below);
}

} // namespace random_tissue
