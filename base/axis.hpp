// The axes of a chart: maps values to pixels and chooses round values for the ticks.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace base {

struct Axis
{
    std::string title, unit;         // written as "title, unit"
    std::optional<double> low, high; // a missing bound is taken from the data, with a margin
    bool logarithmic = false;        // values <= 0 cannot be drawn
    std::vector<std::string> rows;   // y axis: names instead of numbers; row i is at y = i, row 0 at the top
};

/// Maps values to pixels.
struct Scale
{
    double low = 0, high = 1; // values
    bool logarithmic = false;
    double begin = 0, end = 1; // pixels of low and high

    /// The pixel; none for NaN, infinity and, on a logarithmic axis, values <= 0.
    std::optional<double> at(double value) const;
};

/// Widens an empty range about its middle; replaces an invalid range by 0..1 (logarithmic: 1..10).
Scale widened(Scale scale);

struct Tick
{
    double value = 0;
    double at = 0; // pixel
    std::string label;
};

/// Length of a label along its axis, in pixels.
using Extent = std::function<double(const std::string& label)>;

/// Ticks at 1, 2 or 5 times powers of ten in the scale's range, as many as fit `gap` pixels apart.
std::vector<Tick> round_ticks(const Scale& scale, const Extent& extent, double gap);

/// Drops each tick whose label is closer than `gap` to the label of the previous tick or of the last tick.
std::vector<Tick> keep_apart(const std::vector<Tick>& ticks, const Extent& extent, double gap);

/// The smallest 1, 2 or 5 times a power of ten that is >= `value`; `value` must be positive.
double round_up(double value);

} // namespace base
