// The window as its user sees it: a real window on a virtual X server, driven by mouse and keys and checked
// by pictures of the screen. Vulkan validation is on: after any validation message the program ends with an
// error.
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/image_io.hpp"
#include "scene/file.hpp"
#include "scene/scene.hpp"
#include "tests/support/desktop.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/wound_photographs.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string whole(double number)
{
    return std::to_string(std::lround(number));
}

class DemoWindowTest : public testing::Test
{
  protected:
    /// The small head with one wound, seen from the front.
    static std::string head()
    {
        static const std::string file = small::saved(small::head()).string();
        return file;
    }
    std::string scene(const std::string& wounds = R"([{"width_mm": 30}])") const
    {
        return folder_.with("scene.json", R"({"camera": {"azimuth_deg": 0}, "head": ")" + head() +
                                              R"(", "wounds": )" + wounds + "}");
    }
    static cv::Rect box(const json& numbers)
    {
        return {int(std::lround(numbers[0].get<double>())), int(std::lround(numbers[1].get<double>())),
                int(std::lround(numbers[2].get<double>())), int(std::lround(numbers[3].get<double>()))};
    }
    cv::Mat3b screen(const json& idle, const char* part) const
    {
        return desktop_.picture()(box(idle[part])).clone();
    }

    void click(double x, double y, const char* button = "1") const
    {
        desktop_.xdotool({"mousemove", whole(x), whole(y), "click", button});
    }
    /// Slowly enough for every frame to see where the pointer is.
    void drag(double x, double y, double to_x, double to_y, const char* button = "1") const
    {
        desktop_.xdotool({"mousemove", whole(x), whole(y), "mousedown", button});
        for (int i = 1; i <= 4; ++i)
            desktop_.xdotool(
                {"mousemove", whole(x + (to_x - x) * i / 4), whole(y + (to_y - y) * i / 4), "sleep", "0.1"});
        desktop_.xdotool({"mouseup", button});
    }
    /// Faster than any frame.
    void fling(double x, double y, double to_x, double to_y) const
    {
        desktop_.xdotool({"mousemove", whole(x), whole(y), "mousedown", "1", "mousemove", whole(to_x),
                          whole(to_y), "mouseup", "1", "mousemove", whole(to_x + 90), whole(to_y)});
    }
    void key(const char* name) const { desktop_.xdotool({"key", name}); }
    void type(const std::string& text) const
    {
        desktop_.xdotool({"key", "ctrl+a"});
        desktop_.xdotool({"type", "--delay", "30", text});
    }
    /// Opens the dialog of `shortcut` and types a file name; dialog 0 is none.
    json fill_in(Demo& demo, const char* shortcut, const std::string& path) const
    {
        key(shortcut);
        const json opened = demo.idle([](const json& now) { return now["dialog"] != 0; }, "a dialog");
        type(path);
        return opened;
    }
    /// Checks that the view equals what capture draws of `file`, except for the symbol of the light and an
    /// outline, which are drawn over the picture.
    void expect_as_captured(const cv::Mat3b& view, const std::string& file) const
    {
        const std::string size = std::to_string(view.cols) + "x" + std::to_string(view.rows);
        const Outcome captured = run_program(
            {"capture", file, "--days", "0", "--size", size, "--no-cost", "--out", folder_ / "captured"});
        ASSERT_EQ(captured.code, 0) << captured.err;
        cv::Mat difference;
        cv::absdiff(view, base::read_rgb(folder_ / "captured" / "day_000.png"), difference);
        cv::Mat1b near;
        cv::inRange(difference, cv::Scalar(0, 0, 0), cv::Scalar(2, 2, 2), near);
        EXPECT_GT(cv::countNonZero(near), .995 * view.size().area());
    }
    /// `edits`: there are unsaved edits, so the program asks; quitting again confirms.
    void quit(Demo& demo, bool edits = false) const
    {
        key("ctrl+q");
        if (edits) {
            demo.idle([](const json& now) { return now["dialog"] == 8; }, "the question");
            key("ctrl+q");
        }
        EXPECT_EQ(demo.process().wait(), 0) << demo.err();
        EXPECT_THAT(demo.err(), IsEmpty());
    }
    static auto at_least(const char* field, int count)
    {
        return [=](const json& idle) { return idle[field] >= count; };
    }
    static auto wounds(std::size_t count)
    {
        return [=](const json& idle) { return idle["wounds"].size() == count; };
    }

    TemporaryFolder folder_;
    Desktop desktop_;
};

/// Pixels with red far above green and blue: an open wound.
int red_pixels(const cv::Mat3b& rgb)
{
    int count = 0;
    for (const cv::Vec3b& p : rgb)
        count += p[0] > 60 && p[0] > 2 * p[1] && p[0] > 2 * p[2];
    return count;
}

/// Pixels with R > G > B as in skin, neither grey nor wound.
int skin_pixels(const cv::Mat3b& rgb)
{
    int count = 0;
    for (const cv::Vec3b& p : rgb)
        count += p[0] > 60 && p[0] > p[1] + 12 && p[1] > p[2] && p[0] < 2 * p[1];
    return count;
}

cv::Mat3b around(const cv::Mat3b& picture, double x, double y, int half)
{
    const cv::Rect box(int(x) - half, int(y) - half, 2 * half, 2 * half);
    return picture(box & cv::Rect({}, picture.size()));
}

TEST_F(DemoWindowTest, ShowsTheFaceAsCaptureDrawsIt)
{
    const std::string file = scene();
    Demo demo(desktop_, {file});
    const json idle = demo.idle();
    const cv::Mat3b view = screen(idle, "view"), timeline = screen(idle, "timeline");
    EXPECT_GT(skin_pixels(view), view.size().area() / 20);
    EXPECT_GT(red_pixels(view), 100);
    EXPECT_GT(red_pixels(timeline), timeline.size().area() / 20) << "the open wound's days";

    expect_as_captured(view, file);
    quit(demo);
}

TEST_F(DemoWindowTest, ScrubsOverTheDays)
{
    Demo demo(desktop_, {scene()});
    json idle = demo.idle();
    const int open = red_pixels(screen(idle, "view"));
    const cv::Rect timeline = box(idle["timeline"]);
    click(timeline.x + .5 * timeline.width, timeline.y + timeline.height / 2);
    idle = demo.idle([](const json& now) { return now["day"] > 20; }, "a later day");
    EXPECT_LT(red_pixels(screen(idle, "view")), open / 3);
    key("0");
    idle = demo.idle([](const json& now) { return now["day"] == 0; }, "the first day");
    EXPECT_NEAR(red_pixels(screen(idle, "view")), open, open / 50);
    key("space");
    desktop_.xdotool({"sleep", "0.5"});
    key("space");
    demo.idle([](const json& now) { return now["day"] > .1; }, "some days of playback");
    quit(demo);
}

TEST_F(DemoWindowTest, PlacesMovesAndDeletesWounds)
{
    Demo demo(desktop_, {scene("[]")});
    json idle = demo.idle();
    const cv::Rect view = box(idle["view"]);
    const double x = view.x + .5 * view.width, y = view.y + .3 * view.height;
    EXPECT_EQ(red_pixels(around(desktop_.picture(), x, y, 30)), 0);
    click(x, y);
    idle = demo.idle(wounds(1), "a wound");
    EXPECT_NEAR(idle["wounds"][0]["at"][0], x, 6);
    EXPECT_NEAR(idle["wounds"][0]["at"][1], y, 6);
    const int red = red_pixels(around(desktop_.picture(), x, y, 30));
    EXPECT_GT(red, 60);
    EXPECT_EQ(idle["selected"], 0);

    const double to_x = x + .06 * view.width, to_y = y + .1 * view.height;
    drag(x, y, to_x, to_y);
    idle = demo.idle(
        [&](const json& now) { return std::abs(now["wounds"][0]["at"][1].get<double>() - to_y) < 8; },
        "the wound in its new place");
    EXPECT_NEAR(idle["wounds"][0]["at"][0], to_x, 8);
    EXPECT_GT(red_pixels(around(desktop_.picture(), to_x, to_y, 30)), red / 2);

    click(x - .1 * view.width, y);
    demo.idle(wounds(2), "a second wound");
    key("Delete");
    demo.idle(wounds(1), "the second one gone");
    key("ctrl+z");
    demo.idle(wounds(2), "the second one back");
    key("ctrl+z");
    demo.idle(wounds(1), "one wound again");
    key("ctrl+shift+z");
    demo.idle(wounds(2), "the second one again");
    key("ctrl+q");
    demo.idle([](const json& now) { return now["dialog"] == 8; }, "the question");
    key("Escape");
    demo.idle([](const json& now) { return now["dialog"] == 0; }, "the question closed");
    quit(demo, true);
}

TEST_F(DemoWindowTest, TurnsTheHeadAndFollowsTheWindowSize)
{
    Demo demo(desktop_, {scene()});
    json idle = demo.idle();
    const cv::Rect view = box(idle["view"]);
    const cv::Mat3b before = screen(idle, "view");
    const double wound_x = idle["wounds"][0]["at"][0];
    drag(view.x + .5 * view.width, view.y + .15 * view.height, view.x + .6 * view.width,
         view.y + .15 * view.height);
    idle = demo.idle(
        [&](const json& now) { return std::abs(now["wounds"][0]["at"][0].get<double>() - wound_x) > 8; },
        "the head turned");
    EXPECT_GT(cv::norm(before, screen(idle, "view"), cv::NORM_L1) / double(before.total()), 3);
    // The picture is smaller while the head turns, and full-size again at rest.
    fill_in(demo, "ctrl+s", folder_ / "turned.json");
    key("Return");
    idle = demo.idle([](const json& now) { return now["dialog"] == 0; }, "the scene saved");
    expect_as_captured(screen(idle, "view"), folder_ / "turned.json");

    desktop_.xdotool({"search", "--name", "Cicatrix", "windowsize", "900", "640"});
    idle = demo.idle([](const json& now) { return now["window"] == json({900, 640}); }, "the smaller window");
    EXPECT_GT(skin_pixels(screen(idle, "view")), box(idle["view"]).area() / 20);
    desktop_.xdotool({"search", "--name", "Cicatrix", "windowsize", "1500", "960"});
    idle = demo.idle([](const json& now) { return now["window"] == json({1500, 960}); }, "the larger window");
    EXPECT_GT(skin_pixels(screen(idle, "view")), box(idle["view"]).area() / 20);
    EXPECT_GT(red_pixels(screen(idle, "timeline")), 100);

    desktop_.xdotool({"search", "--name", "Cicatrix", "windowunmap", "--sync"});
    EXPECT_EQ(skin_pixels(screen(idle, "view")), 0) << "the window is unmapped";
    desktop_.xdotool({"search", "--name", "Cicatrix", "windowmap", "--sync"});
    idle = demo.idle(at_least("frames", idle["frames"].get<int>() + 1), "the window back");
    EXPECT_GT(skin_pixels(screen(idle, "view")), box(idle["view"]).area() / 20);
    quit(demo);
}

TEST_F(DemoWindowTest, SavesWhatItShowsAndSurvivesBadFiles)
{
    Demo demo(desktop_, {scene()});
    json idle = demo.idle();
    const auto answer = [&](const char* shortcut, const std::string& path) {
        fill_in(demo, shortcut, path);
        desktop_.xdotool({"key", "Return"});
        return demo.idle([](const json& now) { return now["dialog"] == 0 && !now["notices"].empty(); },
                         "a notice");
    };
    const std::filesystem::path broken = folder_.with("broken.json", "{ this is no scene");
    EXPECT_THAT(answer("ctrl+o", broken).at("notices").back().get<std::string>(), HasSubstr("broken.json"));
    EXPECT_THAT(answer("ctrl+o", folder_ / "none.glb").at("notices").back().get<std::string>(),
                HasSubstr("none.glb"));

    const std::filesystem::path saved = folder_ / "saved.json", picture = folder_ / "saved.png";
    answer("ctrl+s", saved);
    const scene::Scene read = scene::read_scene(saved);
    EXPECT_EQ(read.head, head());
    EXPECT_THAT(read.wounds, SizeIs(1));
    answer("ctrl+p", picture);
    EXPECT_EQ(base::read_rgb(picture).size(), cv::Size(1280, 720));
    EXPECT_GT(red_pixels(base::read_rgb(picture)), 100);
    quit(demo);
}

TEST_F(DemoWindowTest, FollowsAPointerFasterThanItsFrames)
{
    Demo demo(desktop_, {scene()});
    json idle = demo.idle();
    const double x = idle["wounds"][0]["at"][0], y = idle["wounds"][0]["at"][1];
    fling(x, y, x, y - 50);
    idle =
        demo.idle([&](const json& now) { return std::abs(now["wounds"][0]["at"][1].get<double>() - y) > 40; },
                  "the wound moved");
    EXPECT_NEAR(idle["wounds"][0]["at"][0], x, 8);
    EXPECT_NEAR(idle["wounds"][0]["at"][1], y - 50, 8);
    key("c"); // the divider is in the middle, over the head
    idle = demo.idle(at_least("pictures", idle["pictures"].get<int>() + 1), "the split view");
    const cv::Rect view = box(idle["view"]);
    fling(view.x + view.width / 2, view.y + .9 * view.height, view.x + .25 * view.width,
          view.y + .9 * view.height);
    idle = demo.idle([](const json& now) { return now["divider"] < .3; }, "the divider moved");
    EXPECT_NEAR(idle["divider"], .25, .01);
    EXPECT_NEAR(idle["wounds"][0]["at"][1], y - 50, 8) << "the head did not turn";
    quit(demo, true);
}

TEST_F(DemoWindowTest, AddsTheWoundInAnAreaOfAPhoto)
{
    const std::filesystem::path photo = folder_ / "photo.png";
    base::write_png(photo,
                    testing_wounds::photograph({240, 160}, {70, 80}, testing_wounds::ellipse(30, 22)).srgb);
    Demo demo(desktop_, {scene()});
    demo.idle();
    fill_in(demo, "ctrl+o", photo);
    key("Return");
    json idle = demo.idle([](const json& now) { return now["dialog"] == 6; }, "the photo");
    const cv::Rect shown = box(idle["photo"]);
    const auto at = [&](double share) { return shown.y + share * shown.height; };
    drag(shown.x + .05 * shown.width, at(.1), shown.x + .55 * shown.width, at(.9));
    key("Return");
    demo.idle([](const json& now) { return now["dialog"] == 0; }, "the wound from the photo");
    fill_in(demo, "ctrl+s", folder_ / "scene_of_photo.json");
    key("Return");
    demo.idle([](const json& now) { return now["dialog"] == 0; }, "the scene saved");
    const scene::Scene read = scene::read_scene(folder_ / "scene_of_photo.json");
    ASSERT_THAT(read.wounds, SizeIs(1));
    EXPECT_EQ(read.wounds[0].photo.filename(), "photo.png");
    ASSERT_TRUE(read.wounds[0].segmentation.rect);
    EXPECT_NEAR(read.wounds[0].segmentation.rect->width, 120, 3);
    EXPECT_NEAR(read.wounds[0].segmentation.rect->height, 128, 3);
    quit(demo);
}

TEST_F(DemoWindowTest, RecordsAFilmToItsEnd)
{
    Demo demo(desktop_, {scene()});
    demo.idle();
    const std::filesystem::path film = folder_ / "film.mp4";
    fill_in(demo, "ctrl+r", film);
    for (const char* number : {"96", "64", "0.4", "10"}) { // width, height, seconds, pictures a second
        key("Tab");
        type(number);
    }
    for (int i = 0; i < 4; ++i)
        key("shift+Tab"); // back to the name, where Enter confirms
    key("Return");
    demo.idle([](const json& now) { return now["dialog"] == 0; }, "the end of the film");
    EXPECT_GT(std::filesystem::file_size(film), 500);
    quit(demo);
}

TEST_F(DemoWindowTest, SleepsWhileNothingChanges)
{
    Demo demo(desktop_, {scene()});
    const json before = demo.idle();
    // The ratio of CPU times during playback and at rest in one process: the machine's speed does not matter.
    const auto used_in_a_second = [&] {
        const double start = demo.process().cpu_seconds();
        desktop_.xdotool({"sleep", "1"});
        return demo.process().cpu_seconds() - start;
    };
    const double asleep = used_in_a_second();
    key("space");
    const double awake = used_in_a_second();
    EXPECT_GT(awake, .05);
    EXPECT_LT(asleep, .2 * awake);
    key("space");
    const json after = demo.idle(at_least("pictures", before["pictures"].get<int>() + 1), "rest");
    EXPECT_GT(after["day"], 0);
    quit(demo);
}

TEST_F(DemoWindowTest, EndsWithOneLineWhenTheDisplayIsLost)
{
    Demo demo(desktop_, {scene()});
    const cv::Rect view = box(demo.idle()["view"]);
    click(view.x + .5 * view.width, view.y + .3 * view.height);
    demo.idle(wounds(2), "an edit");
    desktop_.shut_down();
    EXPECT_EQ(demo.process().wait(), 1);
    const std::string err = demo.err();
    EXPECT_THAT(err,
                HasSubstr("cicatrix: display: the connection was lost; the scene with its edits is in "));
    EXPECT_EQ(std::ranges::count(err, '\n'), 1) << err;
    const std::size_t at = err.find(" is in ") + 7;
    const std::filesystem::path rescued = err.substr(at, err.find("; ", at) - at);
    ASSERT_TRUE(std::filesystem::exists(rescued)) << rescued;
    EXPECT_THAT(scene::read_scene(rescued).wounds, SizeIs(2));
    std::filesystem::remove(rescued);
}

TEST(DemoWithoutDisplay, IsAnErrorOfOneLine)
{
    const Outcome outcome = run_program({"demo"}, {"DISPLAY="});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("cicatrix capture works without a window"));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
}

} // namespace
