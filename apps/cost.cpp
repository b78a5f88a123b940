#include "apps/cost.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace app {
namespace {
using nlohmann::json;

struct Variant
{
    const char* name;
    passes::Shading shading;
    std::vector<double> forward_ms, frame_ms;
};

std::vector<Variant> variants(const passes::Shading& everything)
{
    passes::Shading opaque = everything, plain = everything;
    opaque.translucency = false;
    plain.translucency = plain.normal_map = plain.shadow = false;
    plain.ambient = glm::vec3(0);
    return {{"everything", everything, {}, {}},
            {"without_translucency", opaque, {}, {}},
            {"ward_lambert_only", plain, {}, {}}};
}

} // namespace

double median(std::vector<double> values)
{
    std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

json measure_cost(engine::Executor& executor, const Stage& stage, std::vector<std::string>& lines, int rounds)
{
    const double first = stage.scene().days.front();
    std::vector<Variant> all = variants(stage.scene().shading);
    std::vector<double> moving_ms;
    const auto draw = [&](double day, const passes::Shading& shading) {
        engine::Graph graph;
        graph.readback(
            "picture",
            stage.declare(graph, stage.wounds_on(day), stage.camera(), shading, stage.scene().size).picture);
        return executor.run(graph);
    };
    for (int round = -1; round < rounds; ++round) // the first compiles pipelines and is not counted
    {
        for (Variant& variant : all) {
            draw(first, variant.shading); // leaves only the forward pass to run
            const engine::FrameResult frame = draw(first, variant.shading);
            if (round < 0)
                continue;
            variant.forward_ms.push_back(frame.pass("forward").gpu_ms.value_or(frame.frame_ms));
            variant.frame_ms.push_back(frame.frame_ms);
        }
        if (const engine::FrameResult frame = draw(first + 1 + round * 0.01, all[0].shading); round >= 0)
            moving_ms.push_back(frame.frame_ms);
    }

    json result{{"rounds", rounds}, {"variants", json::object()}};
    for (const Variant& variant : all)
        result["variants"][variant.name] = {{"forward_ms", median(variant.forward_ms)},
                                            {"frame_ms", median(variant.frame_ms)}};
    const double full = median(all[0].forward_ms), still = median(all[0].frame_ms);
    result["translucency_over_none"] = full / median(all[1].forward_ms);
    result["everything_over_ward_lambert"] = full / median(all[2].forward_ms);
    result["unchanged_frame_ms"] = still;
    result["moving_day_over_unchanged"] = median(moving_ms) / still;
    lines.push_back(fmt::format("forward pass, median of {} frames: everything {:.1f} ms; {:.2f} x without "
                                "translucency; {:.2f} x Ward and Lambert only",
                                rounds, full, full / median(all[1].forward_ms),
                                full / median(all[2].forward_ms)));
    lines.push_back(fmt::format("unchanged frame {:.1f} ms; a frame on which the day moved {:.2f} x that",
                                still, median(moving_ms) / still));
    return result;
}

} // namespace app
