#include "wound/optics/reflectance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/ranges.h>
#include <utility>

#include "base/input_error.hpp"
#include "wound/optics/adding_doubling.hpp"
#include "wound/optics/fresnel.hpp"
#include "wound/optics/monte_carlo.hpp"

namespace optics {

namespace {

double boundary(double n_from, double n_to, DiffuseFresnel form)
{
    if (form == DiffuseFresnel::Polynomial && n_from != n_to)
        return diffuse_fresnel_polynomial(n_from, n_to);
    return diffuse_fresnel(n_from, n_to);
}

// ---- the paper's own equations
// -----------------------------------------------------------------------------------

// Eqs. (2) and (3) for one layer, without the factor of the upper boundary.
struct PaperLayer
{
    double reflected, transmitted;
};

PaperLayer paper_layer(const LayerOptics& layer, double lower_boundary, ReflectanceModel model)
{
    const double a = layer.sigma_a, s = layer.sigma_s_reduced * backward_fraction(layer.g);
    if (model == ReflectanceModel::Exponential) {
        const double attenuation = std::exp(-(a + s) * std::min(layer.thickness_mm, 1e30));
        const double scattered = a + s > 0 ? s / (2 * (a + s)) * (1 - attenuation * attenuation) : 0;
        return {scattered + lower_boundary * attenuation * attenuation, attenuation * (1 - lower_boundary)};
    }
    double d = layer.thickness_mm;
    if (model == ReflectanceModel::Published)
        d = std::min({d, 1 / (a + s), 1e30});
    const double left = 1 - (a + s) * d;
    const double scattered = s * d * (1 - a * d + a * a * d * d / 3);
    return {scattered + lower_boundary * left * left, left * (1 - lower_boundary)};
}

// The light transmitted by one layer enters the next; the upper boundary's factor multiplies the whole sum.
Response paper_response(const Stack& stack, ReflectanceModel model, double specular, DiffuseFresnel form)
{
    const auto& layers = stack.layers;
    // Eqs. (2) and (3) follow light that is inside already; Exponential loses what the first surface
    // reflects.
    const double entering = is_the_papers(model) ? 1 : 1 - specular;
    double incoming = 1, sum = 0;
    Response response;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const double below = i + 1 < layers.size() ? layers[i + 1].n : stack.n_below;
        const PaperLayer layer = paper_layer(layers[i], boundary(layers[i].n, below, form), model);
        sum += incoming * layer.reflected;
        const double lost = incoming * (1 - layer.reflected - layer.transmitted);
        response.absorbed.push_back(entering * lost);
        incoming *= layer.transmitted;
    }
    // Eq. (3) weights the sum with the upper boundary's transmittance from inside. Exponential uses that from
    // outside, which keeps r + t <= 1.
    double lost_at_top = specular;
    if (is_the_papers(model))
        lost_at_top = layers.empty() ? 0 : boundary(layers.front().n, stack.n_above, form);
    response.r_without_specular = (1 - lost_at_top) * sum;
    response.r = specular + response.r_without_specular;
    response.t = entering * incoming;
    return response;
}

// ---- two streams
// --------------------------------------------------------------------------------------------------

Element interface_element(double n_above, double n_below, DiffuseFresnel form)
{
    const double down = boundary(n_above, n_below, form), up = boundary(n_below, n_above, form);
    return {.r_top = down, .r_bottom = up, .t_down = 1 - down, .t_up = 1 - up};
}

Element layer_element(const LayerOptics& layer, ReflectanceModel model, const std::array<double, 4>& c)
{
    const double a = layer.sigma_a, s = layer.sigma_s_reduced, d = layer.thickness_mm;
    if (model == ReflectanceModel::TwoStreamPaper)
        return slab(s * backward_fraction(layer.g), a, d);
    if (model == ReflectanceModel::Calibrated) {
        // Fitted to the photon walk on 48 skin-like stacks; docs/optics.md gives the error on 48 others.
        return a + s > 0 ? slab(c[0] * s * (s / (s + c[1] * a)), a * (c[2] - c[3] * (a / (a + s))), d)
                         : slab(0, 0, d);
    }
    // Eddington's S is negative where absorption dominates; S is 0 there.
    return slab(std::max(0.0, 0.75 * s - 0.25 * a), 2 * a, d);
}

// boundary, layer, boundary, layer, ... boundary, from the top down; layer i is element 2 i + 1.
std::vector<Element> elements(const Stack& stack, ReflectanceModel model, double specular,
                              const ReflectanceOptions& options)
{
    std::vector<Element> result;
    double above = stack.n_above;
    for (const LayerOptics& layer : stack.layers) {
        result.push_back(interface_element(above, layer.n, options.fresnel));
        result.push_back(layer_element(layer, model, options.calibration));
        above = layer.n;
    }
    result.push_back(interface_element(above, stack.n_below, options.fresnel));
    result.front().r_top = specular;
    result.front().t_down = 1 - specular;
    return result;
}

// 1 - r_up r_down for light between two elements. The transmittance of either element is a lower bound, which
// keeps the sum finite when both reflectances round to 1.
double round_trip_loss(const Element& upper, const Element& lower)
{
    return std::max({1 - upper.r_bottom * lower.r_top, upper.t_up, lower.t_down, 1e-300});
}

Response two_stream(const Stack& stack, ReflectanceModel model, double specular,
                    const ReflectanceOptions& options)
{
    const std::vector<Element> list = elements(stack, model, specular, options);
    std::vector<Element> rest(list.size() + 1); // rest[i]: element i and everything under it
    for (std::size_t i = list.size(); i-- > 0;)
        rest[i] = over(list[i], rest[i + 1]);

    Response response;
    response.r = std::min(rest[0].r_top, 1.0); // rounding
    response.r_without_specular = std::max(0.0, response.r - specular);
    response.t = rest[0].t_down;
    Element above;
    double entering = 1 - response.r; // net flux downward into the element
    for (std::size_t i = 0; i < list.size(); ++i) {
        above = over(above, list[i]);
        const double leaving = above.t_down / round_trip_loss(above, rest[i + 1]) * (1 - rest[i + 1].r_top);
        if (i % 2 == 1)
            response.absorbed.push_back(std::max(0.0, entering - leaving));
        entering = leaving;
    }
    return response;
}

} // namespace

namespace {
constexpr std::array<std::pair<ReflectanceModel, std::string_view>, 8> names{{
    {ReflectanceModel::Printed, "printed"},
    {ReflectanceModel::Published, "published"},
    {ReflectanceModel::Exponential, "exponential"},
    {ReflectanceModel::TwoStreamPaper, "two-stream-paper"},
    {ReflectanceModel::TwoStream, "two-stream"},
    {ReflectanceModel::Calibrated, "calibrated"},
    {ReflectanceModel::AddingDoubling, "adding-doubling"},
    {ReflectanceModel::MonteCarlo, "monte-carlo"},
}};
} // namespace

std::span<const ReflectanceModel> all_reflectance_models()
{
    static const auto models = [] {
        std::array<ReflectanceModel, names.size()> result{};
        std::transform(names.begin(), names.end(), result.begin(),
                       [](const auto& entry) { return entry.first; });
        return result;
    }();
    return models;
}

std::string_view name(ReflectanceModel model)
{
    return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == model; })
        ->second;
}

ReflectanceModel reflectance_model_named(std::string_view wanted)
{
    for (const auto& [model, text] : names)
        if (text == wanted)
            return model;
    std::vector<std::string_view> known;
    for (ReflectanceModel model : all_reflectance_models())
        known.push_back(name(model));
    throw base::InputError(wanted, "not a reflectance model",
                           fmt::format("give one of {}", fmt::join(known, ", ")));
}

double specular_reflectance(const Stack& stack, const ReflectanceOptions& options)
{
    const double n = stack.layers.empty() ? stack.n_below : stack.layers.front().n;
    if (options.incidence == Incidence::Normal)
        return fresnel(stack.n_above, n, 1);
    return boundary(stack.n_above, n, options.fresnel);
}

Response reflectance(const Stack& stack, ReflectanceModel model, const ReflectanceOptions& options)
{
    switch (model) {
    case ReflectanceModel::AddingDoubling:
        return adding_doubling(stack, options);
    case ReflectanceModel::MonteCarlo:
        return monte_carlo(stack, options);
    case ReflectanceModel::TwoStream:
    case ReflectanceModel::TwoStreamPaper:
    case ReflectanceModel::Calibrated:
        return two_stream(stack, model, specular_reflectance(stack, options), options);
    default:
        return paper_response(stack, model, specular_reflectance(stack, options), options.fresnel);
    }
}

std::vector<double> diffuse_color(const SkinLayers& tissue, ReflectanceModel model,
                                  const ReflectanceOptions& options)
{
    std::vector<double> color;
    ReflectanceOptions channel = options;
    for (std::size_t c = 0; c < tissue.channels(); ++c) {
        channel.seed = options.seed + c; // independent noise: with one seed it would add up over a spectrum
        color.push_back(reflectance(tissue.channel(c), model, channel).r_without_specular);
    }
    return color;
}

std::vector<OutsideDomain> outside_domain(const SkinLayers& tissue)
{
    std::vector<OutsideDomain> result;
    for (std::size_t l = 0; l < tissue.layers.size(); ++l)
        for (std::size_t c = 0; c < tissue.channels(); ++c) {
            const Layer& layer = tissue.layers[l];
            const double limit =
                1 / (layer.sigma_a[c] + layer.sigma_s_reduced[c] * backward_fraction(layer.g));
            if (layer.thickness_mm > limit)
                result.push_back({l, c, layer.thickness_mm, limit});
        }
    return result;
}

Element slab(double S, double K, double thickness_mm)
{
    // R = (1-e)/((a+b)-(a-b)e), T = 2 b exp(-bSd)/(same) with a = (S+K)/S, b = sqrt(a^2-1), e = exp(-2bSd),
    // multiplied by S and divided by kappa = bS = sqrt(K(K+2S)), so that neither S = 0 nor K = 0 is special.
    const double d = std::min(thickness_mm, 1e30); // 1e30 represents infinity and avoids inf/inf
    const double kappa = std::sqrt(K * (K + 2 * S));
    const double x = 2 * kappa * d;
    const double f = x > 0 ? -std::expm1(-x) / kappa : 2 * d; // -> 2 d without absorption
    const double e = std::exp(-x);
    const double denominator = (S + K) * f + 1 + e;
    const double r = S * f / denominator, t = 2 * std::exp(-0.5 * x) / denominator;
    return {.r_top = r, .r_bottom = r, .t_down = t, .t_up = t};
}

Element over(const Element& upper, const Element& lower)
{
    const double m = 1 / round_trip_loss(upper, lower);
    return {.r_top = upper.r_top + upper.t_down * lower.r_top * upper.t_up * m,
            .r_bottom = lower.r_bottom + lower.t_up * upper.r_bottom * lower.t_down * m,
            .t_down = upper.t_down * lower.t_down * m,
            .t_up = lower.t_up * upper.t_up * m};
}

} // namespace optics
