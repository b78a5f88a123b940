#include "stage/kept_light.hpp"

#include <algorithm>

#include "base/color.hpp"
#include "base/statistics.hpp"

namespace stage {
namespace {

struct Drawn
{
    cv::Mat4b picture;
    bool kept = false;
};

Drawn drawn(gpu::Executor& executor, const Stage& stage, const FrameRequest& request)
{
    graph::Graph graph;
    const graph::ReadbackId back = graph.readback("picture", stage.declare(graph, request).images.picture);
    const gpu::FrameResult frame = executor.run(graph);
    return {cv::Mat4b(frame.mat(back)).clone(),
            std::ranges::any_of(frame.passes, [](const auto& pass) { return pass.name == "skin light"; })};
}

base::Lab lab_of(const cv::Vec4b& pixel)
{
    return base::lab_from_linear(base::linear_from_srgb8({pixel[0], pixel[1], pixel[2]}));
}

} // namespace

KeptLightError measure_kept_light(gpu::Executor& executor, const Stage& stage, FrameRequest request)
{
    request.tile.transparent = true;
    request.light_scale =
        stage.light_scale(request.camera.value_or(stage.loaded().camera()), request.tile.picture[1]);
    const Drawn kept = drawn(executor, stage, request);
    request.light_scale.reset();
    const Drawn exact = drawn(executor, stage, request);

    KeptLightError error{.kept = kept.kept, .de = cv::Mat1f::zeros(exact.picture.size())};
    std::vector<double> values;
    for (int y = 0; y < exact.picture.rows; ++y)
        for (int x = 0; x < exact.picture.cols; ++x) {
            const cv::Vec4b &a = exact.picture(y, x), &b = kept.picture(y, x);
            if (a[3] != 255 || b[3] != 255)
                continue;
            values.push_back(base::delta_e2000(lab_of(a), lab_of(b)));
            error.de(y, x) = float(values.back());
        }
    if (values.empty())
        return error;
    error.pixels = values.size();
    for (const double value : values)
        error.mean += value / double(values.size());
    error.p95 = base::quantile(values, .95);
    error.p999 = base::quantile(values, .999);
    error.max = base::quantile(values, 1);
    return error;
}

} // namespace stage
