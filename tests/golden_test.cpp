// A few small pictures against golden ones in tests/golden/: they say "changed", never "wrong".
//
// After a change that is meant to be seen, look at the pictures in golden_failures/ of the build folder and
// make new golden ones:
//   CICATRIX_WRITE_GOLDEN=1 ctest --test-dir build -R Golden
#include <cstdlib>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "apps/scene_options.hpp"
#include "apps/stage.hpp"
#include "engine/image_compare.hpp"
#include "engine/image_io.hpp"
#include "tests/gpu.hpp"
#include "tests/small_head.hpp"

namespace {

void compare(engine::Executor& executor, const app::Stage& stage, double day, const std::string& name)
{
    engine::Graph graph;
    const passes::FrameImages images =
        stage.declare(graph, stage.wounds_on(day), stage.camera(), stage.scene().shading, stage.scene().size);
    const auto radiance = std::ranges::find(graph.images, "radiance", &engine::Graph::Image::name);
    const engine::ReadbackId ids[] = {
        graph.readback("picture", images.picture),
        graph.readback("radiance", {std::uint32_t(radiance - graph.images.begin())})};
    const engine::FrameResult frame = executor.run(graph);
    cv::Mat3b picture;
    cv::cvtColor(frame.mat(ids[0]), picture, cv::COLOR_RGBA2RGB);
    cv::Mat linear;
    frame.mat(ids[1]).convertTo(linear, CV_32F);

    const std::filesystem::path golden = std::filesystem::path(CICATRIX_GOLDEN) / (name + ".png");
    if (std::getenv("CICATRIX_WRITE_GOLDEN") != nullptr)
        engine::write_png(golden, picture);
    const engine::Comparison comparison =
        engine::compare_with_golden(linear, picture, golden, "golden_failures");
    EXPECT_TRUE(comparison.equal) << name << ": " << comparison.report;
}

using Golden = gpu::Test;

} // namespace

TEST_F(Golden, PicturesAreUnchanged)
{
    app::Scene scene = small::scene(small::head());
    engine::Executor executor(gpu::device(), gpu::shaders());
    const app::Stage corrected(gpu::device(), scene, app::Stage::prepare(scene));
    compare(executor, corrected, 0, "corrected_day_0");
    compare(executor, corrected, 10, "corrected_day_10");
    app::make_published(scene);
    const app::Stage published(gpu::device(), scene, app::Stage::prepare(scene));
    compare(executor, published, 10, "published_day_10");
}
