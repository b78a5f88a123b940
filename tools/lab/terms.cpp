// `cicatrix-lab terms`: the table of docs/shading.md that says what each term of the shading costs.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/machine.hpp"
#include "base/number_option.hpp"
#include "base/progress.hpp"
#include "base/statistics.hpp"
#include "stage/cost.hpp"
#include "stage/renderer.hpp"
#include "tools/lab/commands.hpp"
#include "tools/lab/document_tables.hpp"

namespace lab {
namespace {

using optics::Shading;

std::vector<std::pair<std::string, Shading>> variants(const Shading& everything)
{
    std::vector<std::pair<std::string, Shading>> all{{"everything", everything}};
    const auto add = [&](const std::string& name, const auto& change) {
        all.emplace_back(name, everything);
        change(all.back().second);
    };
    add("`bounce` off", [](Shading& s) { s.bounce = false; });
    add("`ambient` 0, which takes the bounce along", [](Shading& s) { s.ambient = {0, 0, 0}; });
    add("`shadow` off", [](Shading& s) { s.shadow = false; });
    add("`specular_model` ward: one lobe, no film",
        [](Shading& s) { s.specular_model = optics::SpecularModel::Ward; });
    add("`ward` off: no highlight", [](Shading& s) { s.ward = false; });
    add("`normal_map` off", [](Shading& s) { s.normal_map = false; });
    for (std::size_t i = 0; i < optics::transport_names.size(); ++i)
        if (const auto transport = optics::Transport(i); transport != everything.transport)
            add(fmt::format("`transport` {}", optics::transport_names[i]),
                [&](Shading& s) { s.transport = transport; });
    return all;
}

/// By frame: CPU time over that of the first case in the same round.
std::vector<double> ratios(const stage::Measurement& one, const stage::Measurement& first)
{
    std::vector<double> result = stage::process_cpu_ms(one);
    const std::vector<double> base = stage::process_cpu_ms(first);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] /= base[i];
    return result;
}

void write_terms(const std::filesystem::path& document, int frames)
{
    stage::Renderer renderer({});
    const stage::Stage stage(renderer.device, stage::Stage::prepare({}));
    std::vector<stage::MeasuredCase> cases;
    for (const auto& [name, shading] : variants(stage.scene().shading))
        cases.push_back(stage::shading_case(name, stage, shading));
    const double load = base::load_average();
    const stage::Rounds rounds{.warm_up = 2, .counted = 0, .timed = frames};
    base::Progress progress;
    progress.expect(std::size_t(rounds.all()));
    const std::vector<stage::Measurement> measured =
        stage::measure(renderer.device, renderer.shaders, cases, rounds, [&](int) {
            progress.step();
            progress.show("frames");
        });
    progress.clear();
    std::string table = "| drawn | CPU ms | over everything: median (5 % to 95 %) | pass `forward`, ms "
                        "|\n|---|---|---|---|\n";
    for (const stage::Measurement& one : measured) {
        const base::Spread ratio = base::spread_of(ratios(one, measured.front())).value();
        table += fmt::format("| {} | {:.1f} | {:.2f} ({:.2f} to {:.2f}) | {:.1f} |\n", one.name,
                             base::median(stage::process_cpu_ms(one)), ratio.median, ratio.p5, ratio.p95,
                             base::median(stage::pass_ms(one, "forward")));
    }
    replace_tables(document, {{"terms", table}});
    fmt::print("the table of {}; {} frames of each on {}; load of the machine {:.1f} before, {:.1f} after\n",
               document.string(), frames, renderer.device.info().name, load, base::load_average());
}

} // namespace

void add_terms(CLI::App& program)
{
    struct Options
    {
        std::filesystem::path document;
        int frames = 40;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "terms", "CPU time of a frame without each term of the shading: docs/shading.md");
    command->add_option("document", options->document, "Where the table stands: docs/shading.md")
        ->required()
        ->type_name("DOCUMENT.md");
    command->add_option("--frames", options->frames, "Frames of each case, drawn in turn")
        ->transform(base::whole_number_from(5, 10000))
        ->capture_default_str();
    command->callback([options] { write_terms(options->document, options->frames); });
}

} // namespace lab
