// Whole pictures: the same whoever traces them and however often he is interrupted, as noisy as they say, and
// kept.
#include "reference/truth.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/input_error.hpp"
#include "base/tone_curve.hpp"
#include "reference/kept.hpp"
#include "reference/output.hpp"
#include "scenes.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using reference::Request;
using reference::Truth;
using reference::Until;

/// Keeps pictures in a folder of its own while it lives.
class Truths : public testing::Test
{
  protected:
    Truths() { setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
    ~Truths() override { unsetenv("XDG_CACHE_HOME"); }

    static scene::LoadedScene lit_head()
    {
        scene::LoadedScene scene = scenes::scene_of(small::head(), .8);
        scene.scene.shading.ambient = {.1, .1, .12};
        scene.lights = {
            {.kind = optics::LightKind::Directional,
             .direction = cv::normalize(cv::Vec3d(-2, 1, 2)),
             .strength = {.7, .7, .7}},
            {.kind = optics::LightKind::Point, .position = {.5, .1, .5}, .strength = {.1, .1, .1}}};
        return scene;
    }
    static Request request(std::uint64_t seed = 1)
    {
        return {.camera = {{0, 0, .8}, {0, 0, 0}, 20}, .size = {32, 32}, .levels = {}, .seed = seed};
    }
    Truth find(const scene::LoadedScene& scene, const Request& wanted, const Until& until,
               const reference::TruthOptions& options = {})
    {
        base::Progress progress(false);
        return reference::find_truth(scene, wanted, until, progress, notes_, options);
    }
    static bool same(const Truth& a, const Truth& b)
    {
        return a.picture.samples() == b.picture.samples() &&
               cv::norm(a.picture.radiance(), b.picture.radiance(), cv::NORM_INF) == 0 &&
               cv::norm(a.picture.diffuse_error(), b.picture.diffuse_error(), cv::NORM_INF) == 0 &&
               a.noise_de == b.noise_de;
    }

    const TemporaryFolder folder_;
    std::vector<std::string> notes_;
};

TEST_F(Truths, DoNotDependOnThreads)
{
    const scene::LoadedScene scene = lit_head();
    const Truth one = find(scene, request(), {.samples = 8}, {.threads = 1, .use_cache = false}),
                three = find(scene, request(), {.samples = 8}, {.threads = 3, .use_cache = false});
    EXPECT_TRUE(same(one, three));
    EXPECT_FALSE(same(one, find(scene, request(2), {.samples = 8}, {.use_cache = false})));
}

TEST_F(Truths, GoOnWhereTheyEnded)
{
    const scene::LoadedScene scene = lit_head();
    const Truth whole = find(scene, request(), {.samples = 20}, {.use_cache = false});
    find(scene, request(), {.samples = 8});
    EXPECT_TRUE(same(find(scene, request(), {.samples = 20}), whole));
    // What is there is taken, more than was asked for, too; nothing is traced.
    const Truth kept = find(scene, request(), {.samples = 8});
    EXPECT_TRUE(same(kept, whole));
    EXPECT_GT(kept.cpu_seconds, 0);
    ASSERT_TRUE(kept.skin);
    EXPECT_GT(kept.skin->mean_free_path_mm[0], 0);
}

TEST_F(Truths, AreKnownByAllThatTheyDependOn)
{
    const scene::LoadedScene scene = lit_head();
    const std::uint64_t key = reference::truth_key(scene, request());
    EXPECT_EQ(reference::truth_key(lit_head(), request()), key);
    const auto differs = [&](auto change) {
        scene::LoadedScene other_scene = lit_head();
        Request other = request();
        change(other_scene, other);
        return reference::truth_key(other_scene, other) != key;
    };
    EXPECT_TRUE(differs([](auto& s, auto&) { s.scene.shading.rho_d = .7; }));
    EXPECT_TRUE(differs([](auto& s, auto&) { s.scene.lights[0].intensity = 2; }));
    EXPECT_TRUE(differs([](auto& s, auto&) { s.scene.tissue = "dark"; }));
    EXPECT_TRUE(differs([](auto&, auto& r) { r.levels.bounces = 1; }));
    EXPECT_TRUE(differs([](auto&, auto& r) { r.levels.medium.index = 1.4; }));
    EXPECT_TRUE(differs([](auto&, auto& r) { r.camera.eye.x = .1; }));
    EXPECT_TRUE(differs([](auto&, auto& r) { r.size = {32, 33}; }));
    EXPECT_TRUE(differs([](auto&, auto& r) { r.day = 3; }));
    EXPECT_TRUE(differs([](auto&, auto& r) { r.seed = 3; }));
    // Encoding comes after, and the request has the camera.
    EXPECT_FALSE(differs([](auto& s, auto&) { s.scene.exposure_stops = 1; }));
    EXPECT_FALSE(differs([](auto& s, auto&) { s.scene.camera.fov_deg = 30; }));
}

// Two seeds differ by what their standard errors say: over blocks of 4 x 4 pixels, z = difference / error has
// a variance of 1, and less where stratified places within pixels do better than chance.
TEST_F(Truths, OfTwoSeedsAgreeWithinTheirErrors)
{
    const scene::LoadedScene scene = lit_head();
    const Truth a = find(scene, request(1), {.samples = 32}), b = find(scene, request(2), {.samples = 32});
    const cv::Mat3f da = a.picture.diffuse(), db = b.picture.diffuse(), ea = a.picture.diffuse_error(),
                    eb = b.picture.diffuse_error();
    double squares = 0, largest = 0;
    int blocks = 0;
    for (int y = 0; y < da.rows; y += 4)
        for (int x = 0; x < da.cols; x += 4) {
            const cv::Rect block(x, y, 4, 4);
            const double difference = cv::sum(da(block))[1] - cv::sum(db(block))[1];
            const double variance = cv::norm(ea(block), cv::NORM_L2SQR) + cv::norm(eb(block), cv::NORM_L2SQR);
            if (variance <= 0)
                continue;
            const double z = difference / std::sqrt(variance / 3); // the norm is of all three channels
            squares += z * z;
            largest = std::max(largest, std::abs(z));
            ++blocks;
        }
    ASSERT_GT(blocks, 20);
    EXPECT_LT(squares / blocks, 1.6);
    EXPECT_GT(squares / blocks, .2);
    EXPECT_LT(largest, 4.5);
}

TEST_F(Truths, AreAsNoisyAsTheySay)
{
    const scene::LoadedScene scene = lit_head();
    const Truth a = find(scene, request(1), {.samples = 32}), b = find(scene, request(2), {.samples = 32});
    double sum = 0, pixels = 0;
    const cv::Mat4f one = a.picture.radiance(), other = b.picture.radiance();
    const auto lab = [](const cv::Vec4f& seen, double height) {
        return base::shown_lab({seen[0], seen[1], seen[2]}, seen[3], 0, height);
    };
    for (int y = 0; y < one.rows; ++y)
        for (int x = 0; x < one.cols; ++x)
            if (one(y, x)[3] > 0) {
                sum += base::delta_e2000(lab(one(y, x), .5), lab(other(y, x), .5));
                ++pixels;
            }
    // At outlines two whole pictures differ less than the halves say, because the places in a pixel are
    // stratified; so the noise is rather overstated.
    EXPECT_LT(sum / pixels, 1.1 * a.noise_de);
    EXPECT_GT(sum / pixels, .5 * a.noise_de);
    // Four times the samples, half the noise.
    EXPECT_NEAR(find(scene, request(1), {.samples = 128}).noise_de, a.noise_de / 2, .1 * a.noise_de);
    // And so far the request for noise goes, no further.
    const Truth wanted = find(scene, request(3), {.noise_de = 1.5 * a.noise_de});
    EXPECT_LE(wanted.noise_de, 1.5 * a.noise_de);
    EXPECT_LT(wanted.picture.samples(), 32u);
}

TEST_F(Truths, OnABrokenOrClosedCacheAreTracedAllTheSame)
{
    const scene::LoadedScene scene = lit_head();
    const Truth whole = find(scene, request(), {.samples = 8}, {.use_cache = false});
    find(scene, request(), {.samples = 8});
    const std::filesystem::path file = reference::kept_path(reference::truth_key(scene, request()));
    ASSERT_TRUE(std::filesystem::exists(file));
    std::filesystem::resize_file(file, 1000);
    EXPECT_TRUE(same(find(scene, request(), {.samples = 8}), whole));
    EXPECT_TRUE(notes_.empty());

    setenv("XDG_CACHE_HOME", folder_.with("file", "x").c_str(), 1);
    EXPECT_TRUE(same(find(scene, request(), {.samples = 8}), whole));
    ASSERT_EQ(notes_.size(), 1u);
    EXPECT_NE(notes_[0].find("not kept"), std::string::npos);
}

TEST_F(Truths, AreWrittenAsPicturesAndNumbers)
{
    const scene::LoadedScene scene = lit_head();
    const Truth truth = find(scene, request(), {.samples = 8});
    reference::write_truth(folder_ / "out", scene, request(), truth);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/reference.exr"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/reference.png"));
    const nlohmann::json json = base::read_json(folder_ / "out/reference.json");
    EXPECT_EQ(json["samples"], 8);
    EXPECT_EQ(json["noise_de"], truth.noise_de);
    EXPECT_GT(json["cpu_seconds"], 0);
    EXPECT_EQ(json["scene"]["shading"]["rho_d"], .8);
    EXPECT_EQ(json["tissue"]["diffuse_mean_free_path_mm"].size(), 3u);
}

TEST_F(Truths, OfWhatIsTooLargeAreRefused)
{
    Request huge = request();
    huge.size = {16384, 16384};
    EXPECT_THROW(find(lit_head(), huge, {.samples = 4}), base::InputError);
}

} // namespace
