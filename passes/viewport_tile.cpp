#include "passes/viewport_tile.hpp"

#include <cassert>

namespace passes {
namespace {

/// The smallest even size such that `parts` of it cover `whole`.
std::uint32_t even_share(std::uint32_t whole, std::uint32_t parts)
{
    const std::uint32_t share = (whole + parts - 1) / parts;
    return share + share % 2;
}

} // namespace

std::vector<ViewportTile> tiles(const ViewportTile& whole, std::uint32_t largest, std::uint32_t apron)
{
    assert(largest >= 2 && largest % 2 == 0 && apron % 2 == 0);
    std::array<std::uint32_t, 2> size = whole.picture; // without the apron
    if (whole.picture[0] > largest || whole.picture[1] > largest)
        for (std::size_t axis = 0; axis < 2; ++axis)
            size[axis] = even_share(whole.picture[axis], (whole.picture[axis] + largest - 1) / largest);
    const auto edge = std::int32_t(apron);
    std::vector<ViewportTile> result;
    for (std::uint32_t y = 0; y < whole.picture[1]; y += size[1])
        for (std::uint32_t x = 0; x < whole.picture[0]; x += size[0]) {
            ViewportTile& tile = result.emplace_back(whole);
            tile.corner = {std::int32_t(x) - edge, std::int32_t(y) - edge};
            tile.size = {size[0] + 2 * apron, size[1] + 2 * apron};
            tile.apron = apron;
        }
    return result;
}

glm::dmat4 tile_from_picture(const ViewportTile& tile)
{
    // NDC of the picture -> pixels of the picture -> NDC of the tile, for x and y.
    glm::dmat4 crop(1);
    for (int axis = 0; axis < 2; ++axis) {
        const double whole = tile.picture[axis], part = tile.size[axis];
        crop[axis][axis] = whole / part;
        crop[3][axis] = (whole - 2.0 * tile.corner[axis]) / part - 1;
    }
    return crop;
}

void place(cv::Mat& whole, const cv::Mat& image, const ViewportTile& tile)
{
    const cv::Size picture(int(tile.picture[0]), int(tile.picture[1]));
    whole.create(picture, image.type()); // allocates only for the first tile
    const int edge = int(tile.apron);
    const cv::Rect own({edge, edge}, image.size() - cv::Size(2 * edge, 2 * edge));
    const cv::Point corner(tile.corner[0] + edge, tile.corner[1] + edge);
    const cv::Rect inside = cv::Rect(corner, own.size()) & cv::Rect({0, 0}, picture);
    image(cv::Rect(own.tl(), inside.size())).copyTo(whole(inside));
}

} // namespace passes
