#include "wound/healing/phases.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/color.hpp"

namespace {

using cv::Vec3d;
using wound::Phase;
using wound::phase_at;
using wound::tinted;

constexpr double bed = .10; // luminance of a red bed
const Vec3d red{.36, .04, .04}, dark{.08, .015, .012}, pale{.55, .40, .25};

TEST(Phases, ShowThePhotographItselfOnDayZero)
{
    for (double age : {0., 1., 4., 12.}) {
        const Phase phase = phase_at(0, 25, age);
        EXPECT_EQ(phase.rim, 1);
        for (const Vec3d& color : {red, dark, pale})
            EXPECT_EQ(tinted(color, color, phase, bed), color) << "age " << age;
    }
}

TEST(Phases, FollowEachOtherInOrder)
{
    EXPECT_GT(phase_at(1, 25).clot, phase_at(1, 25).fibrin);
    EXPECT_GT(phase_at(3.5, 25).fibrin, phase_at(1, 25).fibrin);
    EXPECT_LT(phase_at(3.5, 25).clot, phase_at(1.2, 25).clot);
    EXPECT_GT(phase_at(10, 25).granulation, .8);
    EXPECT_EQ(phase_at(14, 25).clot, 0);
    EXPECT_EQ(phase_at(14, 25).fibrin, 0);
    EXPECT_LT(phase_at(25, 25).rim, phase_at(10, 25).rim);
}

TEST(Phases, AreContinuousAndBounded)
{
    for (double closure : {.5, 6., 25., 300.})
        for (double age : {0., 3., 40.})
            for (double day = 0; day < 1.5 * closure; day += closure / 2000) {
                const Phase a = phase_at(day, closure, age), b = phase_at(day + closure / 2000, closure, age);
                const double biggest =
                    std::max({std::abs(a.clot - b.clot), std::abs(a.fibrin - b.fibrin),
                              std::abs(a.granulation - b.granulation), std::abs(a.rim - b.rim)});
                ASSERT_LT(biggest, .02 * std::max(1., closure / 60)) << "day " << day;
                for (double share : {a.clot, a.fibrin, a.granulation, a.rim})
                    ASSERT_TRUE(share >= 0 && share <= 1) << "day " << day;
            }
}

TEST(Phases, OfAQuickWoundAreOverWhenItCloses)
{
    const Phase phase = phase_at(6, 6);
    EXPECT_EQ(phase.clot, 0);
    EXPECT_EQ(phase.fibrin, 0);
    EXPECT_EQ(phase.granulation, 1);
}

TEST(Phases, OfAnOldWoundBringNoFreshClot)
{
    for (double day = 0; day < 25; day += .5)
        EXPECT_EQ(phase_at(day, 25, 10).clot, 0);
}

TEST(Phases, TintDarkAsClotPaleAsFibrinAndEverythingAsGranulation)
{
    const Phase clotted{.5, 0, 0, 1}, yellow{0, .4, 0, 1}, granulating{0, 0, 1, 1};
    const auto change = [](const Vec3d& color, const Phase& phase) {
        return cv::norm(tinted(color, color, phase, bed) - color) / cv::norm(color);
    };
    EXPECT_GT(change(dark, clotted), .3);
    EXPECT_LT(change(pale, clotted), .01);
    EXPECT_LT(change(dark, yellow), .01);
    EXPECT_GT(tinted(pale, pale, yellow, bed)[0] / tinted(pale, pale, yellow, bed)[2], pale[0] / pale[2]);
    for (const Vec3d& color : {red, dark, pale}) {
        const Vec3d result = tinted(color, color, granulating, bed);
        EXPECT_GT(result[0], 2.5 * result[1]);
    }
}

TEST(Phases, GiveNoNaNAndNoNegativeColour)
{
    for (const Vec3d& color : {Vec3d(0, 0, 0), Vec3d(1, 1, 1), Vec3d(0, 1, 0), Vec3d(1e-30, 0, 0)})
        for (double luminance : {0., 1e-30, .1, 1.})
            for (double day = 0; day < 30; day += .7) {
                const Vec3d result = tinted(color, color, phase_at(day, 25), luminance);
                for (int k = 0; k < 3; ++k)
                    ASSERT_TRUE(result[k] >= 0 && result[k] <= 1);
            }
}

TEST(Phases, MeasureTheBedsLuminanceInsideTheMaskOnly)
{
    wound::Patch patch{cv::Mat3f(8, 8, cv::Vec3f(.9f, .9f, .9f)), cv::Mat1f(8, 8, 1.f), cv::Mat1f(8, 8, 0.f),
                       cv::Mat1f(8, 8, 0.f), 30};
    EXPECT_EQ(wound::bed_luminance(patch), 0);
    patch.mask(cv::Rect(2, 2, 3, 3)) = 1;
    patch.color(cv::Rect(2, 2, 3, 3)).setTo(cv::Scalar(.36, .04, .04));
    EXPECT_NEAR(wound::bed_luminance(patch), base::luminance(Vec3d(.36, .04, .04)), 1e-6);
}

} // namespace
