// What systems.json says, in words.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/compare/systems.hpp"

namespace compare_command {
namespace {
using nlohmann::json;

constexpr std::array known_systems{
    SystemFacts{"ward", "Ward 1992 [15], with Lambert", "115-116", "any light under the skin"},
    SystemFacts{"oren-nayar", "layered Oren-Nayar, Gotanda 2012 [24]", "115-116", "any light under the skin"},
    SystemFacts{"chang", "texture-space importance sampling, Chang et al. 2008 [25]", "< 20",
                "thin parts across the texture's seams", 5.7},
    SystemFacts{"shah", "image-space splatting, Shah et al. 2009 [10]", "30-35",
                "light that the picture does not show", 3.7},
    SystemFacts{"wang", "heterogeneous diffusion, Wang et al. 2010 [9]", "<= 31.8", "detail below its grid",
                3.7},
    SystemFacts{"li", "hybrid Monte Carlo, Li et al. 2005 [16]", "10", "a picture without noise", 11.4},
    SystemFacts{"jensen", "dipole, Jensen et al. 2001 [7], octree, Jensen & Buhler 2002", "",
                "layers; thin parts as they are; light nearer than its samples", 1.},
    SystemFacts{"donner-jensen", "multipole per layer, Donner & Jensen 2005 [21]", "",
                "a width that follows the skin's colour; light nearer than its samples", 1.},
    SystemFacts{"separable", "separable screen space, Jimenez et al. 2015", "",
                "light that the picture does not show", 1.},
    SystemFacts{"burley", "Burley in screen space, Golubev 2018", "", "light that the picture does not show",
                1.},
    SystemFacts{"published", "the paper's own, eq. (8)", "114", "shadow or thickness in what is translucent"},
    SystemFacts{"lambert", "Lambert under our highlight", "", "any light under the skin"},
    SystemFacts{"preintegrated", "ours, after Penner 2011", "", "light from beside a point"},
    SystemFacts{"diffused", "ours, after d'Eon et al. 2007 and Burley 2015", "",
                "light on the far side of thin parts but by their thickness"},
    SystemFacts{"reference", "random walks, path traced", "", "a picture within a second"}};
constexpr double paper_over_ward = 1.02; // "less than 2 %"

const json* named(const json& systems, std::string_view name)
{
    const auto found = std::ranges::find_if(
        systems, [&](const json& one) { return one.at("name").get_ref<const std::string&>() == name; });
    return found == systems.end() ? nullptr : &*found;
}

std::optional<double> number(const json& object, const std::string& pointer)
{
    const json value = object.value(json::json_pointer(pointer), json());
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::string shown(const std::optional<double>& value, const char* format = "{:.2f}")
{
    return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

void claim(json& claims, const std::string& what, bool holds, const std::string& measured)
{
    claims.push_back({{"claim", what}, {"holds", holds}, {"measured", measured}});
}

/// "`ours` is as fast, R times, as each rival", with the camera turning and with the light moving.
void claim_speed(json& claims, const json& systems, const std::string& ours, const SystemFacts& rival)
{
    const json *own = named(systems, ours), *other = named(systems, rival.name);
    if (!own || !other)
        return;
    for (const std::string moved : {"camera", "light"}) {
        const auto mine = number(*own, "/cpu_ms/" + moved), its = number(*other, "/cpu_ms/" + moved);
        if (!mine || !its)
            continue;
        const double ratio = *its / *mine;
        claim(claims,
              fmt::format("`{}` is {} `{}` while the {} moves", ours,
                          *rival.paper_ratio > 1 ? fmt::format("{:g} times as fast as", *rival.paper_ratio)
                                                 : "faster than",
                          rival.name, moved),
              ratio >= *rival.paper_ratio && ratio > 1,
              fmt::format("{:.2f} times, {:.0f} ms against {:.0f} ms", ratio, *mine, *its));
    }
}

/// "`ours` is nearer to the truth than the rival", over the skin.
void claim_error(json& claims, const json& systems, const std::string& ours, const SystemFacts& rival)
{
    const json *own = named(systems, ours), *other = named(systems, rival.name);
    if (!own || !other)
        return;
    std::string words;
    bool all = true, any = false;
    for (const std::string region : {"skin", "wound", "shadow_edges", "thin"}) {
        const auto mine = number(*own, "/error/" + region + "/mean"),
                   its = number(*other, "/error/" + region + "/mean");
        if (!mine || !its)
            continue;
        any = true;
        all = all && *mine < *its;
        words += fmt::format("{}{} {:.2f} against {:.2f}", words.empty() ? "" : ", ", region, *mine, *its);
    }
    if (any)
        claim(claims, fmt::format("`{}` is nearer to the truth than `{}` in every region", ours, rival.name),
              all, words);
}

std::string cost_table(const json& systems)
{
    std::string text =
        "| system | runs on | still | camera | light | day | camera / Ward | light / Ward | frames "
        "per second, camera | in the paper |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const json& one : systems) {
        text +=
            fmt::format("| `{}` | {} |", one["name"].get<std::string>(), one["runs_on"].get<std::string>());
        for (const std::string_view name : system_cases)
            text += fmt::format(" {} |", shown(number(one, fmt::format("/cpu_ms/{}", name)), "{:.1f}"));
        text += fmt::format(" {} | {} | {} | {} |\n", shown(number(one, "/ratio_to_ward/camera")),
                            shown(number(one, "/ratio_to_ward/light")),
                            shown(number(one, "/fps/camera"), "{:.1f}"), one["paper_fps"].get<std::string>());
    }
    return text;
}

std::string error_table(const json& systems)
{
    std::string text =
        "| system | skin | wound | shadow edges | thin parts | FLIP |\n|---|---|---|---|---|---|\n";
    for (const json& one : systems) {
        text += fmt::format("| `{}` |", one["name"].get<std::string>());
        for (const std::string region : {"skin", "wound", "shadow_edges", "thin"}) {
            const auto mean = number(one, "/error/" + region + "/mean"),
                       p95 = number(one, "/error/" + region + "/p95");
            text += fmt::format(" {}{} |", shown(mean), p95 ? fmt::format(" / {:.2f}", *p95) : "");
        }
        text += fmt::format(" {} |\n", shown(number(one, "/flip"), "{:.4f}"));
    }
    return text;
}

std::string other_table(const json& systems)
{
    std::string text = "| system | what it is | memory, MB | before the first picture, s | what it cannot do "
                       "|\n|---|---|---|---|---|\n";
    for (const json& one : systems)
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", one["name"].get<std::string>(),
                            one["source"].get<std::string>(), shown(number(one, "/memory_mb"), "{:.1f}"),
                            shown(number(one, "/precompute_s")), one["cannot"].get<std::string>());
    return text;
}

std::string missing(const json& systems)
{
    std::string names;
    for (const SystemFacts& one : known_systems)
        if (!named(systems, one.name))
            names += fmt::format("{}`{}`", names.empty() ? "" : ", ", one.name);
    return names.empty() ? ""
                         : fmt::format("Not in this program, so nothing is said of them: {}.\n\n", names);
}

} // namespace

SystemFacts facts_of(std::string_view name)
{
    const auto found = std::ranges::find(known_systems, name, &SystemFacts::name);
    return found == known_systems.end() ? SystemFacts{.name = name, .source = "a transport of the rasteriser"}
                                        : *found;
}

json claims_of(const json& systems)
{
    json claims = json::array();
    for (const std::string moved : {"camera", "light"})
        if (const json* own = named(systems, "published"))
            if (const auto ratio = number(*own, "/ratio_to_ward/" + moved))
                claim(
                    claims,
                    fmt::format("`published` costs less than 2 % more than `ward` while the {} moves", moved),
                    *ratio < paper_over_ward, fmt::format("{:+.1f} %", 100 * (*ratio - 1)));
    for (const std::string ours : {"published", "diffused"})
        for (const SystemFacts& rival : known_systems)
            if (rival.paper_ratio) {
                if (ours != "published" || *rival.paper_ratio > 1)
                    claim_speed(claims, systems, ours, rival);
                claim_error(claims, systems, ours, rival);
            }
    return claims;
}

std::string systems_page(const json& record, const std::string& picture)
{
    const json& systems = record["systems"];
    std::string text = fmt::format(
        "# The systems of the paper, and what came after\n\n"
        "Made by `cicatrix compare --systems SCENE --document docs/rivals.md`{} on {}{}: {}, day {:g}, one "
        "run, "
        "load {:.1f}. Each system draws the same head with the same camera, lights and tissue. The truth is "
        "the "
        "path-traced [reference](reference.md); two such truths differ by {:.2f} on average.\n\n"
        "![Each system's picture and how far it is from the truth]({})\n\n",
        record["interrupted"].get<bool>() ? " (interrupted)" : "", record["device"].get<std::string>(),
        record["software_rasteriser"].get<bool>() ? ", a rasteriser in software" : "",
        record["size"].get<std::string>(), record["day"].get<double>(), record["load"].get<double>(),
        record["noise_de"].get<double>(), picture);
    text += fmt::format(
        "## Cost\n\nProcessor time of a frame, ms, all threads, medians of {} frames, all systems drawn in "
        "turn. "
        "`still`: nothing changes. `camera` and `light` go around the head, `day` passes. Each keeps between "
        "frames what its method allows. With software rendering all systems run on the same processor, so "
        "times "
        "compare; the paper's were measured on a GeForce GTX 580. Systems on `cpu` are drawn in every third "
        "round, with one ray per pixel, and what a day's tissue needs of photon walks is made "
        "before.\n\n{}\n",
        record["rounds"].get<int>(), cost_table(systems));
    text +=
        "## Error\n\nCIEDE2000 from the truth: mean / 95th percentile, averaged over 4 x 4 places in a "
        "pixel, on the processor over 3 x 3. FLIP is the mean over the head. `ward` and `published` shine as "
        "the paper has it, one "
        "lobe of rho_s = .8, with its rho_d = .7; all others have the scene's highlight, which is also the "
        "truth's, so `lambert` is the one that lacks nothing but scattering.\n\n" +
        error_table(systems) + "\n## Memory, and what comes before\n\n" +
        "Memory: what the system's frame keeps, on the device its images. Before the first picture: wall "
        "clock, with all that is made once.\n\n" +
        other_table(systems) + "\n## Claims\n\n" + missing(systems) +
        "| | claim | measured |\n|---|---|---|\n";
    for (const json& one : record["claims"])
        text += fmt::format("| {} | {} | {} |\n", one["holds"].get<bool>() ? "holds" : "**does not hold**",
                            one["claim"].get<std::string>(), one["measured"].get<std::string>());
    return text;
}

} // namespace compare_command
