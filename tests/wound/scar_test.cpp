// The scar against published values over time, and its continuity with the wound.
#include "wound/healing/scar.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {

TEST(Scar, FollowsPublishedRednessAndPigmentation)
{
    // Danielsen et al. 2013: erythema +145, +89, +36 %, pigmentation +24, +15, 0 % (not significant) at 1, 3,
    // 12 months.
    EXPECT_NEAR(wound::scar_after(1).redness, 1.45, .021);
    EXPECT_NEAR(wound::scar_after(3).redness, .89, .021);
    EXPECT_NEAR(wound::scar_after(12).redness, .36, .0215);
    EXPECT_NEAR(wound::scar_after(1).pigmentation, .24, .02);
    EXPECT_NEAR(wound::scar_after(3).pigmentation, .15, .02);
    EXPECT_NEAR(wound::scar_after(12).pigmentation, 0, .02);
}

TEST(Scar, FadesFlattensAndStaysSmoother)
{
    double last = 10;
    for (double month : {0., 1., 2., 4., 8., 12., 24., 120.}) {
        const auto scar = wound::scar_after(month);
        EXPECT_LT(scar.redness, last);
        EXPECT_GE(scar.pigmentation, 0);
        EXPECT_TRUE(scar.sheen > 0 && scar.sheen <= 1 && scar.pore_loss > 0 && scar.pore_loss <= 1);
        last = scar.redness;
    }
    EXPECT_GT(wound::scar_after(2.5).height_mm, .2);
    EXPECT_LT(wound::scar_after(24).height_mm, 0);
    EXPECT_GT(wound::scar_after(24).height_mm, -.2);
}

TEST(Scar, IsContinuousAcrossClosure)
{
    const wound::Healing face;
    const double closed = wound::closure_day(face.curve);
    const auto before = wound::scar_at(face, closed - .5), after = wound::scar_at(face, closed + .5),
               later = wound::scar_at(face, closed + 1.5);
    EXPECT_EQ(before.months, 0);
    EXPECT_LE(std::abs(after.redness - before.redness), 1.1 * std::abs(later.redness - after.redness));
    EXPECT_LE(std::abs(after.height_mm - before.height_mm),
              1.1 * std::abs(later.height_mm - after.height_mm));
    EXPECT_EQ(before.height_mm, 0);
    EXPECT_EQ(before.pigmentation, 0);
}

TEST(Scar, AWoundThatNeverClosesKeepsItsNewEpithelium)
{
    const wound::Healing open{{0, 1, 0, 0}, wound::HealingModel::Face, .43};
    EXPECT_EQ(wound::scar_at(open, 1e6).months, 0);
}

} // namespace
