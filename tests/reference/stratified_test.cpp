#include "reference/stratified.hpp"

#include <gtest/gtest.h>
#include <set>

namespace {

// Of the first 16 points, each of the 16 boxes of any shape w x h = 1/16 holds one: a (0, 4, 2)-net in
// base 2.
TEST(Stratified, FillsEveryElementaryBox)
{
    for (const std::uint64_t scramble : {0u, 1u, 77u})
        for (int columns = 1; columns <= 16; columns *= 2) {
            const int rows = 16 / columns;
            std::set<int> boxes;
            for (std::uint32_t i = 0; i < 16; ++i) {
                const auto [x, y] = reference::stratified(i, scramble);
                ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1);
                boxes.insert(int(x * columns) * rows + int(y * rows));
            }
            EXPECT_EQ(boxes.size(), 16u) << columns << " columns, scramble " << scramble;
        }
}

TEST(Stratified, DiffersFromPixelToPixel)
{
    EXPECT_NE(reference::stratified(0, 1), reference::stratified(0, 2));
}

} // namespace
