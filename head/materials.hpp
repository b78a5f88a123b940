// Classifies a head's materials.
#pragma once
#include <cstdint>

#include "head/model.hpp"

namespace head {

enum class Surface : std::uint8_t
{
    Skin, // the material that covers most of the head; takes wounds and translucency
    Eye,  // smooth and wet: narrow highlight
    Hair, // brows and lashes: blended, no highlight, no shadow
    Other // mouth, clothes: no highlight
};

/// Factors on the highlight's coefficient and on the slope of its lobe.
struct Gloss
{
    double specular = 1, slope = 1;
};
Gloss gloss_of(Surface surface);

/// The material that covers the largest area: the skin.
std::uint32_t skin_material(const Model& model);

/// Decides by the material's name; `skin` is skin_material().
Surface surface_of(const Model& model, std::uint32_t material, std::uint32_t skin);

} // namespace head
