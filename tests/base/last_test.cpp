#include "base/last.hpp"

#include <gtest/gtest.h>

TEST(Last, ComputesAgainOnlyWhenTheArgumentChanges)
{
    base::Last<int, int> last;
    int calls = 0;
    const auto square = [&](int x) {
        ++calls;
        return x * x;
    };
    EXPECT_EQ(last.of(3, square), 9);
    EXPECT_EQ(last.of(3, square), 9);
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(last.of(4, square), 16);
    EXPECT_EQ(calls, 2);
}
