// Statistics of samples: quantiles, the ratio of two medians with its uncertainty, power laws.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace base {

/// `samples` must not be empty.
double median(std::span<const double> samples);

/// Linear between order statistics; `q` from 0 to 1. `samples` must not be empty.
double quantile(std::vector<double> samples, double q);

struct Spread
{
    double median = 0, p5 = 0, p95 = 0;
};
/// None when `samples` is empty.
std::optional<Spread> spread_of(const std::vector<double>& samples);

/// median(b) / median(a) with a confidence interval. The standard error of its logarithm comes from the
/// moving-block bootstrap (Kunsch 1989), which draws blocks of consecutive samples: drawing single samples
/// would ignore their correlation in time and give too narrow an interval. The interval is Student's for the
/// number of blocks. `level`: probability, both sides together, that the interval misses. Deterministic.
struct RatioInterval
{
    double ratio = 1, low = 1, high = 1;
};
RatioInterval ratio_of_medians(std::span<const double> a, std::span<const double> b, double level);

/// Ratio >= 1 between the medians of the first and the second half of the samples: the machine's drift
/// during the measurement.
double drift_of(std::span<const double> samples);

/// y = factor * x^exponent, fitted by least squares to the logarithms.
struct PowerLaw
{
    double factor = 0, exponent = 0;
    double standard_error = 0; // of the exponent
    std::size_t points = 0;
    double at(double x) const;
};
/// Skips points with x <= 0 or y <= 0; none when fewer than three different x remain.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

/// Indices of the non-dominated points: no other point is <= in both coordinates and < in one. Sorted by x;
/// of equal points only the first.
std::vector<std::size_t> non_dominated(std::span<const double> x, std::span<const double> y);

} // namespace base
