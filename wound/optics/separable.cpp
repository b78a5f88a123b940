#include "wound/optics/separable.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace optics {
namespace {

/// Integral of Bessel's K0 from x to infinity, by Simpson's rule over K0(t) = integral of exp(-t cosh u) du:
/// the integral over t is exp(-x cosh u) / cosh u.
double k0_beyond(double x)
{
    constexpr int intervals = 400;
    constexpr double end = 20; // 1 / cosh u is 4e-9 there, for x = 0
    const auto value = [&](double u) { return std::exp(-x * std::cosh(u)) / std::cosh(u); };
    double sum = value(0) + value(end);
    for (int i = 1; i < intervals; ++i)
        sum += (i % 2 == 1 ? 4 : 2) * value(end * i / intervals);
    return sum * end / intervals / 3;
}

} // namespace

// Along a line at the distance x R(r) = (e^(-r/d) + e^(-r/3d)) / (8 pi d r) sums up to (K0(x/d) + K0(x/3d)) /
// (4 pi d).
double beyond_edge(double distance, double width)
{
    const double x = distance / width;
    return (k0_beyond(x) + 3 * k0_beyond(x / 3)) / (4 * std::numbers::pi);
}

std::array<SeparableTap, shared::SEPARABLE_TAPS> separable_kernel(const base::Color& width)
{
    constexpr int half = (shared::SEPARABLE_TAPS - 1) / 2;
    const double widest = std::max({width[0], width[1], width[2]});
    std::array<SeparableTap, shared::SEPARABLE_TAPS> taps{};
    const auto place = [](int i) { return shared::SEPARABLE_REACH * double(i * i) / double(half * half); };
    for (int i = 0; i <= half; ++i) {
        const double inner = i == 0 ? 0 : (place(i - 1) + place(i)) / 2,
                     outer = (place(i) + place(i + 1)) / 2;
        base::Color share; // of one side
        for (int c = 0; c < 3; ++c) {
            const double own = width[c] > 0 ? width[c] / widest : 0;
            if (own > 0)
                share[c] = beyond_edge(inner, own) - (i < half ? beyond_edge(outer, own) : 0);
            else
                share[c] = i == 0 ? .5 : 0;
        }
        if (i == 0)
            taps[0] = {0, 2 * share};
        else {
            taps[std::size_t(2 * i - 1)] = {-place(i), share};
            taps[std::size_t(2 * i)] = {place(i), share};
        }
    }
    return taps;
}

} // namespace optics
