// The axes of a chart: where a value lies, and which round values get a tick.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace base {

struct Axis
{
    std::string title, unit;         // written as "title, unit"
    std::optional<double> low, high; // what is absent comes from the data, with a margin
    bool logarithmic = false;        // values that are not above zero have no place on it
    std::vector<std::string> rows;   // instead of numbers, on the y axis: row i is at y = i, the first on top
};

/// Values to pixels.
struct Scale
{
    double low = 0, high = 1; // values
    bool logarithmic = false;
    double begin = 0, end = 1; // pixels of low and high

    /// None for NaN, infinity and what a logarithm has no place for.
    std::optional<double> at(double value) const;
};

/// As it is, or about its middle when it has no width or is no range at all.
Scale widened(Scale scale);

struct Tick
{
    double value = 0;
    double at = 0; // pixel
    std::string label;
};

/// Pixels that a label takes along its axis.
using Extent = std::function<double(const std::string& label)>;

/// Ticks inside the scale's range, 1, 2 or 5 times powers of ten, as many as can be `gap` pixels apart.
std::vector<Tick> round_ticks(const Scale& scale, const Extent& extent, double gap);

/// Leaves out ticks whose label comes closer than `gap` to that of the tick before or of the last one.
std::vector<Tick> keep_apart(const std::vector<Tick>& ticks, const Extent& extent, double gap);

/// 1, 2 or 5 times a power of ten, not below `value`, which is positive.
double round_up(double value);

} // namespace base
