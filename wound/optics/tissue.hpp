// Optical description of layered tissue: absorption, scattering, refractive index and thickness of each
// layer. Coefficients are held per channel: three for RGB, one for a single wavelength, many for a spectrum.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace optics {

/// One layer at one wavelength.
struct LayerOptics
{
    double sigma_a = 0;         // absorption, mm^-1
    double sigma_s_reduced = 0; // reduced scattering sigma_s (1 - g), mm^-1
    double g = 0;               // Henyey-Greenstein anisotropy, -1..1
    double n = 1.4;             // refractive index
    double thickness_mm = 0;    // may be infinite
};

/// Layers from top to bottom at one wavelength, between two media.
struct Stack
{
    std::vector<LayerOptics> layers;
    double n_above = 1, n_below = 1;
};

struct Layer
{
    std::string name;
    std::vector<double> sigma_a;         // mm^-1, per channel
    std::vector<double> sigma_s_reduced; // mm^-1, per channel
    double g = 0, n = 1.4;
    double thickness_mm = 0; // may be infinite
};

/// Layers from top to bottom; all have the same number of channels.
struct SkinLayers
{
    std::vector<Layer> layers;
    double n_above = 1, n_below = 1;
    /// Table 1 as the face has it: epidermis, dermis and subcutis are as thick as at the wound's place
    /// (wound::at_place()); the thicknesses here are used where there is no face.
    bool facial = false;

    std::size_t channels() const { return layers.empty() ? 0 : layers.front().sigma_a.size(); }
    Stack channel(std::size_t index) const;
};

/// Table 1 of Choi & Chin 2014 as printed, read as mm^-1. The paper's ranges: dermis 1..4 mm, subcutis 4..9
/// mm. The medium below has the subcutis' index, so it reflects nothing. Not facial: the thicknesses are
/// given.
SkinLayers table1(double epidermis_mm = 0.2, double dermis_mm = 1, double subcutis_mm = 4);

} // namespace optics
