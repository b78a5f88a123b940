// Spectra at fixed wavelengths and what the eye makes of them: CIE colour under D65 instead of three picked
// wavelengths.
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "base/color.hpp"

namespace optics {

constexpr std::size_t wavelength_count = 31;
/// 400, 410, ... 700 nm; outside, the observer sees less than .1 % of D65.
constexpr double wavelength_nm(std::size_t index)
{
    return 400 + 10 * static_cast<double>(index);
}
using Spectrum = std::array<double, wavelength_count>;

/// What each channel of a tissue adds to linear Rec. 709 colour; the weights of each of R, G and B sum to 1.
/// Three channels are R, G, B themselves, one is grey, wavelength_count are integrated against CIE 1931 and
/// D65. Empty for other counts.
std::span<const base::Color> channel_weights(std::size_t channels);

/// May leave 0..1 for colours outside the gamut. `channels` has 1, 3 or wavelength_count values.
base::Color linear_rgb(std::span<const double> channels);

/// CIELAB for the 10 degree observer under D65, for comparison with skin measured that way.
base::Lab lab_10_degrees(const Spectrum& reflectance);

} // namespace optics
