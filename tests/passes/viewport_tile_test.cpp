// Pictures cut into tiles, with and without aprons.
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "passes/viewport_tile.hpp"

namespace {

/// What a frame of the tile would draw; the scene extends beyond the picture.
cv::Mat1f drawn(const passes::ViewportTile& tile)
{
    cv::Mat1f image(int(tile.size[1]), int(tile.size[0]));
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x) {
            const int u = x + tile.corner[0], v = y + tile.corner[1];
            image(y, x) = float((u * 37 + v * 101 + u * v) % 251);
        }
    return image;
}

cv::Mat1f assembled(const std::vector<passes::ViewportTile>& tiles, bool blurred)
{
    cv::Mat whole;
    for (const passes::ViewportTile& tile : tiles) {
        cv::Mat image = drawn(tile);
        if (blurred) // like a pass that reads neighbouring pixels
            cv::blur(image, image, {5, 5}, {-1, -1}, cv::BORDER_REPLICATE);
        passes::place(whole, image, tile);
    }
    return whole;
}

TEST(Tiles, CoverThePictureOnce)
{
    for (const std::array<std::uint32_t, 2> size :
         {std::array{301u, 203u}, {64u, 64u}, {65u, 1u}, {2u, 900u}})
        for (const std::uint32_t apron : {0u, 4u}) {
            const auto tiles = passes::tiles(size, 64, apron);
            int covered = 0;
            for (const passes::ViewportTile& tile : tiles) {
                EXPECT_EQ(tile.size, tiles.front().size);
                EXPECT_LE(tile.size[0], 64 + 2 * apron);
                EXPECT_EQ((tile.corner[0] + int(apron)) % 2, 0);
                const cv::Rect own(tile.corner[0] + int(apron), tile.corner[1] + int(apron),
                                   int(tile.size[0] - 2 * apron), int(tile.size[1] - 2 * apron));
                covered += (own & cv::Rect(0, 0, int(size[0]), int(size[1]))).area();
            }
            EXPECT_EQ(covered, int(size[0] * size[1]));
            EXPECT_EQ(cv::norm(assembled(tiles, false), drawn(size), cv::NORM_INF), 0);
        }
}

TEST(Tiles, WithAnApronHaveNoSeamsInAPassThatReadsNeighbours)
{
    const std::array<std::uint32_t, 2> size{301, 203};
    const cv::Mat1f whole = assembled(passes::tiles(size, 16384, 2), true);
    EXPECT_EQ(cv::norm(assembled(passes::tiles(size, 64, 2), true), whole, cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(assembled(passes::tiles(size, 64), true), whole, cv::NORM_INF), 1)
        << "without an apron there are seams";
}

TEST(Tiles, ProjectTheirPartOfThePicture)
{
    const passes::ViewportTile tile = passes::tiles(std::array{200u, 100u}, 50, 10)[5]; // second row, second column
    const glm::dmat4 crop = passes::tile_from_picture(tile);
    const auto ndc = [&](double x, double y) { // of a pixel of the picture
        return crop * glm::dvec4(2 * x / 200 - 1, 2 * y / 100 - 1, 0, 1);
    };
    EXPECT_EQ(tile.corner, (std::array{40, 40}));
    EXPECT_NEAR(ndc(40, 40).x, -1, 1e-12);
    EXPECT_NEAR(ndc(40, 40).y, -1, 1e-12);
    EXPECT_NEAR(ndc(110, 110).x, 1, 1e-12);
}

} // namespace
