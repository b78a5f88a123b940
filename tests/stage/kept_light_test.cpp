// Light that is kept on the skin: pictures are those of light that is computed in every pixel, a camera runs
// its own pass alone, and a new day refreshes the wounds' tiles alone.
#include <gmock/gmock.h>

#include "base/color.hpp"
#include "stage/kept_light.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

using testing::UnorderedElementsAre;

// CIEDE2000. The worst thousandth are the rim of the wound, whose filter is another one, and the edges of
// shadows, whose map is another one: more of a small picture than of a large one.
constexpr double mean_bar = .4, p999_bar = 5, small_p999_bar = 13;

struct Studio
{
    explicit Studio(const scene::Scene& scene) : stage(gpu_test::device(), stage::Stage::prepare(scene)) {}

    stage::FrameRequest request(double day = 3) const
    {
        return {.day = day,
                .tile = stage.scene().size,
                .every_frame = false,
                .light_scale = stage.light_scale(stage.loaded().camera(), stage.scene().size[1]),
                .radiance = false};
    }
    gpu::FrameResult draw(const stage::FrameRequest& request)
    {
        graph::Graph graph;
        graph.readback("picture", stage.declare(graph, request).images.picture);
        return executor.run(graph);
    }
    stage::KeptLightError error(double day = 3)
    {
        return stage::measure_kept_light(executor, stage, request(day));
    }
    head::Camera turned(double metres) const
    {
        head::Camera camera = stage.loaded().camera();
        camera.eye.x += metres;
        return camera;
    }

    stage::Stage stage;
    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
};

scene::Scene small_scene()
{
    return small::scene(small::head());
}

const gpu::PassResult& pass(const gpu::FrameResult& frame, const std::string& name)
{
    return *std::ranges::find(frame.passes, name, &gpu::PassResult::name);
}

TEST(KeptLight, IsTheLightThatEveryPixelComputes)
{
    Studio studio(small::scene(small::head(), 640));
    for (const double day : {0., 3., 30.}) {
        const stage::KeptLightError error = studio.error(day);
        EXPECT_TRUE(error.kept);
        EXPECT_GT(error.pixels, 10000u);
        EXPECT_LT(error.mean, mean_bar) << day;
        EXPECT_LT(error.p999, p999_bar) << day;
    }
}

TEST(KeptLight, IsThatOfEachTransportLightAndHighlight)
{
    scene::Scene scene = small_scene();
    Studio studio(scene);
    const auto check = [&](const char* what) {
        SCOPED_TRACE(what);
        studio.stage.update(scene);
        const stage::KeptLightError error = studio.error();
        EXPECT_TRUE(error.kept);
        EXPECT_LT(error.mean, mean_bar);
        EXPECT_LT(error.p999, small_p999_bar);
    };
    scene.shading.transport = optics::Transport::Preintegrated;
    check("preintegrated");
    scene.shading.transport = optics::Transport::Lambert;
    check("lambert");
    scene.shading.specular_model = optics::SpecularModel::Ward;
    check("ward");
    scene.shading.ward_model = optics::WardModel::Duer;
    check("duer");
    scene.shading.shadow = false;
    check("no shadow");
    scene.shading.bounce = false;
    check("no bounce");
    scene.lights.resize(1);
    scene.shading.ambient = {0, 0, 0};
    check("one light alone");
}

TEST(DiffusedLight, StandsWhileACameraMovesAlsoWhenEveryPixelIsLit)
{
    Studio studio(small_scene());
    stage::FrameRequest request = studio.request();
    request.light_scale.reset();
    EXPECT_THAT(gpu_test::ran(studio.draw(request)),
                testing::IsSupersetOf({"skin shadow", "coarse skin light", "skin diffused", "forward"}));
    request.camera = studio.turned(.002);
    for (const std::string& name : gpu_test::ran(studio.draw(request)))
        EXPECT_FALSE(name.starts_with("skin") || name.starts_with("coarse")) << name;
}

TEST(DiffusedLight, IsNearThatOfDraggedLights)
{
    Studio studio(small::scene(small::head(), 400));
    stage::FrameRequest request = studio.request();
    request.light_scale.reset();
    const auto picture = [&](bool lights_rest) {
        request.lights_rest = lights_rest;
        graph::Graph graph;
        const auto back = graph.readback("picture", studio.stage.declare(graph, request).images.picture);
        return studio.executor.run(graph).mat(back).clone();
    };
    const cv::Mat4b rested = picture(true), dragged = picture(false);
    double sum = 0;
    int differing = 0;
    for (int y = 0; y < rested.rows; ++y)
        for (int x = 0; x < rested.cols; ++x) {
            const auto lab = [](const cv::Vec4b& p) {
                return base::lab_from_linear(base::linear_from_srgb8({p[0], p[1], p[2]}));
            };
            sum += base::delta_e2000(lab(rested(y, x)), lab(dragged(y, x)));
            differing += rested(y, x) != dragged(y, x);
        }
    EXPECT_GT(differing, 1000);
    EXPECT_LT(sum / double(rested.total()), .5);
}

TEST(DiffusedLight, RefreshedRegionsHoldAllThatChanges)
{
    Studio studio(small_scene());
    studio.executor.measure({.check_regions = true}); // throws where the picture is not the whole frame's
    for (const double day : {2., 3., 9., 40.}) {
        stage::FrameRequest request = studio.request(day);
        request.light_scale.reset();
        EXPECT_NO_THROW(studio.draw(request)) << day;
    }
}

TEST(KeptLight, StandsWhileACameraMoves)
{
    Studio studio(small_scene());
    EXPECT_THAT(gpu_test::ran(studio.draw(studio.request())),
                testing::IsSupersetOf(
                    {"skin shadow", "skin", "coarse skin", "skin diffused", "skin light", "forward"}));
    EXPECT_THAT(gpu_test::ran(studio.draw(studio.request())), testing::IsEmpty());
    stage::FrameRequest request = studio.request();
    request.camera = studio.turned(.002);
    const gpu::FrameResult frame = studio.draw(request);
    std::vector<std::string> passes = gpu_test::ran(frame);
    std::erase(passes, "tonemap"); // of a head with blended parts
    EXPECT_THAT(passes, UnorderedElementsAre("forward"));
}

TEST(KeptLight, ANewDayRefreshesTheWoundsTilesAlone)
{
    Studio studio(small_scene());
    studio.draw(studio.request(3));
    const gpu::FrameResult frame = studio.draw(studio.request(4));
    for (const char* name : {"skin", "skin light"}) {
        EXPECT_EQ(pass(frame, name).state, graph::PassState::Run) << name;
        EXPECT_GT(pass(frame, name).work.refreshed, 0) << name;
        EXPECT_LT(pass(frame, name).work.refreshed, .9) << name;
    }
    EXPECT_LT(pass(frame, "forward").work.refreshed, .9);
}

TEST(KeptLight, RefreshedRegionsHoldAllThatChanges)
{
    const scene::Scene scene = small_scene();
    Studio studio(scene);
    studio.executor.measure({.check_regions = true}); // throws where the picture is not the whole frame's
    for (const double day : {2., 3., 9., 40.})
        EXPECT_NO_THROW(studio.draw(studio.request(day))) << day;
}

TEST(KeptLight, IsNotUsedWhereItCannotBeTrue)
{
    scene::Scene scene = small_scene();
    Studio studio(scene);
    const auto kept = [&] {
        studio.stage.update(scene);
        return studio.error().kept;
    };
    scene.shading.transport = optics::Transport::Published; // its translucency belongs to vertices
    EXPECT_FALSE(kept());
    scene = small_scene();
    scene.shading.alpha_y = 2 * scene.shading.alpha_x; // needs tangents
    EXPECT_FALSE(kept());
    scene = small_scene();
    scene.shading.alpha_x = scene.shading.alpha_y = .001; // a mirror: single precision has not the digits
    EXPECT_FALSE(kept());
    scene = small_scene();
    EXPECT_TRUE(kept());
    EXPECT_TRUE(studio.stage.light_scale(studio.stage.loaded().camera(), 256));
    EXPECT_FALSE(studio.stage.light_scale(studio.stage.loaded().camera(), 100000))
        << "finer than the atlas can be";
}

TEST(KeptLight, HeadsWhoseCoordinatesAreUselessAreChartedAnew)
{
    head::Model model = small::head();
    for (head::Vertex& vertex : model.vertices)
        vertex.uv = {.5f, .5f};
    scene::Scene scene = small::scene(model);
    Studio studio(scene);
    const stage::KeptLightError error = studio.error();
    EXPECT_TRUE(error.kept);
    EXPECT_LT(error.mean, mean_bar);
    EXPECT_LT(error.p999, small_p999_bar);
}

} // namespace
