// The part of a picture that one frame draws: all of it, or a tile of one that is too large to be drawn at
// once.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

namespace passes {

struct ViewportTile
{
    std::array<std::uint32_t, 2> picture{1280, 720}; // width and height of the whole, pixels
    std::array<std::int32_t, 2> corner{0, 0};     // of the tile in it, from the top left; its apron's, if any
    std::array<std::uint32_t, 2> size{1280, 720}; // of the tile with its apron; may reach beyond the picture
    /// Pixels on each side that are drawn and then cut off, so that a pass that reads its pixel's neighbours,
    /// up to so many away, finds the same ones in a tile as in the whole.
    std::uint32_t apron = 0;
    bool transparent = false; // behind the head: nothing (straight alpha), or the studio's backdrop

    ViewportTile() = default;
    /// All of a picture.
    ViewportTile(std::array<std::uint32_t, 2> whole, bool see_through = false)
        : picture(whole), size(whole), transparent(see_through)
    {
    }
    double aspect() const { return double(picture[0]) / picture[1]; }
};

/// Cuts a picture into tiles of at most `largest` (even, at least 2) pixels a side without their aprons, row
/// by row. All are of one size, so that a device draws them into the same images, and begin at even pixels,
/// so that derivatives are taken over the same squares of pixels as in the whole. `apron`: even; a picture
/// that is one tile has one, too.
std::vector<ViewportTile> tiles(const ViewportTile& whole, std::uint32_t largest, std::uint32_t apron = 0);

/// From the clip space of the whole picture to that of the tile.
glm::dmat4 tile_from_picture(const ViewportTile& tile);

/// Puts a tile's image, without its apron, where it belongs in the whole, which is made with the first tile;
/// what reaches beyond the picture is dropped.
void place(cv::Mat& whole, const cv::Mat& image, const ViewportTile& tile);

} // namespace passes
