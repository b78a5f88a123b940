#include "base/tone_curve.hpp"

#include <gtest/gtest.h>

namespace {

// shaders/tonemap.comp says the same; tests/passes compares them.
TEST(ToneCurve, LeavesMidTonesAndRollsOffHighlights)
{
    const base::Color seen = base::on_backdrop({.2, .8, 100}, 1, 0, .5);
    EXPECT_DOUBLE_EQ(seen[0], .2);
    EXPECT_DOUBLE_EQ(seen[1], .8);
    EXPECT_LT(seen[2], 1);
    EXPECT_GT(seen[2], .99);
    EXPECT_DOUBLE_EQ(base::on_backdrop({.1, .1, .1}, 1, 1, .5)[0], .2);
    EXPECT_FLOAT_EQ(float(base::on_backdrop({0, 0, 0}, 0, 3, 0)[1]), base::backdrop_top[1]);
    EXPECT_FLOAT_EQ(float(base::on_backdrop({0, 0, 0}, 0, 3, 1)[2]), base::backdrop_bottom[2]);
}

} // namespace
