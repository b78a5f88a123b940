// Figures 2 and 3: the phase function and its halves, and the light in the layers of skin.
#pragma once
#include <string>
#include <vector>

#include "base/chart.hpp"
#include "wound/optics/tissue.hpp"

namespace figure_command {

/// The shares of a phase function in its two halves, by numerical integration.
struct Halves
{
    double forward = 0, backward = 0;
};
Halves integrated_halves(double g);

/// Figure 2 (a): the phase function over the angle of deflection, one series per layer of Table 1.
base::Chart phase_function_chart();
/// Figure 2 (b): its halves as bars, one row per layer.
base::Chart halves_chart();

/// Light in one layer by the published eqs. (2) and (3), as shares of the light that enters the layer; one
/// value per channel.
struct LayerLight
{
    std::string name;
    double thickness_mm = 0, n = 1, g = 0;
    std::vector<double> arriving;    // of the light that passed the skin's surface
    std::vector<double> scattered;   // R_i: returned by scattering on the way
    std::vector<double> bottom;      // R_dr: returned by the lower boundary
    std::vector<double> transmitted; // T, into the next layer
    std::vector<bool> outside;       // thicker than the equations' domain
};
std::vector<LayerLight> light_through(const optics::SkinLayers& tissue);

} // namespace figure_command
