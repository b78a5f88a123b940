// The part of a picture that one frame draws: the whole, or a tile of a picture too large for one frame.
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
    std::array<std::int32_t, 2> corner{0, 0};     // of the tile with its apron, from the picture's top left
    std::array<std::uint32_t, 2> size{1280, 720}; // of the tile with its apron; may reach beyond the picture
    /// Width in pixels of a border that is drawn and then cut off, so that a pass that reads neighbours up to
    /// this distance gives the same result in a tile as in the whole picture.
    std::uint32_t apron = 0;
    bool transparent = false; // background: true transparent (straight alpha), false the studio's backdrop

    ViewportTile() = default;
    /// A whole picture.
    ViewportTile(std::array<std::uint32_t, 2> whole, bool see_through = false)
        : picture(whole), size(whole), transparent(see_through)
    {
    }
    double aspect() const { return double(picture[0]) / picture[1]; }
};

/// Cuts a picture, row by row, into tiles of at most `largest` (even, at least 2) pixels a side without
/// apron. All have the same size, so that the device can reuse its images, and begin at even pixels, so that
/// derivatives use the same 2 x 2 quads as in the whole picture. `apron`: even; a single tile gets it too.
std::vector<ViewportTile> tiles(const ViewportTile& whole, std::uint32_t largest, std::uint32_t apron = 0);

/// Maps the clip space of the whole picture to that of the tile.
glm::dmat4 tile_from_picture(const ViewportTile& tile);

/// Copies a tile's image, without apron and cropped to the picture, to its position in `whole`; allocates
/// `whole` if it has another size or type.
void place(cv::Mat& whole, const cv::Mat& image, const ViewportTile& tile);

} // namespace passes
