#include "tools/lab/warp_cost.hpp"

#include <array>
#include <fmt/format.h>

#include "base/progress.hpp"
#include "base/statistics.hpp"
#include "wound/drawn_region.hpp"
#include "wound/prepare.hpp"
#include "wound/skin_match.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace lab {
namespace {

/// A synthetic wound prepared as in a scene, but with the photograph's skin tone instead of the face's.
wound::PreparedWound matched(const std::string& kind, int patch_size)
{
    wound::SyntheticWound synthetic;
    synthetic.kind = kind;
    wound::Preparation preparation;
    preparation.patch_size = patch_size;
    wound::PreparedWound wound = wound::prepare(wound::synthesize(synthetic), preparation);
    wound.patch = wound::match_to_skin(wound.patch, {});
    return wound;
}

struct Milliseconds
{
    double texture = 0, relief = 0;
};

/// Times of both passes, run without cached contents.
Milliseconds run_once(stage::Renderer& renderer, const passes::WoundMaps& maps, const wound::WoundDay& today)
{
    graph::Graph graph;
    const passes::WoundTexture texture =
        passes::add_wound_texture(graph, "", maps, today, passes::pack_warps(today));
    graph.readback("color", texture.color);
    graph.readback("relief", texture.relief);
    renderer.executor.forget();
    const gpu::FrameResult frame = renderer.executor.run(graph);
    const auto ms = [&](const char* pass) { return frame.pass(pass).gpu_ms.value_or(frame.frame_ms); };
    return {ms("wound_texture"), ms("wound_relief")};
}

void measure_models(stage::Renderer& renderer, int rounds, base::Progress& progress)
{
    constexpr int size = 256; // the composed warp takes seconds per megatexel on a software rasteriser
    constexpr std::array<double, 4> ratios{.6, .2, .05, .01};
    constexpr std::array models{wound::WarpModel::Radial, wound::WarpModel::Grid, wound::WarpModel::Dense,
                                wound::WarpModel::Composed};
    const wound::PreparedWound wound = matched("abrasion", size);
    const passes::WoundMaps maps = passes::upload_wound(renderer.device, wound.patch);
    wound::Healing healing;
    healing.model = wound::HealingModel::Contraction; // one warp instead of two
    fmt::print("| r | radial | grid | dense | composed |\n|---|---|---|---|---|\n");
    for (const double ratio : ratios) {
        std::array<std::vector<double>, models.size()> ms;
        std::array<wound::WoundDay, models.size()> days;
        for (std::size_t i = 0; i < models.size(); ++i)
            days[i] = wound::wound_at(wound, healing, wound::day_below(healing.curve, ratio), models[i]);
        for (int round = -1; round < rounds; ++round)
            for (std::size_t i = 0; i < models.size(); ++i) {
                progress.show(fmt::format("r {:g}", ratio));
                if (const Milliseconds once = run_once(renderer, maps, days[i]); round >= 0)
                    ms[i].push_back(once.texture);
            }
        const double megatexels = size * size / 1e6;
        progress.clear();
        fmt::print("| {:g} | {:.1f} | {:.1f} | {:.0f} | {:.0f} |\n", ratio, base::median(ms[0]) / megatexels,
                   base::median(ms[1]) / megatexels, base::median(ms[2]) / megatexels,
                   base::median(ms[3]) / megatexels);
    }
}

void measure_region(stage::Renderer& renderer, int rounds, base::Progress& progress)
{
    fmt::print("\n| default wound | healing | region | texels | patch, ms | region, ms | ratio |\n"
               "|---|---|---|---|---|---|---|\n");
    for (const std::string& name : wound::kind_names()) {
        const wound::PreparedWound wound = matched(name, 512);
        passes::WoundMaps maps = passes::upload_wound(renderer.device, wound.patch);
        for (const wound::HealingModel model : {wound::HealingModel::Face, wound::HealingModel::Contraction})
        {
            wound::Healing healing;
            healing.model = model;
            const std::array regions{cv::Rect(0, 0, 512, 512), wound::drawn_region(wound, healing)};
            const wound::WoundDay today = wound::wound_at(wound, healing, 8);
            std::array<std::vector<double>, 2> ms;
            for (int round = -1; round < rounds; ++round)
                for (std::size_t i = 0; i < 2; ++i) {
                    progress.show(name);
                    maps.region = regions[i];
                    if (const Milliseconds once = run_once(renderer, maps, today); round >= 0)
                        ms[i].push_back(once.texture + once.relief);
                }
            progress.clear();
            fmt::print("| {} | {} | {} x {} | {:.0f} % | {:.1f} | {:.1f} | {:.2f} |\n", name,
                       model == wound::HealingModel::Face ? "face" : "contraction", regions[1].width,
                       regions[1].height, 100. * regions[1].area() / regions[0].area(), base::median(ms[0]),
                       base::median(ms[1]), base::median(ms[1]) / base::median(ms[0]));
        }
    }
}

} // namespace

void measure_warp_cost(stage::Renderer& renderer, int rounds)
{
    base::Progress progress;
    fmt::print("wound_texture on {}, ms per megatexel, medians of {}:\n\n", renderer.device.info().name,
               rounds);
    measure_models(renderer, rounds, progress);
    fmt::print("\nwound_texture and wound_relief on day 8, 512 x 512 patch:\n");
    measure_region(renderer, rounds, progress);
}

} // namespace lab
