// Numbers about samples: quantiles, the ratio of two medians with its uncertainty, power laws.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace base {

/// Of at least one sample.
double median(std::span<const double> samples);

/// Linear between order statistics; `q` from 0 to 1. There must be a sample.
double quantile(std::vector<double> samples, double q);

struct Spread
{
    double median = 0, p5 = 0, p95 = 0;
};
/// None without samples.
std::optional<Spread> spread_of(const std::vector<double>& samples);

/// median(b) / median(a) and its interval. The spread of its logarithm comes from the moving-block bootstrap
/// (Kunsch 1989), which draws blocks of consecutive frames: neighbours in time resemble each other, and
/// single ones would promise too much. The interval is Student's for as many blocks. `level`: probability
/// that the interval misses, both sides together. Deterministic.
struct RatioInterval
{
    double ratio = 1, low = 1, high = 1;
};
RatioInterval ratio_of_medians(std::span<const double> a, std::span<const double> b, double level);

/// How much the second half's median differs from the first half's, as a ratio >= 1: how far the machine
/// drifted while the samples were taken.
double drift_of(std::span<const double> samples);

/// y = factor * x^exponent by least squares in the logarithms.
struct PowerLaw
{
    double factor = 0, exponent = 0;
    double standard_error = 0; // of the exponent
    std::size_t points = 0;
    double at(double x) const;
};
/// Points with x or y <= 0 are left out; none when fewer than three different x remain.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

/// Indices of the points that no other one beats: none is at most as large in both coordinates and smaller in
/// one. In order of x; of equal points the first.
std::vector<std::size_t> non_dominated(std::span<const double> x, std::span<const double> y);

} // namespace base
