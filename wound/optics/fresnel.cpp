#include "wound/optics/fresnel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace optics {

double fresnel(double n_from, double n_to, double cos_incidence)
{
    const double ratio = n_from / n_to;
    const double sin2 = ratio * ratio * (1 - cos_incidence * cos_incidence);
    if (sin2 >= 1)
        return 1;
    const double c = cos_incidence, t = std::sqrt(1 - sin2);
    const double s = (n_from * c - n_to * t) / (n_from * c + n_to * t);
    const double p = (n_from * t - n_to * c) / (n_from * t + n_to * c);
    return 0.5 * (s * s + p * p);
}

namespace {

// Light in the medium of lower index, n = n_to / n_from > 1. The closed form (Walsh 1926; Judd 1942; Egan &
// Hilgeman 1979) is a difference of terms that grow as 1/(n-1), so near 1 everything except its logarithm is
// replaced by a Taylor series in x = n - 1.
double external_diffuse_fresnel(double n)
{
    const double x = n - 1, n2 = n * n, n4 = n2 * n2;
    const double p = n2 + 1, m = n2 - 1;
    const double logarithm = n2 * m * m / (p * p * p) * std::log(x / (n + 1));
    if (x < 0.05) {
        constexpr std::array series = {1. / 3,         19. / 24,        -16. / 15,
                                       27. / 160,      629. / 672,      -16679. / 13440,
                                       12223. / 20160, 55261. / 161280, -1582681. / 1774080};
        double sum = 0;
        for (auto c = series.rbegin(); c != series.rend(); ++c)
            sum = x * (sum + *c);
        return sum + logarithm;
    }
    return 0.5 + x * (3 * n + 1) / (6 * (n + 1) * (n + 1)) + logarithm -
           2 * n * n2 * (n2 + 2 * n - 1) / (p * (n4 - 1)) +
           8 * n4 * (n4 + 1) / (p * (n4 - 1) * (n4 - 1)) * std::log(n);
}

} // namespace

double diffuse_fresnel(double n_from, double n_to)
{
    if (std::abs(n_to - n_from) < 1e-6)
        return 0;
    if (n_to > n_from)
        return external_diffuse_fresnel(n_to / n_from);
    const double n = n_from / n_to; // reciprocity: n^2 (1 - F_internal) = 1 - F_external
    return 1 - (1 - external_diffuse_fresnel(n)) / (n * n);
}

double diffuse_fresnel_polynomial(double n_from, double n_to)
{
    const double n = std::max(n_from, n_to) / std::min(n_from, n_to);
    const double internal = -1.440 / (n * n) + 0.710 / n + 0.668 + 0.0636 * n;
    return n_from >= n_to ? internal : std::max(0.0, 1 - (1 - internal) * n * n);
}

double henyey_greenstein(double g, double cosine)
{
    const double q = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * std::numbers::pi * q * std::sqrt(q));
}

double backward_fraction(double g)
{
    // Integral of Henyey & Greenstein 1941 over the backward half: (1-g)/(2g) ((1+g)/sqrt(1+g^2) - 1), which
    // is 0/0 at g = 0; expanding by the conjugate removes the division by g.
    const double q = std::sqrt(1 + g * g);
    return (1 - g) / (q * (1 + g + q));
}

double henyey_greenstein_cosine(double g, double u)
{
    if (std::abs(g) < 1e-6) // isotropic within rounding
        return 2 * u - 1;
    const double q = (1 - g * g) / (1 - g + 2 * g * u);
    return std::clamp((1 + g * g - q * q) / (2 * g), -1.0, 1.0);
}

} // namespace optics
