// Absorption and scattering spectra of tissue from its melanin, blood, bilirubin and bloodless remainder.
// Constants and sources: docs/optics.md, section 6.
#pragma once
#include "wound/optics/reflectance.hpp"
#include "wound/optics/spectrum.hpp"
#include "wound/optics/tissue.hpp"

namespace optics {

struct Chromophores
{
    double melanosomes = 0;        // volume fraction, 0..1
    double blood = 0;              // volume fraction of whole blood (150 g haemoglobin per litre), 0..1
    double oxygenation = 0.7;      // share of the haemoglobin that carries oxygen, 0..1
    double bilirubin_mmol_l = 0;   // mmol per litre of tissue
    double water = 0.65;           // volume fraction, 0..1
    double baseline = 1;           // factor on the absorption of bloodless skin
    double scattering_500nm = 4.7; // reduced scattering at 500 nm, mm^-1
    double scattering_power = 1.9; // sigma_s'(l) = sigma_s'(500 nm) (l / 500 nm)^-power
};

/// The layer's spectra at the wavelengths of spectrum.hpp.
Layer chromophore_layer(std::string name, const Chromophores& content, double g, double n,
                        double thickness_mm);

/// linear_rgb() of diffuse_color(). `tissue` has 1, 3 or wavelength_count channels.
base::Color tissue_color(const SkinLayers& tissue, ReflectanceModel model,
                         const ReflectanceOptions& options = {});

} // namespace optics
