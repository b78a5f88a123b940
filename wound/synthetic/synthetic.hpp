// Generates a wound for use without a photograph: a picture, as a camera would take it, of a fresh facial
// wound and the skin around it, and the mask of its open bed.
//
// Lengths are in mm on the skin; the picture is `synthetic_width_mm` wide.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wound/patch.hpp"

namespace wound {

enum class WoundShape
{
    Abrasion,   // ragged oval, about 27 x 19 mm: cheek
    Laceration, // gaping cut, about 34 x 7 mm: above the eyebrow
    Avulsion    // several lobes and tears, about 21 mm: chin
};

/// The shapes' names, in their order: "abrasion", ...
const std::vector<std::string>& shape_names();
/// The shape of that name, which must be one of them.
WoundShape shape_named(std::string_view name);

struct SyntheticWound
{
    WoundShape shape = WoundShape::Abrasion;
    std::uint32_t seed = 1;
    float clot = .2f;              // fraction of the open bed, 0..1
    float fibrin = .22f;           // fraction of the open bed, 0..1
    cv::Vec3b skin{212, 164, 140}; // mean sRGB colour of the healthy skin
    int size = 512;                // px, width and height, 64 or more
};

inline constexpr double synthetic_width_mm = 50;

/// The same parameters give the same picture, bit for bit.
Photograph synthesize(const SyntheticWound& wound);

} // namespace wound
