#include "base/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace base {
namespace {

constexpr std::size_t fewest_decades = 3; // ticks; with fewer, a logarithmic axis tries linear steps

/// Writes 100000 as such or as 1e5, whichever is shorter; both parse to the value.
std::string label_of(double value)
{
    const std::string plain = fmt::format("{:.10g}", value);
    std::string power = fmt::format("{:e}", value); // 2.500000e+05
    std::string exponent = power.substr(power.find('e') + 1);
    power.erase(power.find('e'));
    while (power.ends_with('0'))
        power.pop_back();
    if (power.ends_with('.'))
        power.pop_back();
    power += fmt::format("e{}", std::atoi(exponent.c_str()));
    const bool same = std::abs(std::strtod(power.c_str(), nullptr) - value) <= 1e-9 * std::abs(value);
    return same && power.size() < plain.size() && plain.size() > 6 ? power : plain;
}

bool no_labels_overlap(const std::vector<Tick>& ticks, const Extent& extent, double gap)
{
    for (std::size_t i = 1; i < ticks.size(); ++i)
        if (std::abs(ticks[i].at - ticks[i - 1].at) <
            (extent(ticks[i].label) + extent(ticks[i - 1].label)) / 2 + gap)
            return false;
    return true;
}

/// Ticks at the multiples of `step`.
std::vector<Tick> multiples(const Scale& scale, double step)
{
    std::vector<Tick> ticks;
    const double last = std::floor(scale.high / step + 1e-9);
    for (double n = std::ceil(scale.low / step - 1e-9); n <= last; ++n)
        if (const double value = n == 0 ? 0 : n * step; const auto at = scale.at(value)) // no -0
            ticks.push_back({value, *at, label_of(value)});
    return ticks;
}

std::vector<Tick> linear_ticks(const Scale& scale, const Extent& extent, double gap)
{
    const double range = scale.high - scale.low;
    const double most = std::max(1., std::abs(scale.end - scale.begin) / gap);
    double step = round_up(range / most);
    std::vector<Tick> ticks = multiples(scale, step);
    while (!no_labels_overlap(ticks, extent, gap))
        ticks = multiples(scale, step = round_up(1.5 * step));
    return ticks;
}

/// Ticks at `steps` times powers of ten; uses every `stride`-th exponent.
std::vector<Tick> decades(const Scale& scale, std::span<const double> steps, int stride)
{
    std::vector<Tick> ticks;
    const int first = int(std::floor(std::log10(scale.low) / stride)) * stride;
    for (int exponent = first; exponent <= std::log10(scale.high) + 1e-9; exponent += stride)
        for (const double step : steps) {
            const double value = std::strtod(fmt::format("{}e{}", step, exponent).c_str(), nullptr);
            if (value >= scale.low * (1 - 1e-9) && value <= scale.high * (1 + 1e-9))
                ticks.push_back({value, *scale.at(value), label_of(value)});
        }
    return ticks;
}

std::vector<Tick> logarithmic_ticks(const Scale& scale, const Extent& extent, double gap)
{
    constexpr std::array steps{1., 2., 5.};
    std::vector<Tick> ticks = decades(scale, steps, 1);
    for (int stride = 1; !no_labels_overlap(ticks, extent, gap); ++stride)
        ticks = decades(scale, std::span(steps).first(1), stride);
    if (ticks.size() >= fewest_decades)
        return ticks;
    std::vector<Tick> finer = linear_ticks(scale, extent, gap);
    return finer.size() > ticks.size() ? finer : ticks;
}

} // namespace

std::optional<double> Scale::at(double value) const
{
    if (!std::isfinite(value) || (logarithmic && value <= 0))
        return std::nullopt;
    const double share =
        logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return begin + share * (end - begin);
}

Scale widened(Scale scale)
{
    const bool range = std::isfinite(scale.low) && std::isfinite(scale.high) && scale.low <= scale.high &&
                       (!scale.logarithmic || scale.low > 0);
    if (!range)
        std::tie(scale.low, scale.high) = scale.logarithmic ? std::pair(1., 10.) : std::pair(0., 1.);
    const double size = std::max(std::abs(scale.low), std::abs(scale.high));
    if (scale.high - scale.low > 1e-9 * size)
        return scale;
    if (scale.logarithmic) {
        scale.low /= 2;
        scale.high *= 2;
    } else {
        const double half = size > 0 ? size / 2 : .5;
        scale.low -= half;
        scale.high += half;
    }
    return scale;
}

std::vector<Tick> round_ticks(const Scale& scale, const Extent& extent, double gap)
{
    return scale.logarithmic ? logarithmic_ticks(scale, extent, gap) : linear_ticks(scale, extent, gap);
}

std::vector<Tick> keep_apart(const std::vector<Tick>& ticks, const Extent& extent, double gap)
{
    std::vector<Tick> kept;
    for (const Tick& tick : ticks) {
        std::vector<Tick> tried;
        if (!kept.empty())
            tried.push_back(kept.back());
        tried.push_back(tick);
        if (&tick != &ticks.back())
            tried.push_back(ticks.back());
        if (no_labels_overlap(tried, extent, gap))
            kept.push_back(tick);
    }
    return kept;
}

double round_up(double value)
{
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1., 2., 5.})
        if (step * power >= value * (1 - 1e-9))
            return step * power;
    return 10 * power;
}

} // namespace base
