#include "passes/canvas.hpp"

#include <cassert>

namespace passes {
namespace {

/// The smallest even size of which `parts` cover `whole`.
std::uint32_t even_share(std::uint32_t whole, std::uint32_t parts)
{
    const std::uint32_t share = (whole + parts - 1) / parts;
    return share + share % 2;
}

} // namespace

std::vector<Canvas> tiles(const Canvas& whole, std::uint32_t largest)
{
    assert(largest >= 2 && largest % 2 == 0);
    if (whole.picture[0] <= largest && whole.picture[1] <= largest)
        return {whole};
    std::array<std::uint32_t, 2> size{};
    for (std::size_t axis = 0; axis < 2; ++axis)
        size[axis] = even_share(whole.picture[axis], (whole.picture[axis] + largest - 1) / largest);
    std::vector<Canvas> result;
    for (std::uint32_t y = 0; y < whole.picture[1]; y += size[1])
        for (std::uint32_t x = 0; x < whole.picture[0]; x += size[0]) {
            Canvas& tile = result.emplace_back(whole);
            tile.corner = {x, y};
            tile.size = size;
        }
    return result;
}

glm::dmat4 tile_from_picture(const Canvas& canvas)
{
    // ndc -> pixels of the whole -> ndc of the tile, along x and y.
    glm::dmat4 crop(1);
    for (int axis = 0; axis < 2; ++axis) {
        const double whole = canvas.picture[axis], tile = canvas.size[axis];
        crop[axis][axis] = whole / tile;
        crop[3][axis] = (whole - 2.0 * canvas.corner[axis]) / tile - 1;
    }
    return crop;
}

} // namespace passes
