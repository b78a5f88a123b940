#include "stage/cost.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/statistics.hpp"

namespace stage {
namespace {
using nlohmann::json;
}

MeasuredCase shading_case(std::string name, const Stage& stage, const optics::Shading& shading, double days)
{
    return {std::move(name), "", [&stage, shading, days](graph::Graph& graph, double position) {
                const double day = stage.scene().days.front() + days * position;
                graph.readback("picture", stage
                                              .declare(graph, {.day = day,
                                                               .tile = stage.scene().size,
                                                               .camera = stage.loaded().camera(),
                                                               .shading = shading})
                                              .images.picture);
            }};
}

json measure_cost(const gpu::Device& device, const graph::ShaderLibrary& library, const Stage& stage,
                  std::vector<std::string>& lines, int rounds)
{
    const optics::Shading own = stage.scene().shading;
    optics::Shading translucent = own, opaque = own;
    translucent.transport = optics::Transport::Published;
    translucent.translucency = true;
    opaque.transport = optics::Transport::Lambert; // of all transports the published one has eq. (6) alone
    optics::Shading plain = opaque;
    plain.normal_map = plain.shadow = false;
    plain.ambient = {0, 0, 0};
    plain.specular_model = optics::SpecularModel::Ward;
    const std::vector<Measurement> measured = measure(
        device, library,
        {shading_case("everything", stage, translucent), shading_case("without_translucency", stage, opaque),
         shading_case("ward_lambert_only", stage, plain), shading_case("unchanged", stage, own),
         shading_case("moving_day", stage, own, 1)},
        {.warm_up = 1, .counted = 0, .timed = rounds});

    const auto named = [&](std::string_view name) -> const Measurement& {
        return *std::ranges::find(measured, name, &Measurement::name);
    };
    const auto forward_ms = [&](std::string_view name) {
        return base::median(pass_ms(named(name), "forward"));
    };
    json result{{"rounds", rounds}, {"variants", json::object()}};
    for (const char* variant : {"everything", "without_translucency", "ward_lambert_only"})
        result["variants"][variant] = {{"forward_ms", forward_ms(variant)},
                                       {"frame_ms", base::median(wall_ms(named(variant)))}};
    const double everything = forward_ms("everything"), opaque_ms = forward_ms("without_translucency"),
                 plain_ms = forward_ms("ward_lambert_only"), transported = forward_ms("unchanged");
    const double still = base::median(wall_ms(named("unchanged"))),
                 moving = base::median(wall_ms(named("moving_day")));
    result["transport_over_lambert"] = transported / opaque_ms;
    result["translucency_over_none"] = everything / opaque_ms;
    result["everything_over_ward_lambert"] = everything / plain_ms;
    result["unchanged_frame_ms"] = still;
    result["moving_day_over_unchanged"] = moving / still;
    lines.push_back(fmt::format("forward pass, median of {} frames: {:.1f} ms with all terms, {:.2f} x the "
                                "time without translucency, {:.2f} x the time with Ward and Lambert only",
                                rounds, everything, everything / opaque_ms, everything / plain_ms));
    lines.push_back(fmt::format("forward pass with the scene's transport {:.1f} ms, {:.2f} x that of lambert",
                                transported, transported / opaque_ms));
    lines.push_back(fmt::format("unchanged frame {:.1f} ms; a frame on which the day moved {:.2f} x that",
                                still, moving / still));
    return result;
}

} // namespace stage
