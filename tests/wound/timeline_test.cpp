// The phases and marks that a timeline shows.
#include "wound/healing/timeline.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "wound/healing/phases.hpp"
#include "wound/healing/scar.hpp"

TEST(Timeline, PhasesFollowEachOtherWithoutGaps)
{
    for (const double delta : {.5, .02822, .002}) {
        wound::Healing healing;
        healing.curve.delta = delta;
        const wound::Timeline timeline = wound::timeline(healing, 400);
        ASSERT_EQ(timeline.phases.size(), 5u) << delta;
        double day = 0;
        for (const wound::TimelinePhase& phase : timeline.phases) {
            EXPECT_EQ(phase.first_day, day) << phase.name;
            EXPECT_GT(phase.last_day, day) << phase.name;
            day = phase.last_day;
        }
        EXPECT_EQ(day, 400);
        EXPECT_EQ(timeline.phases.back().first_day, wound::closure_day(healing.curve));
    }
}

TEST(Timeline, PhasesBeginWhereTheBedBeginsToShowThem)
{
    for (const double closure : {4., 25., 60.}) {
        const wound::PhaseDays begin = wound::phase_days(closure);
        const auto at = [&](double day) { return wound::phase_at(day, closure); };
        const double step = 1e-3 * closure;
        EXPECT_EQ(at(begin.inflammation - step).fibrin, 0);
        EXPECT_GT(at(begin.inflammation + step).fibrin, 0);
        EXPECT_EQ(at(begin.granulation - step).granulation, 0);
        EXPECT_GT(at(begin.granulation + step).granulation, 0);
        EXPECT_GT(begin.epithelialisation, begin.granulation);
        EXPECT_LT(begin.epithelialisation, closure);
    }
}

TEST(Timeline, ScarMarksAreAtTheMonthsOfTheScarModel)
{
    const wound::Healing healing;
    const wound::Timeline timeline = wound::timeline(healing, 3650);
    ASSERT_EQ(timeline.marks.size(), 13u);
    EXPECT_EQ(timeline.marks[0].name, "closed");
    EXPECT_EQ(timeline.marks[1].name, "scar, 1 month");
    EXPECT_EQ(timeline.marks[12].name, "scar, 12 months");
    for (int month = 1; month <= 12; ++month)
        EXPECT_NEAR(wound::scar_at(healing, timeline.marks[std::size_t(month)].day).months, month, 1e-9);
}

TEST(Timeline, OfAWoundThatNeverClosesHasNoScar)
{
    wound::Healing healing;
    healing.curve.delta = 0;
    const wound::Timeline timeline = wound::timeline(healing, 30, 31);
    EXPECT_TRUE(std::isinf(timeline.closure_day));
    EXPECT_TRUE(timeline.marks.empty());
    EXPECT_STRNE(timeline.phases.back().name, "scar");
    EXPECT_EQ(timeline.phases.back().last_day, 30);
    for (const cv::Point2d& point : timeline.open)
        EXPECT_EQ(point.y, 1);
}

TEST(Timeline, CurveIsTheHealingCurve)
{
    const wound::Healing healing;
    const wound::Timeline timeline = wound::timeline(healing, 30, 61);
    ASSERT_EQ(timeline.open.size(), 61u);
    EXPECT_EQ(timeline.open[0], cv::Point2d(0, 1));
    for (const cv::Point2d& point : timeline.open)
        EXPECT_EQ(point.y, wound::unhealed_ratio(healing.curve, point.x));
    EXPECT_EQ(timeline.open.back().x, 30);
}
