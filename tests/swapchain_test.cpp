// What of a picture is copied where in a window.
#include "engine/swapchain.hpp"

#include <gtest/gtest.h>

namespace {

using engine::Box;
using engine::clipped;
using engine::PlacedPicture;

TEST(PlacedPicture, InsideTheWindowStaysAsItIs)
{
    const PlacedPicture picture{VK_NULL_HANDLE, {0, 0, 50, 30}, {10, 20, 110, 80}};
    const PlacedPicture cut = clipped(picture, {200, 100});
    EXPECT_EQ(cut.from, picture.from);
    EXPECT_EQ(cut.to, picture.to);
}

TEST(PlacedPicture, IsCutWithTheWindowAtTheSameScale)
{
    // Twice as large in the window: each 20 pixels outside are 10 of the picture.
    const PlacedPicture cut = clipped({VK_NULL_HANDLE, {0, 0, 50, 30}, {-20, 20, 80, 80}}, {60, 60});
    EXPECT_EQ(cut.to, (Box{0, 20, 60, 60}));
    EXPECT_EQ(cut.from, (Box{10, 0, 40, 20}));
}

TEST(PlacedPicture, BesideTheWindowIsNothing)
{
    EXPECT_TRUE(clipped({VK_NULL_HANDLE, {0, 0, 50, 30}, {300, 0, 400, 60}}, {200, 100}).to.empty());
    EXPECT_TRUE(clipped({VK_NULL_HANDLE, {0, 0, 50, 30}, {0, 0, 0, 60}}, {200, 100}).to.empty()) << "no width";
}

} // namespace
