// Generates a wound for use without a photograph: a picture, as a camera would take it, of a fresh facial
// wound and the skin around it, and the mask of its open bed.
//
// Lengths are in mm on the skin; the picture is `synthetic_width_mm` wide.
#pragma once
#include <cstdint>
#include <string>

#include "wound/patch.hpp"
#include "wound/synthetic/kind.hpp"

namespace wound {

struct SyntheticWound
{
    std::string kind = "avulsion"; // one of kind_names()
    std::uint32_t seed = 1;
    cv::Vec3b skin{212, 164, 140}; // mean sRGB colour of the healthy skin
    int size = 512;                // px, width and height, 64 or more
};

inline constexpr double synthetic_width_mm = 50;

/// The same parameters give the same picture, bit for bit.
Photograph synthesize(const SyntheticWound& wound);

} // namespace wound
