// Charts for skin without usable texture coordinates: connected pieces of about one direction, each projected
// onto its plane and packed into a square.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "head/atlas.hpp"

namespace head {

/// Sets the tile's home triangles (units from its corner) and gutter. `triangles`: first indices, all with
/// area and finite corners. `side`: of the square, units. Each triangle gets one place, and no two overlap.
/// The density varies by a factor of less than 1.5.
void chart_anew(AtlasTile& tile, const Model& model, std::span<const std::uint32_t> triangles,
                std::uint32_t side);

} // namespace head
