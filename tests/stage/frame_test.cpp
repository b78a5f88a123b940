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

    gpu::FrameResult draw(double day)
    {
        graph::Graph graph;
        graph.readback("picture", stage
                                      .declare(graph, {.day = day,
                                                       .tile = stage.scene().size,
                                                       .camera = stage.loaded().camera(),
                                                       .shading = shading})
                                      .images.picture);
        return executor.run(graph);
    }
    cv::Mat4b picture(double day) { return draw(day).mat({0}).clone(); }

    stage::Stage stage;
    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
    optics::Shading shading;
};

std::vector<std::string> passes_in(const gpu::FrameResult& frame, PassState state)
{
    std::vector<std::string> names;
    for (const gpu::PassResult& pass : frame.passes)
        if (pass.state == state)
            names.push_back(pass.name);
    return names;
}

std::vector<std::string> ran(const gpu::FrameResult& frame)
{
    return passes_in(frame, PassState::Run);
}

double share_that_differs(const cv::Mat4b& a, const cv::Mat4b& b, int by_more_than)
{
    cv::Mat difference;
    cv::absdiff(a, b, difference);
    int count = 0;
    for (const cv::Vec4b& pixel : cv::Mat4b(difference))
        count += std::max({pixel[0], pixel[1], pixel[2]}) > by_more_than;
    return double(count) / double(a.total());
}

using Frame = gpu_test::Test;

} // namespace

TEST_F(Frame, RerunsOnlyPassesThatAChangeAffects)
{
    Studio studio(small::scene(small::head()));
    EXPECT_THAT(ran(studio.draw(3)), UnorderedElementsAre("wound_texture", "wound_relief", "reflectance_lut",
                                                          "shadow", "forward", "tonemap"));

    const gpu::FrameResult unchanged = studio.draw(3);
    EXPECT_THAT(ran(unchanged), UnorderedElementsAre("forward", "tonemap"));
    EXPECT_THAT(passes_in(unchanged, PassState::Skipped),
                UnorderedElementsAre("wound_texture", "wound_relief", "reflectance_lut", "shadow"));

    EXPECT_THAT(ran(studio.draw(4)),
                UnorderedElementsAre("wound_texture", "wound_relief", "forward", "tonemap"));

    scene::Scene scene = studio.stage.scene();
    std::vector<scene::Light>& lights = scene.lights;
    lights[0].intensity *= 0.5;
    studio.stage.update(scene);
    EXPECT_THAT(ran(studio.draw(4)), UnorderedElementsAre("forward", "tonemap"));

    lights[0].from.azimuth_deg += 10; // every light casts a shadow
    studio.stage.update(scene);
    EXPECT_THAT(ran(studio.draw(4)), UnorderedElementsAre("shadow", "forward", "tonemap"));

    lights[1].from.azimuth_deg += 10;
    studio.stage.update(scene);
    EXPECT_THAT(ran(studio.draw(4)), UnorderedElementsAre("shadow", "forward", "tonemap"));

    studio.stage.set_tissue(optics::skin(optics::SkinTone::Dark));
    EXPECT_THAT(ran(studio.draw(4)), UnorderedElementsAre("reflectance_lut", "forward", "tonemap"));

    studio.shading.shadow = false;
    const gpu::FrameResult unshadowed = studio.draw(4);
    EXPECT_THAT(ran(unshadowed), UnorderedElementsAre("forward", "tonemap"));
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
    EXPECT_THAT(ran(numerical.draw(9)),
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
    EXPECT_THAT(ran(studio.draw(3)),
                IsSupersetOf({"wound_texture", "wound_texture 2", "reflectance_lut", "reflectance_lut 2"}));
    EXPECT_THAT(ran(studio.draw(6)),
                UnorderedElementsAre("wound_texture", "wound_relief", "forward", "tonemap"));
}

TEST_F(Frame, WithoutWoundsDeclaresNoneOfTheirPasses)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds.clear();
    Studio studio(scene);
    const gpu::FrameResult first = studio.draw(0);
    EXPECT_EQ(first.passes.size(), 4u) << "and the labels are culled";
    EXPECT_THAT(ran(first), UnorderedElementsAre("shadow", "forward", "tonemap"));
    EXPECT_THAT(ran(studio.draw(9)), UnorderedElementsAre("forward", "tonemap"));
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
