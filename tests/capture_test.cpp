// What `cicatrix capture` draws: tiles that join without a seam, views and cameras as numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "apps/camera_record.hpp"
#include "apps/renderer.hpp"
#include "apps/shots.hpp"
#include "engine/image_compare.hpp"
#include "tests/gpu.hpp"
#include "tests/small_head.hpp"
#include "wound/input_error.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The renderer that these tests share; it watches its own device.
app::Renderer& renderer()
{
    static app::Renderer shared({.validation = true});
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
    static app::Stage stage(const app::Scene& scene)
    {
        return {renderer().device, scene, app::Stage::prepare(scene)};
    }
    static app::Drawing draw(const app::Stage& on, const passes::Camera& camera,
                             const app::DrawOptions& options, double day = 5)
    {
        return app::draw(renderer(), on, {day, "", camera, "test"}, options);
    }
};

/// All channels' differences.
cv::Mat1b difference(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat each, largest;
    cv::absdiff(a, b, each);
    cv::reduce(each.reshape(1, int(each.total())), largest, 1, cv::REDUCE_MAX);
    return largest;
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
    EXPECT_EQ(passes::tiles(passes::Canvas({640, 480}), 640).size(), 1u);
    const std::vector<passes::Canvas> tiles = passes::tiles(passes::Canvas({1001, 640}), 256);
    ASSERT_EQ(tiles.size(), 4u * 3u);
    cv::Mat1b covered = cv::Mat1b::zeros(640, 1001);
    for (const passes::Canvas& tile : tiles) {
        EXPECT_EQ(tile.size, tiles[0].size);
        EXPECT_LE(std::max(tile.size[0], tile.size[1]), 256u);
        EXPECT_EQ(tile.corner[0] % 2 + tile.corner[1] % 2, 0u);
        const cv::Rect at(int(tile.corner[0]), int(tile.corner[1]), int(tile.size[0]), int(tile.size[1]));
        covered(at & cv::Rect(0, 0, 1001, 640)) += 1;
    }
    EXPECT_EQ(cv::countNonZero(covered != 1), 0);
}

// A pixel on an outline may fall to the other side of it, for a vertex is rounded to the device's sub-pixels
// in each tile anew; within the head and the backdrop, rounding alone differs.
TEST_F(Capture, TilesJoinWithoutASeam)
{
    for (const std::uint32_t samples : {1u, 4u})
        for (const bool transparent : {false, true}) {
            app::Scene scene = small::scene(small::head());
            scene.samples = samples;
            const app::Stage on = stage(scene);
            const app::DrawOptions whole{{301, 203}, transparent, true, 2048},
                cut{{301, 203}, transparent, true, 64};
            ASSERT_EQ(app::canvases(cut).size(), 5u * 4u);
            const app::Drawing a = draw(on, on.camera(), whole), b = draw(on, on.camera(), cut);
            const cv::Mat1b differs = difference(a.picture, b.picture);
            EXPECT_LE(cv::countNonZero(differs > 1), 3) << samples << transparent;
            EXPECT_EQ(a.bed_texels, b.bed_texels);
            EXPECT_LT(cv::norm(a.radiance, b.radiance, cv::NORM_L1) / double(a.radiance.total()), 1e-4);
            const cv::Mat1b elsewhere = difference(a.picture, draw(on, on.close_up(0), whole).picture);
            EXPECT_GT(cv::countNonZero(elsewhere > 1), 1000) << "the comparison sees differences";
        }
}

TEST_F(Capture, CameraMatricesAgreeWithEachOtherAndWithThePicture)
{
    app::Scene scene = small::scene(small::head());
    scene.wounds.clear();
    const app::Stage on = stage(scene);
    const passes::Camera camera = on.camera({{25, 10}, 0, 24});
    const std::array<std::uint32_t, 2> size{320, 200};
    const json record = app::camera_record(on, camera, size);
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
    const engine::Model model = small::head();
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

TEST_F(Capture, ViewsAreStandardOnesOrTheScenes)
{
    app::Scene scene = small::scene(small::head());
    scene.views = {{"steep", app::CameraScene{{10, 60}, 0, 20}}, {"close-up", std::nullopt}};
    const app::Stage on = stage(scene);
    const std::vector<app::View> all = app::chosen_views(on, {});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].name, "steep");
    EXPECT_EQ(all[0].camera.eye, on.camera({{10, 60}, 0, 20}).eye);
    EXPECT_EQ(all[1].camera.eye, on.close_up(0).eye);
    const std::vector<app::View> chosen = app::chosen_views(on, {"left", "steep", "camera"});
    EXPECT_LT(chosen[0].camera.eye.x, -0.5);
    EXPECT_EQ(chosen[2].camera.eye, on.camera().eye);
    for (const char* wrong : {"lefft", "close-up-2", "close-up-"})
        try {
            app::chosen_views(on, {wrong});
            ADD_FAILURE() << wrong;
        } catch (const cicatrix::InputError& error) {
            EXPECT_THAT(error.what(),
                        testing::AllOf(HasSubstr(wrong), HasSubstr("three-quarter"), HasSubstr("steep")));
        }
    EXPECT_THROW(app::chosen_views(on, {"left", "left"}), cicatrix::InputError);

    std::vector<std::string> names;
    for (const app::Shot& shot : app::shots_of_days({0, 2.5, 0}, all))
        names.push_back(shot.name);
    EXPECT_THAT(names, testing::ElementsAre("day_000_steep", "day_000_close-up", "day_002.500_steep",
                                            "day_002.500_close-up", "day_000_2_steep", "day_000_2_close-up"));
}
