// What the demo's user is doing, without a window: time running, the size of pictures while something moves, messages.
#include "apps/demo_session.hpp"

#include <gmock/gmock.h>

namespace {

using namespace app;
using testing::ElementsAre;
using testing::Field;
using testing::SizeIs;

TEST(Playback, RunsToTheLastDayAndStartsAnew)
{
    Playback playback{.last_day = 10, .days_per_second = 2};
    playback.advance(1);
    EXPECT_EQ(playback.day, 0) << "paused";
    playback.toggle();
    playback.advance(3);
    EXPECT_EQ(playback.day, 6);
    playback.advance(3);
    EXPECT_EQ(playback.day, 10);
    EXPECT_FALSE(playback.playing);
    playback.toggle();
    EXPECT_EQ(playback.day, 0);
    EXPECT_TRUE(playback.playing);
}

TEST(Playback, StaysWithinItsDays)
{
    Playback playback{.last_day = 10};
    playback.seek(-3);
    EXPECT_EQ(playback.day, 0);
    playback.seek(11);
    EXPECT_EQ(playback.day, 10);
}

TEST(Quality, RendersInFullWhatTakesLittleTime)
{
    Quality quality;
    quality.rendered(1, 8);
    quality.moving(100);
    EXPECT_EQ(quality.scale(100), 1);
    EXPECT_EQ(quality.due_in(101), std::nullopt);
}

TEST(Quality, RendersSmallerWhileMovingAndInFullAfterwards)
{
    Quality quality;
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
    EXPECT_EQ(quality.due_in(101), std::nullopt) << "the full picture is there";
}

TEST(Quality, DoesNotGoBackAndForthBetweenSizes)
{
    Quality quality;
    quality.rendered(1, 60);
    quality.moving(0);
    const double scale = quality.scale(0);
    quality.rendered(scale, 60 * std::pow(scale, 1.5) * .95); // a little faster than foreseen
    EXPECT_EQ(quality.scale(0), scale);
}

TEST(Notices, GoAfterAWhileButErrorsStay)
{
    Notices notices;
    EXPECT_EQ(notices.next_change(), std::nullopt);
    notices.say("saved", 100);
    notices.fail("no such file");
    EXPECT_GT(notices.next_change().value(), 100);
    notices.drop_old(1000);
    EXPECT_THAT(notices.list(), ElementsAre(Field(&Notice::text, "no such file")));
    EXPECT_EQ(notices.next_change(), std::nullopt);
    notices.dismiss(0);
    EXPECT_THAT(notices.list(), SizeIs(0));
}

} // namespace
