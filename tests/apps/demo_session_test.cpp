// The state of a demo session, without a window: playback, the size of pictures during motion, messages.
#include "apps/demo/session.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace {

using testing::ElementsAre;
using testing::Field;
using testing::SizeIs;

TEST(TimelineAxis, IsEvenWhileTheWoundIsOpenAndDenserForTheScar)
{
    const demo_command::TimelineAxis axis(25, 10);
    EXPECT_EQ(axis.day_at(0), 0);
    EXPECT_GT(axis.last_day(), 25 + 360);
    EXPECT_NEAR(axis.day_at(1), axis.last_day(), 1e-9);
    EXPECT_NEAR(axis.fraction_of(20), 2 * axis.fraction_of(10), 1e-12);
    EXPECT_GT(axis.fraction_of(25), .5) << "the open wound has more room than the scar";
    for (const double day : {0.0, .5, 12.0, 27.5, 28.0, 60.0, 200.0, 391.0})
        EXPECT_NEAR(axis.day_at(axis.fraction_of(day)), day, 1e-9 * std::max(1.0, day));
    EXPECT_EQ(axis.fraction_of(-5), 0);
    EXPECT_EQ(axis.fraction_of(1e6), 1);
}

TEST(TimelineAxis, OfAWoundThatNeverClosesHasNoScar)
{
    const demo_command::TimelineAxis axis(std::numeric_limits<double>::infinity(), 40);
    EXPECT_EQ(axis.last_day(), 40);
    EXPECT_EQ(axis.day_at(.5), 20);
    for (const demo_command::TimelineAxis::Tick& tick : axis.ticks(10))
        EXPECT_LE(tick.day, 40);
}

TEST(TimelineAxis, TicksFitAndHaveLabels)
{
    const auto ticks = demo_command::TimelineAxis(30).ticks(12);
    EXPECT_LE(ticks.size(), 14u);
    EXPECT_EQ(ticks.front().label, "0");
    EXPECT_EQ(ticks.back().label, "+12 mo");
    EXPECT_TRUE(std::ranges::is_sorted(ticks, {}, &demo_command::TimelineAxis::Tick::day));
}

TEST(Playback, RunsToTheLastDayAndRestarts)
{
    demo_command::Playback playback{
        .axis = demo_command::TimelineAxis(std::numeric_limits<double>::infinity(), 10),
        .days_per_second = 2};
    playback.advance(1);
    EXPECT_EQ(playback.day, 0) << "paused";
    playback.toggle();
    playback.advance(3);
    EXPECT_NEAR(playback.day, 6, 1e-9);
    playback.advance(3);
    EXPECT_EQ(playback.day, 10);
    EXPECT_FALSE(playback.playing);
    playback.toggle();
    EXPECT_EQ(playback.day, 0);
    EXPECT_TRUE(playback.playing);
}

TEST(Playback, StaysWithinItsDays)
{
    demo_command::Playback playback{
        .axis = demo_command::TimelineAxis(std::numeric_limits<double>::infinity(), 10)};
    playback.seek(-3);
    EXPECT_EQ(playback.day, 0);
    playback.seek(11);
    EXPECT_EQ(playback.day, 10);
}

TEST(Quality, RendersFastPicturesAtFullSize)
{
    demo_command::Quality quality;
    quality.rendered(1, 8);
    quality.moving(100);
    EXPECT_EQ(quality.scale(100), 1);
    EXPECT_EQ(quality.due_in(101), std::nullopt);
}

TEST(Quality, RendersSmallerWhileMovingAndInFullAfterwards)
{
    demo_command::Quality quality;
    quality.rendered(1, 200);
    EXPECT_EQ(quality.scale(99), 1) << "nothing moves yet";
    quality.moving(100);
    const double small = quality.scale(100);
    EXPECT_LT(small, .5);
    quality.rendered(small, 30);
    EXPECT_GT(quality.due_in(100).value(), 0);
    EXPECT_EQ(quality.due_in(101), 0.0);
    EXPECT_EQ(quality.scale(101), 1);
    quality.rendered(1, 200);
    EXPECT_EQ(quality.due_in(101), std::nullopt) << "the full picture is drawn";
}

TEST(Quality, DoesNotOscillateBetweenSizes)
{
    demo_command::Quality quality;
    quality.rendered(1, 60);
    quality.moving(0);
    const double scale = quality.scale(0);
    quality.rendered(scale, 60 * std::pow(scale, 1.5) * .95); // a little faster than predicted
    EXPECT_EQ(quality.scale(0), scale);
}

TEST(Notices, ExpireExceptErrors)
{
    demo_command::Notices notices;
    EXPECT_EQ(notices.next_change(), std::nullopt);
    notices.say("saved", 100);
    notices.fail("no such file");
    EXPECT_GT(notices.next_change().value(), 100);
    notices.drop_old(1000);
    EXPECT_THAT(notices.list(), ElementsAre(Field(&demo_command::Notice::text, "no such file")));
    EXPECT_EQ(notices.next_change(), std::nullopt);
    notices.dismiss(0);
    EXPECT_THAT(notices.list(), SizeIs(0));
}

} // namespace
