#include "wound/optics/chromophores.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace optics {

namespace {

// Every 10 nm from 400 nm. Blood: whole blood with 150 g/l haemoglobin, mm^-1, from Prahl's tabulated
// extinction (OMLC 1999). Water: mm^-1, after the OMLC collection. Bilirubin: molar extinction, cm^-1 M^-1,
// in chloroform (Li; PhotochemCAD), mean over 5 nm.
struct Absorbers
{
    double oxy_blood, deoxy_blood, water, bilirubin;
};
constexpr std::array<Absorbers, wavelength_count> absorbers{{
    {142.56, 119.57, 5.8e-05, 23198}, {249.99, 162.76, 5e-05, 30879},  {257.23, 218.24, 4.2e-05, 39310},
    {131.77, 283.06, 3.6e-05, 46812}, {54.93, 221.31, 3.2e-05, 52017}, {33.64, 55.31, 2.8e-05, 54670},
    {23.82, 12.52, 2.7e-05, 53808},   {17.78, 8.65, 2.5e-05, 45979},   {14.26, 7.79, 2.5e-05, 29741},
    {12.68, 8.93, 2.5e-05, 14159},    {11.21, 11.17, 2.5e-05, 4804},   {10.73, 13.80, 2.8e-05, 1314},
    {12.96, 16.92, 3.1e-05, 341},     {21.40, 20.90, 3.5e-05, 132},    {28.51, 24.95, 4e-05, 66},
    {23.03, 28.60, 4.5e-05, 58},      {17.46, 28.80, 5.9e-05, 40},     {23.83, 24.14, 7.2e-05, 24},
    {26.83, 19.82, 0.00011, 18},      {7.71, 15.17, 0.00017, 25},      {1.71, 7.86, 0.00023, 32},
    {.81, 5.06, 0.00025, 28},         {.50, 3.49, 0.00027, 21},        {.33, 2.76, 0.00029, 14},
    {.24, 2.33, 0.0003, 15},          {.20, 2.01, 0.00032, 12},        {.17, 1.73, 0.00036, 24},
    {.16, 1.50, 0.0004, 48},          {.15, 1.29, 0.00045, 20},        {.15, 1.10, 0.00053, 9},
    {.16, .96, 0.0006, 14},
}};

double melanosome_absorption(double nm)
{
    return 6.6e10 * std::pow(nm, -3.33);
} // mm^-1; Jacques 1996
double bloodless_skin(double nm)
{
    return .0244 + 8.53 * std::exp(-(nm - 154) / 66.2);
} // mm^-1; Saidi 1992, Jacques

} // namespace

Layer chromophore_layer(std::string name, const Chromophores& content, double g, double n,
                        double thickness_mm)
{
    Layer layer{.name = std::move(name),
                .sigma_a = {},
                .sigma_s_reduced = {},
                .g = g,
                .n = n,
                .thickness_mm = thickness_mm};
    for (std::size_t i = 0; i < wavelength_count; ++i) {
        const double nm = wavelength_nm(i);
        const Absorbers& a = absorbers[i];
        const double blood = content.oxygenation * a.oxy_blood + (1 - content.oxygenation) * a.deoxy_blood;
        const double bilirubin =
            std::numbers::ln10 * a.bilirubin * content.bilirubin_mmol_l * 1e-3 / 10; // cm^-1 to mm^-1
        const double rest = std::max(0.0, 1 - content.melanosomes - content.blood);
        layer.sigma_a.push_back(content.melanosomes * melanosome_absorption(nm) + content.blood * blood +
                                bilirubin +
                                rest * (content.baseline * bloodless_skin(nm) + content.water * a.water));
        layer.sigma_s_reduced.push_back(content.scattering_500nm *
                                        std::pow(nm / 500, -content.scattering_power));
    }
    return layer;
}

base::Color tissue_color(const SkinLayers& tissue, ReflectanceModel model, const ReflectanceOptions& options)
{
    return linear_rgb(diffuse_color(tissue, model, options));
}

} // namespace optics
