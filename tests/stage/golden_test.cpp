// A few small pictures against golden ones in tests/golden/: they say "changed", never "wrong".
//
// After an intended change of the pictures, look at those in golden_failures/ of the build folder and write
// new golden ones:
//   CICATRIX_WRITE_GOLDEN=1 ctest --test-dir build -R Golden
#include <cstdlib>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/image_compare.hpp"
#include "base/image_io.hpp"
#include "scene/command_line.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

void compare(gpu::Executor& executor, const stage::Stage& stage, double day, const std::string& name)
{
    graph::Graph graph;
    const passes::FrameImages images = stage.declare(graph, {.day = day, .tile = stage.scene().size}).images;
    const auto radiance = std::ranges::find(graph.images, "radiance", &graph::Graph::Image::name);
    const graph::ReadbackId ids[] = {
        graph.readback("picture", images.picture),
        graph.readback("radiance", {std::uint32_t(radiance - graph.images.begin())})};
    const gpu::FrameResult frame = executor.run(graph);
    cv::Mat3b picture;
    cv::cvtColor(frame.mat(ids[0]), picture, cv::COLOR_RGBA2RGB);
    cv::Mat linear;
    frame.mat(ids[1]).convertTo(linear, CV_32F);

    const std::filesystem::path golden = std::filesystem::path(CICATRIX_GOLDEN) / (name + ".png");
    if (std::getenv("CICATRIX_WRITE_GOLDEN") != nullptr)
        base::write_png(golden, picture);
    const base::Comparison comparison = base::compare_with_golden(linear, picture, golden, "golden_failures");
    EXPECT_TRUE(comparison.equal) << name << ": " << comparison.report;
}

using Golden = gpu_test::Test;

} // namespace

TEST_F(Golden, PicturesAreUnchanged)
{
    scene::Scene scene = small::scene(small::head());
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const stage::Stage corrected(gpu_test::device(), stage::Stage::prepare(scene));
    compare(executor, corrected, 0, "corrected_day_0");
    compare(executor, corrected, 10, "corrected_day_10");
    scene::make_published(scene);
    const stage::Stage published(gpu_test::device(), stage::Stage::prepare(scene));
    compare(executor, published, 10, "published_day_10");
}
