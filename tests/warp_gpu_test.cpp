// Every rung of the warp's shader against its double-precision twin.
#include <cmath>
#include <gtest/gtest.h>

#include "engine/executor.hpp"
#include "tests/gpu.hpp"
#include "wound/warp_ladder.hpp"

namespace {

class WarpOnGpu : public gpu::Test
{
  protected:
    cv::Mat2f evaluate(const wound::Warp& warp, std::uint32_t size)
    {
        std::vector<shared::vec2> values{{9, 9}}; // the warp need not come first
        const shared::WarpHeader header = wound::pack(warp, values);
        engine::Graph graph;
        const engine::ImageId day0 = graph.image("day0", {size, size, VK_FORMAT_R32G32_SFLOAT});
        engine::ComputePass& pass = graph.compute("warp test", "warp_test.comp");
        pass.constant("RUNG", std::uint32_t(warp.rung));
        pass.uniform("Warp_", header);
        pass.buffer<shared::vec2>("WarpValues_", values);
        pass.store("day0", day0);
        pass.dispatch(size, size);
        const engine::ReadbackId back = graph.readback("day0", day0);
        engine::Executor executor(gpu::device(), gpu::shaders());
        const engine::FrameResult frame = executor.run(graph);
        return frame.mat(back).clone();
    }
};

wound::ContractionFlow flow_of(const wound::LadderShape& shape)
{
    return wound::prepare_flow(
        shape.border,
        wound::control_points(shape.border, shape.centroid,
                              wound::spacing_from_curvature(shape.border, shape.centroid)),
        shape.centroid);
}

// Tolerances in texels of 512 x 512, at day 0, where a strongly contracted wound is magnified up to tenfold.
TEST_F(WarpOnGpu, EveryRungEqualsItsDoublePrecisionTwin)
{
    constexpr int kSize = 96;
    for (const wound::LadderShape& shape : wound::ladder_shapes()) {
        const wound::ContractionFlow flow = flow_of(shape);
        for (double r : {1.4, 1., .6, .2, .05, .01, 0.})
            for (wound::WarpRung rung :
                 {wound::WarpRung::radial, wound::WarpRung::grid, wound::WarpRung::composed}) {
                const wound::Warp warp = wound::make_warp(flow, r, rung);
                const cv::Mat2f shader = evaluate(warp, kSize);
                const cv::Mat2d reference = wound::backward_map(warp, kSize);
                double worst = 0;
                for (int j = 0; j < kSize; ++j)
                    for (int i = 0; i < kSize; ++i) {
                        ASSERT_TRUE(std::isfinite(shader(j, i)[0]) && std::isfinite(shader(j, i)[1]));
                        worst = std::max(worst, cv::norm(cv::Vec2d(shader(j, i)) - reference(j, i)));
                    }
                EXPECT_LT(worst * 256, .01) << shape.name << ", r = " << r << ", " << wound::name_of(rung);
            }
    }
}

TEST_F(WarpOnGpu, OneThinPlateStepEqualsItsTwinBeforeItFolds)
{
    const wound::ContractionFlow flow = flow_of(wound::ladder_shapes().front());
    for (double r : {1.2, .6, .2}) {
        const wound::Warp warp = wound::make_warp(flow, r, wound::WarpRung::dense);
        cv::Mat2d shader;
        evaluate(warp, 64).convertTo(shader, CV_64F);
        EXPECT_LT(cv::norm(shader, wound::backward_map(warp, 64), cv::NORM_INF) * 256, .01) << r;
    }
}

} // namespace
