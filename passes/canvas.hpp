// The picture that a frame is part of: all of it, or one tile of a picture that is too large to be drawn at
// once.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace passes {

struct Canvas
{
    std::array<std::uint32_t, 2> picture{1280, 720}; // width and height of the whole, pixels
    std::array<std::uint32_t, 2> corner{0, 0};       // of the tile in it, from the top left
    std::array<std::uint32_t, 2> size{1280, 720};    // of the tile; may reach beyond the picture
    bool transparent = false; // behind the head: nothing (straight alpha), or the studio's backdrop

    Canvas() = default;
    /// All of a picture.
    Canvas(std::array<std::uint32_t, 2> whole, bool see_through = false)
        : picture(whole), size(whole), transparent(see_through)
    {
    }
    double aspect() const { return double(picture[0]) / picture[1]; }
};

/// Cuts a picture into tiles of at most `largest` (even, at least 2) pixels a side, row by row. All are of
/// one size, so that a device draws them into the same images, and begin at even pixels, so that derivatives
/// are taken over the same squares of pixels as in the whole.
std::vector<Canvas> tiles(const Canvas& whole, std::uint32_t largest);

/// From the clip space of the whole picture to that of the tile.
glm::dmat4 tile_from_picture(const Canvas& canvas);

} // namespace passes
