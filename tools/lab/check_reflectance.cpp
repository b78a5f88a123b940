// Compares the reference models with published values (docs/optics.md, section 7).
#include <cmath>
#include <fmt/ostream.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "tools/lab/reflectance.hpp"

namespace lab {

namespace {

struct Case
{
    std::string name;
    optics::Stack stack;
    optics::Incidence incidence;
    std::optional<double> r, t;                                 // published; none: unknown
    double tolerance;                                           // of adding-doubling
    optics::Quadrature quadrature = optics::Quadrature::Smooth; // of the published value
};

optics::Stack plate(double albedo, double optical_depth, double g, double n)
{
    return {{{optical_depth * (1 - albedo), optical_depth * albedo * (1 - g), g, n, 1}}, 1, 1};
}

std::vector<Case> published_cases()
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const optics::Stack three{{{.1, 1, .9, 1.37, 1}, {.1, 1, 0, 1.37, 1}, {.2, .3, .7, 1.37, 2}}, 1, 1};
    std::vector<Case> cases = {
        {"van de Hulst 1980, slab",
         {{{1, 2.25, .75, 1, .2}}, 1, 1},
         optics::Incidence::Normal,
         .09739,
         .66096,
         2e-4},
        {"Giovanelli 1955, half space",
         {{{1, 9, 0, 1.5, infinity}}, 1, 1},
         optics::Incidence::Normal,
         .2600,
         0,
         2e-4},
        {"Prahl 1995, three layers", three, optics::Incidence::Normal, .26224, .09605, 2e-4},
        {"Prahl 1995, a .9 b 1", plate(.9, 1, 0, 1), optics::Incidence::Normal, .26741, .59163, 2e-4},
        {"Prahl 1995, a .9 b 1", plate(.9, 1, 0, 1), optics::Incidence::Diffuse, .35271, .47475, 1e-3},
        {"Prahl 1995, a .99 b 10 g .76", plate(.99, 10, .76, 1.4), optics::Incidence::Normal, .38425, .31760,
         2e-4},
        {"Prahl 1995, a .99 b 10 g .76", plate(.99, 10, .76, 1.4), optics::Incidence::Diffuse, .43099, .28563,
         1e-3},
    };
    // Prahl's half spaces have the error of his sixteen angles, 2e-4; his quadrature reproduces them.
    for (const auto& [albedo, r] : {std::pair{.8, .18095}, {.95, .38711}, {.99, .63156}})
        cases.push_back({fmt::format("Prahl 1995, half space a {}", albedo),
                         {{{1 - albedo, albedo, 0, 1.4, infinity}}, 1, 1},
                         optics::Incidence::Normal,
                         r,
                         0,
                         2e-4,
                         optics::Quadrature::Slab});
    return cases;
}

std::vector<Case> random_cases()
{
    std::mt19937 random(12);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    std::vector<Case> cases;
    for (int i = 0; i < 12; ++i) {
        optics::Stack stack{.layers = {}, .n_above = 1, .n_below = uniform(1, 1.5)};
        for (int l = i % 4; l >= 0; --l)
            stack.layers.push_back(
                {uniform(.01, 2), uniform(.1, 8), uniform(-.3, .9), uniform(1.3, 1.6), uniform(.05, 2)});
        cases.push_back({fmt::format("random stack {}, {} layers", i, i % 4 + 1),
                         stack,
                         i % 2 ? optics::Incidence::Diffuse : optics::Incidence::Normal,
                         {},
                         {},
                         0});
    }
    return cases;
}

} // namespace

bool check_reflectance(const optics::ReflectanceOptions& options, std::ostream& out)
{
    bool good = true;
    fmt::print(out, "{:34} {:8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8} {:>6}\n", "case", "light", "quantity",
               "published", "adding", "slab", "walk", "+-", "z");
    std::vector<Case> cases = published_cases();
    for (Case& c : random_cases())
        cases.push_back(std::move(c));
    for (const Case& c : cases) {
        optics::ReflectanceOptions light = options;
        light.incidence = c.incidence;
        const optics::Response adding =
            optics::reflectance(c.stack, optics::ReflectanceModel::AddingDoubling, light);
        light.quadrature = optics::Quadrature::Slab;
        const optics::Response slab =
            optics::reflectance(c.stack, optics::ReflectanceModel::AddingDoubling, light);
        const optics::Response walk =
            optics::reflectance(c.stack, optics::ReflectanceModel::MonteCarlo, light);
        const double t_error =
            std::sqrt(walk.t * (1 - walk.t) / static_cast<double>(options.photons)); // upper bound
        const auto line = [&](std::string_view quantity, std::optional<double> known, double a, double s,
                              double w, double error) {
            // The published values are rounded. Without one, the two models must agree.
            const double z = (w - known.value_or(a)) / std::max(error, 1e-5);
            const bool passed =
                known
                    ? std::abs((c.quadrature == optics::Quadrature::Slab ? s : a) - *known) <= c.tolerance &&
                          std::abs(z) <= 4
                    : std::abs(w - a) <= std::max(1e-3, 4 * error);
            good = good && passed;
            fmt::print(out, "{:34} {:8} {:>8} {:>9} {:9.5f} {:9.5f} {:9.5f} {:8.5f} {:6.2f} {}\n", c.name,
                       c.incidence == optics::Incidence::Normal ? "normal" : "diffuse", quantity,
                       known ? fmt::format("{:.5f}", *known) : "-", a, s, w, error, z,
                       passed ? "" : "FAILED");
        };
        line("r", c.r, adding.r, slab.r, walk.r, walk.standard_error);
        line("t", c.t, adding.t, slab.t, walk.t, t_error);
    }
    return good;
}

} // namespace lab
