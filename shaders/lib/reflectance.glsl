// Diffuse reflectance of layered tissue in single precision: the analytic models (docs/optics.md). A test
// compares it with the double-precision reference wound/optics/reflectance.cpp. All functions are finite for
// sigma <= 1e6 mm^-1, any thickness, n in 1..3, g in -1..1, except the printed equations, which overflow
// far outside their domain.
#ifndef LIB_REFLECTANCE_GLSL
#define LIB_REFLECTANCE_GLSL
#include "../shared/models.h"


// Henyey & Greenstein 1941, "Diffuse radiation in the galaxy": the integral over the backward hemisphere,
// expanded by the conjugate because the textbook form is 0/0 at g = 0.
float backward_fraction(float g)
{
    float q = sqrt(1.0 + g * g);
    return (1.0 - g) / (q * (1.0 + g + q));
}

// Walsh 1926: diffuse Fresnel reflectance for light from the medium of lower index; x = n - 1 > 0. For x <
// 0.3 all but the logarithm is a Taylor series, because the terms of the closed form grow as 1/x and cancel.
float external_diffuse_fresnel(float x)
{
    float n = 1.0 + x, n2 = n * n, n4 = n2 * n2;
    float p = n2 + 1.0, m = x * (n + 1.0);
    float logarithm = n2 * m * m / (p * p * p) * log(x / (n + 1.0));
    if (x < 0.3) {
        float sum = 0.48491992;
        sum = sum * x - 0.27704648;
        sum = sum * x - 0.24326815;
        sum = sum * x + 0.77885397;
        sum = sum * x - 0.89211366;
        sum = sum * x + 0.34264013;
        sum = sum * x + 0.60629960;
        sum = sum * x - 1.24099702;
        sum = sum * x + 0.93600190;
        sum = sum * x + 0.16875;
        sum = sum * x - 1.06666667;
        sum = sum * x + 0.79166667;
        sum = sum * x + 0.33333333;
        return max(sum * x + logarithm, 0.0);
    }
    float k = n4 - 1.0;
    return 0.5 + x * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) + logarithm
        - 2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / (p * k) + 8.0 * n4 * (n4 + 1.0) / (p * k * k) * log(n);
}

float diffuse_fresnel(float n_from, float n_to)
{
    float difference = n_to - n_from;
    if (abs(difference) < 1e-6)
        return 0.0;
    if (difference > 0.0)
        return external_diffuse_fresnel(difference / n_from);
    float x = -difference / n_to, n = 1.0 + x;
    // 1 - (1 - F)/n^2, rearranged to avoid cancellation as n goes to 1.
    return (x * (2.0 + x) + external_diffuse_fresnel(x)) / (n * n);
}

// Reflectance and transmittance for diffuse light from above and from below.
struct Element
{
    vec3 r_top, r_bottom, t_down, t_up;
};

Element boundary(float n_above, float n_below)
{
    float down = diffuse_fresnel(n_above, n_below), up = diffuse_fresnel(n_below, n_above);
    return Element(vec3(down), vec3(up), vec3(1.0 - down), vec3(1.0 - up));
}

// Kubelka-Munk slab, Kubelka 1948, "New contributions to the optics of intensely light-scattering materials",
// divided by kappa = sqrt(K (K + 2 S)) so that neither S = 0 nor K = 0 is special.
Element slab(vec3 S, vec3 K, float thickness_mm)
{
    float d = min(thickness_mm, 1e24); // avoids inf/inf and overflow for infinite thickness
    vec3 x = 2.0 * d * sqrt(K * (K + 2.0 * S));
    vec3 e = exp(-x);
    // (1 - exp(-x)) / x, by its series where the difference would lose precision.
    vec3 series = 1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0))));
    vec3 f = 2.0 * d * mix((1.0 - e) / max(x, vec3(1e-3)), series, lessThan(x, vec3(0.1)));
    vec3 denominator = (S + K) * f + 1.0 + e;
    vec3 r = S * f / denominator, t = 2.0 * exp(-0.5 * x) / denominator;
    return Element(r, r, t, t);
}

// The adding method. The loss per round trip is at least the transmittance of either element; this bound
// keeps the result finite when both reflectances round to 1.
Element over(Element upper, Element lower)
{
    vec3 loss = max(1.0 - upper.r_bottom * lower.r_top, max(max(upper.t_up, lower.t_down), vec3(1e-30)));
    return Element(upper.r_top + upper.t_down * lower.r_top * (upper.t_up / loss),
                   lower.r_bottom + lower.t_up * upper.r_bottom * (lower.t_down / loss),
                   upper.t_down * (lower.t_down / loss),
                   lower.t_up * (upper.t_up / loss));
}

Element tissue_slab(int model, vec3 sigma_a, vec3 sigma_s_reduced, float g, float thickness_mm)
{
    if (model == REFLECTANCE_TWO_STREAM_PAPER)
        return slab(sigma_s_reduced * backward_fraction(g), sigma_a, thickness_mm);
    if (model == REFLECTANCE_CALIBRATED) {
        // Fitted to the photon walk (docs/optics.md).
        vec3 S = 0.6433 * sigma_s_reduced * (sigma_s_reduced / max(sigma_s_reduced + 2.2131 * sigma_a, vec3(1e-30)));
        vec3 K = sigma_a * (1.9179 - 0.7631 * (sigma_a / max(sigma_a + sigma_s_reduced, vec3(1e-30))));
        return slab(S, K, thickness_mm);
    }
    // Eddington's S is negative where absorption dominates; it is clamped to no backscattering.
    return slab(max(0.75 * sigma_s_reduced - 0.25 * sigma_a, vec3(0.0)), 2.0 * sigma_a, thickness_mm);
}

// Choi & Chin 2014, eqs. (2) and (3), for one layer, without the factor of the upper boundary.
void paper_layer(int model, vec3 sigma_a, vec3 s, float thickness_mm, float lower_boundary, out vec3 reflected,
                 out vec3 transmitted)
{
    vec3 left, scattered;
    if (model == REFLECTANCE_EXPONENTIAL) {
        left = exp(-(sigma_a + s) * min(thickness_mm, 1e24));
        scattered = 0.5 * s / max(sigma_a + s, vec3(1e-30)) * (1.0 - left * left);
    } else {
        vec3 d = vec3(thickness_mm);
        if (model == REFLECTANCE_PUBLISHED)
            d = min(d, 1.0 / max(sigma_a + s, vec3(1e-30)));
        vec3 ad = sigma_a * d;
        left = 1.0 - (sigma_a + s) * d;
        scattered = s * d * (1.0 - ad + ad * ad / 3.0);
        if (model == REFLECTANCE_PUBLISHED)
            left = max(left, vec3(0.0)); // rounding
    }
    reflected = scattered + lower_boundary * left * left;
    transmitted = left * (1.0 - lower_boundary);
}

// The factor of eq. (3): the light that leaves through the upper boundary; the exponential model takes the
// share that entered.
float paper_top_factor(int model, float n_above, float n_first)
{
    return 1.0 - (model == REFLECTANCE_EXPONENTIAL ? diffuse_fresnel(n_above, n_first) : diffuse_fresnel(n_first, n_above));
}

// Makes a colour safe for the forward pass. The printed equations give values below 0, above 1 and, far
// outside their domain, NaN. Negative and NaN become 0; values above 1 are kept, up to the largest half
// float, because they are the model's result.
vec3 displayable(vec3 color)
{
    return vec3(color.r > 0.0 ? min(color.r, 65504.0) : 0.0, color.g > 0.0 ? min(color.g, 65504.0) : 0.0,
                color.b > 0.0 ? min(color.b, 65504.0) : 0.0);
}

#endif
