#include "base/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace base {
namespace {

/// The median of one bootstrap sample: random blocks of consecutive samples, as many as in `samples`.
double resampled_median(std::span<const double> samples, std::size_t block, std::mt19937_64& random,
                        std::vector<double>& drawn)
{
    drawn.clear();
    std::uniform_int_distribution<std::size_t> first(0, samples.size() - block);
    while (drawn.size() < samples.size()) {
        const std::size_t from = first(random);
        const std::size_t count = std::min(block, samples.size() - drawn.size());
        drawn.insert(drawn.end(), samples.begin() + std::ptrdiff_t(from),
                     samples.begin() + std::ptrdiff_t(from + count));
    }
    const auto middle = drawn.begin() + std::ptrdiff_t(drawn.size() / 2);
    std::nth_element(drawn.begin(), middle, drawn.end());
    if (drawn.size() % 2 == 1)
        return *middle;
    return (*middle + *std::max_element(drawn.begin(), middle)) / 2;
}

double normal_quantile(double p)
{
    double low = -10, high = 10;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (std::erfc(-middle / std::sqrt(2)) / 2 < p ? low : high) = middle;
    }
    return low;
}

/// Abramowitz & Stegun 1964, 26.7.5; accurate to 1 % for at least three degrees of freedom and p <= .99.
double student_quantile(double p, double degrees)
{
    const double z = normal_quantile(p), z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4 * degrees) + (5 * z5 + 16 * z3 + 3 * z) / (96 * degrees * degrees) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * degrees * degrees * degrees);
}

} // namespace

double median(std::span<const double> samples)
{
    return quantile({samples.begin(), samples.end()}, 0.5);
}

double quantile(std::vector<double> samples, double q)
{
    assert(!samples.empty());
    const double place = q * double(samples.size() - 1);
    const auto low = samples.begin() + std::ptrdiff_t(place);
    std::nth_element(samples.begin(), low, samples.end());
    if (low + 1 == samples.end())
        return *low;
    return std::lerp(*low, *std::min_element(low + 1, samples.end()), place - std::floor(place));
}

std::optional<Spread> spread_of(const std::vector<double>& samples)
{
    if (samples.empty())
        return std::nullopt;
    return Spread{quantile(samples, 0.5), quantile(samples, 0.05), quantile(samples, 0.95)};
}

RatioInterval ratio_of_medians(std::span<const double> a, std::span<const double> b, double level)
{
    assert(!a.empty() && !b.empty());
    constexpr int draws = 1000;
    const auto block = [](std::size_t n) {
        return std::max<std::size_t>(1, std::size_t(std::sqrt(double(n))));
    };
    const std::size_t block_a = block(a.size()), block_b = block(b.size());
    std::mt19937_64 random(1);
    std::vector<double> drawn;
    double sum = 0, squares = 0;
    for (int i = 0; i < draws; ++i) {
        const double log_ratio = std::log(resampled_median(b, block_b, random, drawn) /
                                          resampled_median(a, block_a, random, drawn));
        sum += log_ratio;
        squares += log_ratio * log_ratio;
    }
    // Student's t instead of the normal distribution, because few blocks estimate their own spread poorly.
    // The factor n / (n - block) corrects for variation slower than a block, which the bootstrap misses.
    const double blocks = double(a.size()) / double(block_a) + double(b.size()) / double(block_b);
    const double n = double(std::min(a.size(), b.size())), longest = double(std::max(block_a, block_b));
    const double variance =
        std::max(0.0, squares / draws - sum / draws * sum / draws) * n / std::max(1.0, n - longest);
    const double width = student_quantile(1 - level / 2, std::max(3.0, blocks - 2)) * std::sqrt(variance);
    const double ratio = median(b) / median(a);
    return {ratio, ratio * std::exp(-width), ratio * std::exp(width)};
}

double drift_of(std::span<const double> samples)
{
    if (samples.size() < 2)
        return 1;
    const double ratio =
        median(samples.subspan(samples.size() / 2)) / median(samples.subspan(0, samples.size() / 2));
    return std::max(ratio, 1 / ratio);
}

double PowerLaw::at(double x) const
{
    return factor * std::pow(x, exponent);
}

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y)
{
    assert(x.size() == y.size());
    std::vector<double> u, v;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] > 0 && y[i] > 0) {
            u.push_back(std::log(x[i]));
            v.push_back(std::log(y[i]));
        }
    std::vector<double> different = u;
    std::ranges::sort(different);
    const auto repeated = std::ranges::unique(different);
    if (different.size() - repeated.size() < 3)
        return std::nullopt;
    const double n = double(u.size());
    double mean_u = 0, mean_v = 0, uu = 0, uv = 0, residual = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        mean_u += u[i] / n;
        mean_v += v[i] / n;
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
        uu += (u[i] - mean_u) * (u[i] - mean_u);
        uv += (u[i] - mean_u) * (v[i] - mean_v);
    }
    PowerLaw law;
    law.exponent = uv / uu;
    law.factor = std::exp(mean_v - law.exponent * mean_u);
    law.points = u.size();
    for (std::size_t i = 0; i < u.size(); ++i)
        residual += std::pow(v[i] - mean_v - law.exponent * (u[i] - mean_u), 2);
    law.standard_error = std::sqrt(residual / (n - 2) / uu);
    return law;
}

std::vector<std::size_t> non_dominated(std::span<const double> x, std::span<const double> y)
{
    assert(x.size() == y.size());
    std::vector<std::size_t> order(x.size()), kept;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(x[i], y[i]); });
    for (const std::size_t i : order)
        if (kept.empty() || y[i] < y[kept.back()])
            kept.push_back(i);
    return kept;
}

} // namespace base
