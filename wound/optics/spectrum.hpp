// Spectra at fixed wavelengths and their CIE colour under D65.
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "base/color.hpp"

namespace optics {

constexpr std::size_t wavelength_count = 31;
/// 400, 410, ... 700 nm; wavelengths outside contribute less than .1 % of D65's luminance.
constexpr double wavelength_nm(std::size_t index)
{
    return 400 + 10 * static_cast<double>(index);
}
using Spectrum = std::array<double, wavelength_count>;

/// Linear Rec. 709 colour of one unit of each channel; the weights of each of R, G and B sum to 1. One
/// channel is grey, three are R, G, B, wavelength_count are integrated against CIE 1931 and D65. Empty for
/// other counts.
std::span<const base::Color> channel_weights(std::size_t channels);

/// May leave 0..1 for colours outside the gamut. `channels` has 1, 3 or wavelength_count values.
base::Color linear_rgb(std::span<const double> channels);

/// CIELAB for the 10 degree observer under D65, for comparison with published measurements of skin.
base::Lab lab_10_degrees(const Spectrum& reflectance);

} // namespace optics
