// The renderer's frame: which passes each change reruns, and that pictures are reproducible.
#include <gmock/gmock.h>

#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using graph::PassState;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

/// A stage on the shared device and an executor that remembers the last frame.
struct Studio
{
    explicit Studio(const scene::Scene& scene)
        : stage(gpu_test::device(), stage::Stage::prepare(scene)), shading(scene.shading)
    {
    }

    gpu::FrameResult draw(double day) { return draw(day, stage.loaded().camera()); }
    gpu::FrameResult draw(double day, const head::Camera& camera)
    {
        graph::Graph graph;
        graph.readback("picture", declare(graph, day, camera).images.picture);
        return executor.run(graph);
    }
    stage::Frame declare(graph::Graph& graph, double day, const head::Camera& camera) const
    {
        return stage.declare(graph, {.day = day,
                                     .tile = stage.scene().size,
                                     .camera = camera,
                                     .shading = shading,
                                     .lights_rest = false}); // kept_light_test.cpp has the passes on the skin
    }
    cv::Mat4b picture(double day) { return draw(day).mat({0}).clone(); }

    stage::Stage stage;
    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
    optics::Shading shading;
};

double share_that_differs(const cv::Mat4b& a, const cv::Mat4b& b, int by_more_than)
{
    cv::Mat difference;
    cv::absdiff(a, b, difference);
    int count = 0;
    for (const cv::Vec4b& pixel : cv::Mat4b(difference))
        count += std::max({pixel[0], pixel[1], pixel[2]}) > by_more_than;
    return double(count) / double(a.total());
}

/// The constants of the forward pass or, if one has a value of its own, of its draws.
std::vector<std::uint32_t> forward_constants(const Studio& studio, const head::Camera& camera,
                                             const char* name)
{
    graph::Graph graph;
    studio.declare(graph, 3, camera);
    for (const graph::Pass& pass : graph.passes)
        if (graph::name_of(pass) == "forward") {
            const auto& forward = std::get<graph::RasterPass>(pass);
            std::vector<std::uint32_t> values;
            const auto take = [&](const graph::Bindings& bindings) {
                if (const auto found = bindings.constants.find(name); found != bindings.constants.end())
                    std::visit([&](auto value) { values.push_back(std::uint32_t(value)); }, found->second);
            };
            take(forward);
            for (const graph::Draw& draw : forward.draws)
                take(draw);
            return values;
        }
    return {};
}

/// Around the head at the height of the scene's camera.
head::Camera turned(const stage::Stage& stage, double azimuth_deg, double fov_deg)
{
    scene::Camera camera = stage.scene().camera;
    camera.from.azimuth_deg = azimuth_deg;
    camera.distance_m = stage.loaded().distance(camera);
    camera.fov_deg = fov_deg;
    return stage.loaded().camera(camera);
}

using Frame = gpu_test::Test;

} // namespace

TEST_F(Frame, RerunsOnlyPassesThatAChangeAffects)
{
    Studio studio(small::scene(small::head()));
    EXPECT_THAT(gpu_test::ran(studio.draw(3)),
                UnorderedElementsAre("wound_texture", "wound_relief", "reflectance_lut", "shadow", "forward",
                                     "tonemap"));

    const gpu::FrameResult unchanged = studio.draw(3);
    EXPECT_THAT(gpu_test::ran(unchanged), UnorderedElementsAre("forward", "tonemap"));
    EXPECT_THAT(gpu_test::passes_in(unchanged, PassState::Skipped),
                UnorderedElementsAre("wound_texture", "wound_relief", "reflectance_lut", "shadow"));

    EXPECT_THAT(gpu_test::ran(studio.draw(4)),
                UnorderedElementsAre("wound_texture", "wound_relief", "forward", "tonemap"));

    scene::Scene scene = studio.stage.scene();
    std::vector<scene::Light>& lights = scene.lights;
    lights[0].intensity *= 0.5;
    studio.stage.update(scene);
    EXPECT_THAT(gpu_test::ran(studio.draw(4)), UnorderedElementsAre("forward", "tonemap"));

    lights[0].from.azimuth_deg += 10; // every light casts a shadow
    studio.stage.update(scene);
    EXPECT_THAT(gpu_test::ran(studio.draw(4)), UnorderedElementsAre("shadow", "forward", "tonemap"));

    lights[1].from.azimuth_deg += 10;
    studio.stage.update(scene);
    EXPECT_THAT(gpu_test::ran(studio.draw(4)), UnorderedElementsAre("shadow", "forward", "tonemap"));

    studio.stage.set_tissue(optics::skin(optics::SkinTone::Dark));
    EXPECT_THAT(gpu_test::ran(studio.draw(4)), UnorderedElementsAre("reflectance_lut", "forward", "tonemap"));

    studio.shading.shadow = false;
    const gpu::FrameResult unshadowed = studio.draw(4);
    EXPECT_THAT(gpu_test::ran(unshadowed), UnorderedElementsAre("forward", "tonemap"));
    EXPECT_EQ(unshadowed.passes.size(), 6u) << "no shadow pass is declared, and the labels are culled";
}

TEST_F(Frame, HeadWithoutANormalMapIsNotTilted)
{
    scene::Scene scene = small::scene(small::wall({.5f, .4f, .3f}), 128);
    scene.wounds.clear();
    Studio studio(scene);
    const cv::Mat4b mapped = studio.picture(0);
    studio.shading.normal_map = false;
    EXPECT_EQ(cv::norm(mapped, studio.picture(0), cv::NORM_INF), 0);
}

TEST_F(Frame, TakesANumericalReflectanceTableFromTheCpu)
{
    const TemporaryFolder cache;
    ::setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
    scene::Scene scene = small::scene(small::head(), 128);
    scene.tissue = "table1"; // three channels only
    Studio calibrated(scene);
    scene.reflectance_model = optics::ReflectanceModel::AddingDoubling;
    Studio numerical(scene);
    ::unsetenv("XDG_CACHE_HOME");
    EXPECT_THAT(gpu_test::ran(numerical.draw(9)),
                UnorderedElementsAre("wound_texture", "wound_relief", "shadow", "forward", "tonemap"));
    const cv::Mat4b a = calibrated.picture(9), b = numerical.picture(9);
    EXPECT_GT(share_that_differs(a, b, 0), 0.001) << "another model gives another colour";
    EXPECT_EQ(share_that_differs(a, b, 16), 0) << "but both must be accurate";
}

TEST_F(Frame, RerunsPassesOnlyForWoundsThatTheDayChanges)
{
    scene::Scene scene = small::scene(small::head(), 64);
    scene.wounds.resize(2);
    scene.wounds[1].place = std::string("forehead");
    scene.wounds[1].healing.curve.delta = 0; // never heals
    scene.wounds[1].healing.model = wound::HealingModel::Contraction;
    Studio studio(scene);
    EXPECT_THAT(gpu_test::ran(studio.draw(3)),
                IsSupersetOf({"wound_texture", "wound_texture 2", "reflectance_lut", "reflectance_lut 2"}));
    EXPECT_THAT(gpu_test::ran(studio.draw(6)),
                UnorderedElementsAre("wound_texture", "wound_relief", "forward", "tonemap"));
}

TEST_F(Frame, WithoutWoundsDeclaresNoneOfTheirPasses)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds.clear();
    Studio studio(scene);
    const gpu::FrameResult first = studio.draw(0);
    EXPECT_EQ(first.passes.size(), 4u) << "and the labels are culled";
    EXPECT_THAT(gpu_test::ran(first), UnorderedElementsAre("shadow", "forward", "tonemap"));
    EXPECT_THAT(gpu_test::ran(studio.draw(9)), UnorderedElementsAre("forward", "tonemap"));
}

TEST_F(Frame, IsTheSameBitByBitInTwoRuns)
{
    const scene::Scene scene = small::scene(small::head());
    Studio first(scene), second(scene);
    second.draw(0); // an earlier frame must have no effect
    const cv::Mat4b a = first.picture(7), b = second.picture(7);
    EXPECT_EQ(share_that_differs(a, b, 0), 0);
    EXPECT_GT(share_that_differs(a, first.picture(0), 8), 0.002) << "the wound is in the picture";
}

TEST_F(Frame, MultisamplingSmoothsEdgesAndLeavesTheRestAlone)
{
    scene::Scene scene = small::scene(small::head());
    Studio plain(scene);
    scene.samples = 4;
    Studio smooth(scene);
    const cv::Mat4b a = plain.picture(5), b = smooth.picture(5);
    const double edges = share_that_differs(a, b, 16);
    EXPECT_GT(edges, 0.001);
    EXPECT_LT(edges, 0.02);
}

// A light without strength and a term without a coefficient: the picture is that of the scene without them,
// and the shader variant too.
TEST_F(Frame, LightsAndTermsThatGiveNothingCostNothing)
{
    scene::Scene scene = small::scene(small::head(), 128);
    Studio plain(scene);
    const head::Camera camera = plain.stage.loaded().camera();
    const cv::Mat4b picture = plain.picture(3);

    scene::Scene with_dark = scene;
    scene::Light dark = scene.lights[0];
    dark.intensity = 0;
    with_dark.lights.insert(with_dark.lights.begin(), dark);
    Studio darkened(with_dark);
    EXPECT_EQ(share_that_differs(darkened.picture(3), picture, 0), 0);
    for (const char* name : {"LIGHTS", "SHADOWS"})
        EXPECT_EQ(forward_constants(darkened, camera, name), forward_constants(plain, camera, name));

    optics::Shading published = scene.shading;
    published.transport = optics::Transport::Published; // so that there is a translucent term
    const auto alike = [&](const char* constant, const auto& no_coefficient, const auto& off,
                           shared::uint value = 0) {
        plain.shading = published;
        no_coefficient(plain.shading);
        const cv::Mat4b zero = plain.picture(3);
        EXPECT_THAT(forward_constants(plain, camera, constant), testing::Each(value)) << constant;
        EXPECT_FALSE(forward_constants(plain, camera, constant).empty()) << constant;
        plain.shading = published;
        off(plain.shading);
        EXPECT_EQ(share_that_differs(zero, plain.picture(3), 0), 0) << constant;
    };
    alike(
        "WARD", [](auto& s) { s.rho_s = 0; }, [](auto& s) { s.ward = false; });
    alike(
        "TRANSPORT", [](auto& s) { s.rho_ts = 0; }, [](auto& s) { s.translucency = false; },
        shared::TRANSPORT_LAMBERT);
    alike(
        "LAMBERT", [](auto& s) { s.rho_d = 0; }, [](auto& s) { s.rho_d = 0, s.lambert = false; });
    plain.shading = scene.shading;
    plain.shading.ambient = {0, 0, 0};
    EXPECT_THAT(forward_constants(plain, camera, "AMBIENT"), testing::Each(0u));

    plain.shading = scene.shading;
    plain.shading.rho_d = plain.shading.rho_s = 0;
    EXPECT_THAT(gpu_test::ran(plain.draw(3)), testing::Not(testing::Contains("shadow")));
    EXPECT_EQ(forward_constants(plain, camera, "SHADOWS"), std::vector{0u});
}

TEST_F(Frame, AWoundThatIsNotInThePictureCostsNothing)
{
    scene::Scene scene = small::scene(small::head(), 128);
    Studio wounded(scene);
    scene.wounds.clear();
    Studio bare(scene);
    int hidden = 0, visible = 0;
    for (int azimuth = -180; azimuth < 180; azimuth += 15)
        for (const double fov_deg : {6., 25.}) {
            const head::Camera camera = turned(wounded.stage, azimuth, fov_deg);
            const gpu::FrameResult frame = wounded.draw(3, camera);
            const double differs = share_that_differs(frame.mat({0}), bare.draw(3, camera).mat({0}), 0);
            const bool culled = frame.pass("wound_texture").state == PassState::Culled;
            for (const char* pass : {"wound_relief", "reflectance_lut"})
                EXPECT_EQ(frame.pass(pass).state == PassState::Culled, culled) << azimuth << ' ' << fov_deg;
            const std::vector<std::uint32_t> variants = forward_constants(wounded, camera, "WOUNDS");
            EXPECT_EQ(*std::ranges::max_element(variants), culled ? 0u : 1u);
            if (culled) {
                EXPECT_EQ(differs, 0) << "hidden, but " << azimuth << ' ' << fov_deg << " shows it";
            }
            hidden += culled;
            visible += differs > 0;
        }
    EXPECT_GE(hidden, 18) << "of 48";
    EXPECT_GE(visible, 12);
    EXPECT_EQ(wounded.draw(3, turned(wounded.stage, 30, 25)).pass("wound_texture").state, PassState::Skipped)
        << "its images are kept while it is hidden";
}

TEST_F(Frame, AWoundBesideThePictureChangesNothingOfTheOther)
{
    scene::Scene scene = small::scene(small::head(), 128);
    Studio one(scene);
    scene.wounds.push_back(scene.wounds[0]);
    scene.wounds[1].place = std::string("forehead");
    Studio two(scene);
    const head::Camera near = two.stage.loaded().close_up(0);
    const gpu::FrameResult frame = two.draw(3, near);
    EXPECT_EQ(frame.pass("wound_texture").state, PassState::Run);
    EXPECT_EQ(frame.pass("wound_texture 2").state, PassState::Culled);
    EXPECT_EQ(share_that_differs(frame.mat({0}), one.draw(3, near).mat({0}), 0), 0);
}

TEST_F(Frame, AWoundThatIsNotInThePictureIsMeasuredAllTheSame)
{
    Studio studio(small::scene(small::head(), 64));
    std::vector<cv::Mat> states;
    for (const double azimuth : {0., 180.}) {
        graph::Graph graph;
        const stage::Frame frame = studio.declare(graph, 3, turned(studio.stage, azimuth, 25));
        const graph::ReadbackId state = graph.readback("state", frame.images.wounds[0].state);
        graph.readback("kinds", frame.images.labels.kinds);
        gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
        cv::Mat& seen = states.emplace_back();
        executor.run(graph).mat(state).convertTo(seen, CV_32F);
    }
    EXPECT_GT(cv::sum(states[0])[2], 0);
    EXPECT_EQ(cv::norm(states[0], states[1], cv::NORM_INF), 0);
}

// The shadow maps are fitted to what the camera sees, but not anew for every little move and for every tile.
TEST_F(Frame, ShadowsAreDrawnAnewOnlyWhenTheViewHasChangedALot)
{
    Studio studio(small::scene(small::head(), 64));
    int drawn = 0;
    for (int i = 0; i < 90; ++i)
        drawn += studio.draw(3, turned(studio.stage, i, 12)).pass("shadow").state == PassState::Run;
    EXPECT_GE(drawn, 2);
    EXPECT_LE(drawn, 45) << "in steps of a degree";

    passes::ViewportTile tile(studio.stage.scene().size);
    for (tile.size = {32, 32}; tile.corner[0] < 64; tile.corner[0] += 32) {
        graph::Graph graph;
        graph.readback("picture", studio.stage
                                      .declare(graph, {.day = 3,
                                                       .tile = tile,
                                                       .camera = turned(studio.stage, 89, 12),
                                                       .shading = studio.shading})
                                      .images.picture);
        EXPECT_EQ(studio.executor.run(graph).pass("shadow").state, PassState::Skipped);
    }
}
