// The skin atlas of a head: one image onto which the light on the skin is drawn and from which the camera's
// pass samples it. Each skin triangle has exactly one place from which it is drawn, its home.
//
// A layout serves images of several sizes: at scale s a unit of the layout is s texels wide. unwrap() is
// costly and depends on the head only; with_wounds() is quick, for a wound that is being dragged. Both only
// read the model and may run in any thread. Triangles are named by the position of their first index in
// model.indices.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "head/model.hpp"
#include "head/placement.hpp"

namespace head {

/// Texels per unit: a power of two in this range. A base tile of 256 units is then 16 to 4096 texels wide.
inline constexpr double smallest_atlas_scale = 1. / 16, largest_atlas_scale = 16;

struct AtlasTriangle
{
    std::uint32_t first = 0;       // of model.indices
    std::array<glm::vec2, 3> at{}; // units, of its corners; in the tile, for home triangles
};

/// A rectangle of the atlas, for the skin of one material or around one wound. Tiles are at least 4 units
/// apart.
struct AtlasTile
{
    glm::uvec2 corner{0}, size{0}; // units, multiples of 4; the size is 0 if the tile has no home triangles
    double units_per_m = 0;        // of the home triangles: median by area of sqrt(area on the atlas / area)
    double gutter = 0;             // units between charts; 0: as the file's texture coordinates leave it
    /// The triangles that the camera's pass draws from this tile. No two overlap, but for what unwrap()
    /// tolerates.
    std::vector<AtlasTriangle> home;
    /// Triangles at home elsewhere, so that filters find the true surroundings: to be drawn in this order,
    /// before the home triangles, and clipped at the tile's edges.
    std::vector<AtlasTriangle> margin;
};

struct Atlas
{
    glm::uvec2 size{0};                  // units, multiples of 4
    std::vector<AtlasTile> materials;    // one per material on the atlas: the whole of its skin
    std::vector<AtlasTile> wounds;       // one per anchor: the skin around it, at about twice the density
    std::vector<std::uint32_t> left_out; // skin triangles without area or with NaN positions: without a place
    std::vector<std::string> notes;      // for the user: texture coordinates that could not be used
};

/// The atlas of a head without wounds, and what with_wounds() needs to find the triangles around a wound.
struct BaseAtlas
{
    Atlas atlas;                   // without wounds and margins
    std::vector<glm::vec4> bounds; // centre and radius, m, of all home triangles in the order of the tiles
};

/// The materials on the atlas: opaque skin.
std::vector<std::uint32_t> atlas_materials(const Model& model);

/// Lays out these materials, the largest at 256 units, the others at the same density. The file's texture
/// coordinates are kept, scaled to their bounding box, unless they are missing, overlap (on more than 0.2 %
/// of the texels), leave the tile nearly empty or differ too much in density. Otherwise the skin is charted
/// anew. Mirrored charts are kept. A few triangles of a file may overlap or have no area on the atlas. Takes
/// 10 to 60 ms for 30,000 triangles, and 4 to 8 s for a million without usable coordinates.
BaseAtlas unwrap(const Model& model, std::span<const std::uint32_t> materials);

/// Adds a tile for each anchor: the planar projection of its patch and of a margin of 12 % of the patch's
/// width, at least 4.5 mm, on each side. The triangles at home there lie wholly in the tile, face the anchor
/// and are within Anchor::reach; of two that overlap in the projection, the one nearer to the viewer is at
/// home there. Where wounds overlap, the earlier comes first. When the tiles need too much space together,
/// they become coarser.
Atlas with_wounds(const Model& model, const BaseAtlas& base, std::span<const Anchor> anchors);

/// The width of a texel on the skin, m: the median of the coarsest material. 0 for an empty atlas.
double texel_m(const Atlas& atlas, double scale);

} // namespace head
