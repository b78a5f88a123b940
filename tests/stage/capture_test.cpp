// The output of `cicatrix capture`: tiles without seams, views, camera records, transparency, films.
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "passes/tonemap.hpp"
#include "scene/shots.hpp"
#include "stage/camera_record.hpp"
#include "stage/capture.hpp"
#include "stage/renderer.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The renderer that these tests share, with validation on.
stage::Renderer& renderer()
{
    static stage::Renderer shared({.validation = true});
    return shared;
}

class Capture : public testing::Test
{
  protected:
    void SetUp() override { renderer().device.clear_validation_messages(); }
    void TearDown() override
    {
        for (const std::string& message : renderer().device.validation_messages())
            ADD_FAILURE() << "validation: " << message;
    }
    static stage::Stage stage(const scene::Scene& scene)
    {
        return {renderer().device, stage::Stage::prepare(scene)};
    }
    static stage::Drawing draw(const stage::Stage& on, const head::Camera& camera,
                               const stage::DrawOptions& options, double day = 5)
    {
        return stage::draw(renderer(), on, {day, "", camera, "test"}, options);
    }
};

/// The largest difference of a channel, for each pixel.
cv::Mat1b difference(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat each, largest;
    cv::absdiff(a, b, each);
    cv::reduce(each.reshape(1, int(each.total())), largest, 1, cv::REDUCE_MAX);
    return largest;
}

cv::Mat3b to_srgb8(const cv::Mat3f& linear)
{
    cv::Mat3b codes(linear.size());
    for (int y = 0; y < linear.rows; ++y)
        for (int x = 0; x < linear.cols; ++x)
            codes(y, x) = base::srgb8_from_linear(cv::Vec3d(linear(y, x)));
    return codes;
}

/// A picture with straight alpha over a background, in linear light.
cv::Mat3f composited(const cv::Mat4b& rgba, const std::function<cv::Vec3f(int y)>& background)
{
    cv::Mat3f result(rgba.size());
    for (int y = 0; y < rgba.rows; ++y)
        for (int x = 0; x < rgba.cols; ++x) {
            const cv::Vec4b& pixel = rgba(y, x);
            const cv::Vec3f color(base::linear_from_srgb8({pixel[0], pixel[1], pixel[2]}));
            const float alpha = pixel[3] / 255.0f;
            result(y, x) = alpha * color + (1 - alpha) * background(y);
        }
    return result;
}

/// All frames of a film as RGB, by ffmpeg.
std::vector<cv::Mat3b> decoded(const std::filesystem::path& film, cv::Size size)
{
    const TemporaryFolder folder;
    const std::string raw = (folder / "frames").string();
    const std::string command =
        fmt::format("ffmpeg -loglevel error -nostdin -i '{}' -vf "
                    "scale=in_color_matrix=bt709:flags=accurate_rnd+full_chroma_int -f "
                    "rawvideo -pix_fmt rgb24 '{}'",
                    film.string(), raw);
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream stream(raw, std::ios::binary);
    std::vector<cv::Mat3b> frames;
    for (cv::Mat3b frame(size);
         stream.read(reinterpret_cast<char*>(frame.data), std::streamsize(frame.total() * 3));
         frame = cv::Mat3b(size))
        frames.push_back(frame);
    return frames;
}

glm::dvec4 times(const json& rows, const glm::dvec4& v)
{
    glm::dvec4 result(0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result[row] += rows[row][column].get<double>() * v[column];
    return result;
}

} // namespace

TEST(Tiles, CoverThePictureWithEqualTilesAtEvenPixels)
{
    EXPECT_EQ(passes::tiles(passes::ViewportTile({640, 480}), 640).size(), 1u);
    const std::vector<passes::ViewportTile> tiles = passes::tiles(passes::ViewportTile({1001, 640}), 256);
    ASSERT_EQ(tiles.size(), 4u * 3u);
    cv::Mat1b covered = cv::Mat1b::zeros(640, 1001);
    for (const passes::ViewportTile& tile : tiles) {
        EXPECT_EQ(tile.size, tiles[0].size);
        EXPECT_LE(std::max(tile.size[0], tile.size[1]), 256u);
        EXPECT_EQ(tile.corner[0] % 2 + tile.corner[1] % 2, 0u);
        const cv::Rect at(int(tile.corner[0]), int(tile.corner[1]), int(tile.size[0]), int(tile.size[1]));
        covered(at & cv::Rect(0, 0, 1001, 640)) += 1;
    }
    EXPECT_EQ(cv::countNonZero(covered != 1), 0);
}

// A pixel on an outline may fall on the other side of it, because each tile rounds vertices to the device's
// sub-pixels again. Inside the head and the backdrop only rounding differs.
TEST_F(Capture, TilesJoinWithoutASeam)
{
    for (const std::uint32_t samples : {1u, 4u})
        for (const bool transparent : {false, true}) {
            scene::Scene scene = small::scene(small::head());
            scene.samples = samples;
            const stage::Stage on = stage(scene);
            const stage::DrawOptions whole{{301, 203}, transparent, true, true, 2048},
                cut{{301, 203}, transparent, true, true, 64};
            ASSERT_EQ(stage::tiles_of(cut).size(), 5u * 4u);
            const stage::Drawing a = draw(on, on.loaded().camera(), whole),
                                 b = draw(on, on.loaded().camera(), cut);
            const cv::Mat1b differs = difference(a.picture, b.picture);
            EXPECT_LE(cv::countNonZero(differs > 1), 3) << samples << transparent;
            EXPECT_EQ(a.bed_texels, b.bed_texels);
            EXPECT_LT(cv::norm(a.radiance, b.radiance, cv::NORM_L1) / double(a.radiance.total()), 1e-4);
            const cv::Mat1b elsewhere =
                difference(a.picture, draw(on, on.loaded().close_up(0), whole).picture);
            EXPECT_GT(cv::countNonZero(elsewhere > 1), 1000) << "the comparison must detect differences";
        }
}

TEST_F(Capture, CameraMatricesAgreeWithEachOtherAndWithThePicture)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds.clear();
    const stage::Stage on = stage(scene);
    const head::Camera camera = on.loaded().camera({{25, 10}, 0, 24});
    const std::array<std::uint32_t, 2> size{320, 200};
    const json record = stage::camera_record(on, camera, size);
    const auto& k = record["intrinsics"];
    for (const glm::dvec4 point : {glm::dvec4(0.02, 0.03, 0.08, 1), glm::dvec4(-0.05, -0.06, 0.01, 1)}) {
        const glm::dvec4 clip = times(record["clip_from_world"], point);
        const glm::dvec4 seen = times(record["camera_from_world"], point);
        EXPECT_GT(seen.z, 0) << "in front of the camera";
        EXPECT_NEAR((clip.x / clip.w + 1) / 2 * size[0],
                    k["fx"].get<double>() * seen.x / seen.z + k["cx"].get<double>(), 1e-2);
        EXPECT_NEAR((clip.y / clip.w + 1) / 2 * size[1],
                    k["fy"].get<double>() * seen.y / seen.z + k["cy"].get<double>(), 1e-2);
        EXPECT_NEAR(glm::distance(glm::dvec3(seen), glm::dvec3(0)),
                    glm::distance(glm::dvec3(point), camera.eye), 1e-9);
    }
    // The head's outline in the picture is that of its projected vertices.
    const head::Model model = small::head();
    cv::Mat1b projected = cv::Mat1b::zeros(int(size[1]), int(size[0]));
    for (std::size_t i = 0; i < model.indices.size(); i += 3) {
        std::array<cv::Point, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec3 p = model.vertices[model.indices[i + c]].position;
            const glm::dvec4 clip = times(record["clip_from_world"], glm::dvec4(glm::dvec3(p), 1));
            corners[c] = {cvRound((clip.x / clip.w + 1) * size[0] * 8 - 8),
                          cvRound((clip.y / clip.w + 1) * size[1] * 8 - 8)};
        }
        cv::fillConvexPoly(projected, corners.data(), 3, 255, cv::LINE_8, 4);
    }
    cv::Mat alpha;
    cv::extractChannel(draw(on, camera, {size, true}).picture, alpha, 3);
    const double outside = cv::countNonZero(projected != (alpha > 127));
    EXPECT_LT(outside, 0.02 * cv::countNonZero(alpha));
    EXPECT_GT(cv::countNonZero(alpha), 3000);
}

TEST_F(Capture, ViewsAreStandardOnesOrThoseOfTheScene)
{
    scene::Scene scene = small::scene(small::head());
    scene.views = {{"steep", scene::Camera{{10, 60}, 0, 20}}, {"close-up", std::nullopt}};
    const stage::Stage on = stage(scene);
    const std::vector<scene::NamedCamera> all = scene::chosen_views(on.loaded(), {});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].name, "steep");
    EXPECT_EQ(all[0].camera.eye, on.loaded().camera({{10, 60}, 0, 20}).eye);
    EXPECT_EQ(all[1].camera.eye, on.loaded().close_up(0).eye);
    const std::vector<scene::NamedCamera> chosen =
        scene::chosen_views(on.loaded(), {"left", "steep", "camera"});
    EXPECT_LT(chosen[0].camera.eye.x, -0.5);
    EXPECT_EQ(chosen[2].camera.eye, on.loaded().camera().eye);
    for (const char* wrong : {"lefft", "close-up-2", "close-up-"})
        try {
            scene::chosen_views(on.loaded(), {wrong});
            ADD_FAILURE() << wrong;
        } catch (const base::InputError& error) {
            EXPECT_THAT(error.what(),
                        testing::AllOf(HasSubstr(wrong), HasSubstr("three-quarter"), HasSubstr("steep")));
        }
    EXPECT_THROW(scene::chosen_views(on.loaded(), {"left", "left"}), base::InputError);

    std::vector<std::string> names;
    for (const scene::Shot& shot : scene::shots_of_days({0, 2.5, 0}, all))
        names.push_back(shot.name);
    EXPECT_THAT(names, testing::ElementsAre("day_000_steep", "day_000_close-up", "day_002.500_steep",
                                            "day_002.500_close-up", "day_000_2_steep", "day_000_2_close-up"));
}

// A transparent picture over the studio's backdrop equals the opaque one: its edges have the colour of the
// head alone, without a dark fringe. 8 bits for colour and alpha allow an error of 2 of 255.
TEST_F(Capture, TransparentPicturesCompositeToTheOpaqueOne)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        scene::Scene scene = small::scene(small::head());
        scene.samples = samples;
        const stage::Stage on = stage(scene);
        const stage::Drawing opaque = draw(on, on.loaded().camera(), {{256, 200}, false});
        const cv::Mat4b rgba = draw(on, on.loaded().camera(), {{256, 200}, true}).picture;
        std::array<int, 3> pixels{}; // clear, part, full
        for (const cv::Vec4b& pixel : rgba)
            ++pixels[pixel[3] == 0 ? 0 : pixel[3] < 255 ? 1 : 2];
        EXPECT_GT(pixels[0], 5000);
        EXPECT_GT(pixels[2], 5000);
        EXPECT_EQ(pixels[1] > 100, samples == 4) << "edges are antialiased only with several samples";

        const passes::Backdrop studio = passes::backdrop_of(passes::ViewportTile({256, 200}));
        const auto behind = [&](int y) {
            const glm::vec3 c = glm::mix(studio.top, studio.bottom, (float(y) + 0.5f) / 200);
            return cv::Vec3f(c.x, c.y, c.z);
        };
        const cv::Mat1b differs = difference(to_srgb8(composited(rgba, behind)), opaque.picture);
        double largest = 0;
        cv::minMaxLoc(differs, nullptr, &largest);
        EXPECT_LE(largest, 2);
    }
}

TEST_F(Capture, LinearLightIsWhatThePictureEncodes)
{
    scene::Scene scene = small::scene(small::head());
    scene.samples = 4;
    scene.exposure_stops = -1;
    const stage::Stage on = stage(scene);
    const stage::Drawing opaque = draw(on, on.loaded().camera(), {{256, 200}, false, true});
    ASSERT_EQ(opaque.radiance.type(), CV_32FC3);
    const cv::Mat3f exposed = opaque.radiance * std::exp2(scene.exposure_stops);
    double brightest = 0;
    cv::minMaxLoc(exposed.reshape(1), nullptr, &brightest);
    EXPECT_LT(brightest, 0.8) << "below the shoulder, encoding is exact";
    const cv::Mat1b differs = difference(to_srgb8(exposed), opaque.picture);
    EXPECT_EQ(cv::countNonZero(differs > 1), 0);

    const stage::Drawing clear = draw(on, on.loaded().camera(), {{256, 200}, true, true});
    ASSERT_EQ(clear.radiance.type(), CV_32FC4);
    for (int y = 0; y < 200; y += 3)
        for (int x = 0; x < 256; ++x) {
            const cv::Vec4f light = clear.radiance.at<cv::Vec4f>(y, x);
            const cv::Vec4b code = clear.picture.at<cv::Vec4b>(y, x);
            EXPECT_NEAR(light[3] * 255, code[3], 0.51);
            if (light[3] > 0) { // premultiplied: divided by alpha it is the picture's straight colour
                const cv::Vec3d straight(light[0] / light[3], light[1] / light[3], light[2] / light[3]);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(base::srgb8_from_linear(straight * 0.5)[c], code[c], 1);
            }
        }
}

TEST_F(Capture, SweepsMoveDayAndCameraEvenly)
{
    const stage::Stage on = stage(small::scene(small::head(), 64));
    const scene::NamedCamera view{"", on.loaded().camera()};
    const std::vector<scene::Shot> round = scene::shots_of_sweep(on.loaded(), view, {0, 9, 360, 10, "orbit"});
    ASSERT_EQ(round.size(), 10u);
    EXPECT_EQ(round[0].name, "orbit_000");
    EXPECT_EQ(round[0].camera.eye, on.loaded().camera().eye) << "starts at the scene's camera";
    const auto from_axis = [&](const glm::dvec3& point) {
        const glm::dvec3 arm = point - on.loaded().head_middle();
        return glm::dvec2(std::atan2(arm.x, arm.z), std::hypot(arm.x, arm.z));
    };
    const glm::dvec2 start = from_axis(round[0].camera.eye);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_NEAR(round[i].day, double(i), 1e-12);
        EXPECT_NEAR(round[i].turn_deg, 36.0 * double(i), 1e-9) << "the last does not repeat the first";
        EXPECT_NEAR(from_axis(round[i].camera.eye).y, start.y, 1e-9);
        const double gone = from_axis(round[i].camera.eye).x - start.x - glm::radians(36.0 * double(i));
        EXPECT_NEAR(std::remainder(gone, 2 * 3.14159265358979), 0, 1e-9);
    }
    EXPECT_EQ(scene::shots_of_sweep(on.loaded(), view, {5, 5, 90, 4, "orbit"}).back().turn_deg, 90);
    EXPECT_EQ(scene::shots_of_sweep(on.loaded(), view, {5, 5, 90, 1, "orbit"})[0].turn_deg, 0);
}

// H.264 is lossy and stores colour at half resolution; each frame must still match its own picture best.
TEST_F(Capture, FilmAndPicturesAgreeFrameByFrame)
{
    const TemporaryFolder folder;
    scene::Scene scene = small::scene(small::head());
    scene.size = {161, 121}; // odd: the film repeats the last row and column
    scene.days = {0, 6, 12, 18, 24};
    stage::CaptureOptions options;
    options.out = folder / "out";
    options.cost = options.sheet = false;
    options.views = {"close-up"};
    options.video = folder / "film.mp4";
    options.fps = 5;
    options.duration_s = 1;
    base::Progress progress;
    std::vector<std::string> lines;
    const json record = stage::capture(renderer(), stage(scene), options, progress, lines);
    ASSERT_EQ(record["films"].size(), 1u);
    EXPECT_EQ(record["films"][0]["frames"].size(), 5u);
    EXPECT_EQ(record["films"][0]["frames"][1]["day"], 6);

    const std::vector<cv::Mat3b> frames = decoded(folder / "film_close-up.mp4", {162, 122});
    ASSERT_EQ(frames.size(), 5u);
    std::vector<cv::Mat3b> pictures;
    for (const json& day : record["days"])
        pictures.push_back(base::read_rgb(options.out / day["file"].get<std::string>()));
    for (std::size_t i = 0; i < 5; ++i) {
        const cv::Mat3b frame = frames[i](cv::Rect(0, 0, 161, 121));
        const double own = cv::PSNR(frame, pictures[i]);
        EXPECT_GT(own, 36) << i;
        for (std::size_t other = 0; other < 5; ++other)
            EXPECT_LT(cv::PSNR(frame, pictures[other]), other == i ? own + 1 : own - 2) << i << " " << other;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

TEST_F(Capture, WritesTurntablesWithAlphaAndLinearLight)
{
    const TemporaryFolder folder;
    scene::Scene scene = small::scene(small::head(), 64);
    scene.days = {4};
    stage::CaptureOptions options;
    options.out = folder / "out";
    options.cost = false;
    options.orbit = 3;
    options.transparent = options.exr = true;
    base::Progress progress;
    std::vector<std::string> lines;
    const json record = stage::capture(renderer(), stage(scene), options, progress, lines);
    ASSERT_EQ(record["days"].size(), 3u);
    EXPECT_EQ(record["days"][2]["turn_deg"], 240);
    EXPECT_EQ(record["days"][2]["day"], 4);
    EXPECT_EQ(record["days"][2]["file"], "orbit_002.png");
    EXPECT_EQ(cv::imread(options.out / "orbit_002.png", cv::IMREAD_UNCHANGED).channels(), 4);
    const cv::Mat light =
        cv::imread(options.out / record["days"][2]["exr"].get<std::string>(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(light.type(), CV_32FC4);
    cv::Mat alpha;
    cv::extractChannel(light, alpha, 3);
    EXPECT_EQ(cv::sum(alpha > 0.5)[0], cv::sum(alpha > 0)[0]) << "with one sample, alpha is 0 or 1";
    EXPECT_GT(cv::countNonZero(alpha), 500);
    EXPECT_TRUE(std::filesystem::exists(options.out / "healing.png"));
}

TEST(ProgressText, CountsAndTellsTheTimeLeft)
{
    EXPECT_EQ(base::progress_text("day 3", 0, 1, 9), "day 3");
    EXPECT_EQ(base::progress_text("day 3", 0, 40, 9), "day 3   1 of 40   0 %");
    EXPECT_EQ(base::progress_text("day 3", 10, 40, 30), "day 3   11 of 40   25 %   1:30 left");
    EXPECT_EQ(base::progress_text("day 3", 1, 101, 50), "day 3   2 of 101   0 %   1:23:20 left");
}
