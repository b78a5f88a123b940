#include "apps/compare/compare.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <future>
#include <nlohmann/json.hpp>

#include "apps/compare/against_reference.hpp"
#include "apps/compare/page.hpp"
#include "apps/compare/systems.hpp"
#include "base/axis.hpp"
#include "base/color.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/number_option.hpp"
#include "base/progress.hpp"
#include "base/statistics.hpp"
#include "base/text.hpp"
#include "scene/command_line.hpp"
#include "scene/file.hpp"
#include "scene/shots.hpp"
#include "stage/measurement.hpp"
#include "stage/renderer.hpp"

namespace compare_command {
namespace {
using nlohmann::json;

constexpr std::size_t max_rows = 24; // evenly spaced among all pictures

std::string name_of(const std::string& file)
{
    return file.empty() ? "default scene" : std::filesystem::path(file).stem().string();
}

std::array<scene::Scene, 2> both_scenes(const CompareOptions& options)
{
    scene::SceneOptions second = options;
    second.scene = options.other;
    std::array<scene::Scene, 2> scenes{scene::chosen_scene(options), scene::chosen_scene(second)};
    if (scenes[0].size != scenes[1].size)
        throw base::InputError(options.other + ": size", "differs from that of " + options.scene,
                               "make them equal, or give --size");
    if (scenes[0].days != scenes[1].days)
        throw base::InputError(options.other + ": days", "differ from those of " + options.scene,
                               "make them equal, or give --days");
    return scenes;
}

/// Draws both scenes alternately and compares the median times of the forward pass.
json interleaved_cost(stage::Renderer& renderer, const std::array<const stage::Stage*, 2>& stages,
                      const std::array<scene::Shot, 2>& shots, int rounds)
{
    std::vector<stage::MeasuredCase> cases;
    for (std::size_t side = 0; side < 2; ++side)
        cases.push_back({side == 0 ? "a" : "b", "",
                         [&stage = *stages[side], &shot = shots[side]](graph::Graph& graph, double) {
                             graph.readback("picture", stage
                                                           .declare(graph, {.day = shot.day,
                                                                            .tile = stage.scene().size,
                                                                            .camera = shot.camera})
                                                           .images.picture);
                         }});
    const std::vector<stage::Measurement> measured = stage::measure(
        renderer.device, renderer.shaders, cases, {.warm_up = 2, .counted = 0, .timed = rounds});
    const double a = base::median(stage::pass_ms(measured[0], "forward"));
    const double b = base::median(stage::pass_ms(measured[1], "forward"));
    return {{"rounds", rounds}, {"forward_ms", {{"a", a}, {"b", b}}}, {"forward_b_over_a", b / a}};
}

/// Shots of both scenes; their names must be equal.
std::array<std::vector<scene::Shot>, 2> both_shots(const std::array<const stage::Stage*, 2>& stages,
                                                   const std::vector<std::string>& views)
{
    std::array<std::vector<scene::Shot>, 2> shots;
    for (std::size_t side = 0; side < 2; ++side)
        shots[side] = scene::shots_of_days(stages[side]->scene().days,
                                           scene::chosen_views(stages[side]->loaded(), views));
    if (!std::ranges::equal(shots[0], shots[1], {}, &scene::Shot::name, &scene::Shot::name))
        throw base::InputError("the scenes' views", "differ", "choose the views to compare with --views");
    return shots;
}

json record_of(const scene::Shot& shot, const ColorDifference& difference)
{
    json record{
        {"day", shot.day},
        {"head_pixels", difference.pixels},
        {"delta_e2000",
         {{"mean", difference.mean}, {"percentile_95", difference.percentile_95}, {"max", difference.max}}}};
    if (!shot.view.empty())
        record["view"] = shot.view;
    return record;
}

void run_compare(const CompareOptions& options)
{
    const std::array<scene::Scene, 2> scenes = both_scenes(options);
    base::make_folder(options.out);
    auto first = std::async(std::launch::async, [&] { return stage::Stage::prepare(scenes[0]); });
    auto second = std::async(std::launch::async, [&] { return stage::Stage::prepare(scenes[1]); });
    stage::Renderer renderer(stage::device_options(options));
    const stage::Stage a(renderer.device, first.get()), b(renderer.device, second.get());
    for (const stage::Stage* stage : {&a, &b})
        for (const std::string& note : stage->loaded().notes)
            fmt::print(stderr, "note: {}\n",
                       base::printable(fmt::format(
                           "{}: {}", name_of(stage == &a ? options.scene : options.other), note)));
    const auto shots = both_shots({&a, &b}, options.views);

    base::Progress progress;
    progress.expect(shots[0].size() + 1);
    stage::DrawOptions drawing;
    drawing.size = scenes[0].size;
    json days = json::array();
    std::vector<PageRow> rows;
    std::vector<ColorDifference> differences; // of the rows
    double top = 0;
    const std::size_t stride = (shots[0].size() + max_rows - 1) / max_rows;
    for (std::size_t i = 0; i < shots[0].size(); ++i) {
        progress.show(shots[0][i].name);
        drawing.transparent = true;
        const ColorDifference difference =
            color_difference(stage::draw(renderer, a, shots[0][i], drawing).picture,
                             stage::draw(renderer, b, shots[1][i], drawing).picture);
        days.push_back(record_of(shots[0][i], difference));
        if (i % stride == 0) {
            drawing.transparent = false;
            const std::string view = shots[0][i].view.empty() ? "" : "   " + shots[0][i].view;
            differences.push_back(difference);
            rows.push_back(
                {{stage::draw(renderer, a, shots[0][i], drawing).picture,
                  stage::draw(renderer, b, shots[1][i], drawing).picture},
                 fmt::format(
                     "day {:g}{}   dE2000 on the head: mean {:.2f}, 95 % below {:.2f}, at most {:.2f}",
                     shots[0][i].day, view, difference.mean, difference.percentile_95, difference.max)});
        }
        top = std::max(top, difference.percentile_99_9);
        progress.step();
    }
    progress.show("cost");
    const json cost = interleaved_cost(renderer, {&a, &b}, {shots[0][0], shots[1][0]}, options.rounds);
    progress.clear();

    const std::string name_a = name_of(options.scene), name_b = name_of(options.other);
    top = base::round_up(std::max(top, .1));
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i].cells.push_back(color_mapped(differences[i].map, top, differences[i].head));
    base::write_png(options.out / "compare.png",
                    draw_page({"A: " + name_a, "B: " + name_b, "difference, dE2000"}, rows, top));
    stage::fail_on_validation(renderer.device);
    base::write_json(options.out / "compare.json", {{"device", renderer.device.info().name},
                                                    {"a", scene::to_json(scenes[0])},
                                                    {"b", scene::to_json(scenes[1])},
                                                    {"days", days},
                                                    {"cost", cost}});
    for (const PageRow& row : rows)
        fmt::print("{}\n", row.label);
    fmt::print("forward pass: A {:.1f} ms, B {:.1f} ms, B / A {:.2f} (medians of {}, drawn alternately)\n"
               "compare.png and compare.json in {}\n",
               cost["forward_ms"]["a"].get<double>(), cost["forward_ms"]["b"].get<double>(),
               cost["forward_b_over_a"].get<double>(), options.rounds, options.out.string());
}

} // namespace

ColorDifference color_difference(const cv::Mat4b& a, const cv::Mat4b& b)
{
    CV_Assert(a.size() == b.size());
    ColorDifference result{cv::Mat1f(a.size(), 0.f), cv::Mat1b(a.size(), uchar(0))};
    std::vector<double> values;
    for (int y = 0; y < a.rows; ++y)
        for (int x = 0; x < a.cols; ++x) {
            const cv::Vec4b &p = a(y, x), &q = b(y, x);
            if (p[3] < 255 || q[3] < 255)
                continue;
            const auto lab = [](const cv::Vec4b& pixel) {
                return base::lab_from_linear(base::linear_from_srgb8({pixel[0], pixel[1], pixel[2]}));
            };
            const double difference = p == q ? 0 : base::delta_e2000(lab(p), lab(q));
            result.map(y, x) = float(difference);
            result.head(y, x) = 255;
            result.mean += difference;
            values.push_back(difference);
        }
    result.pixels = int(values.size());
    if (values.empty())
        return result;
    result.mean /= double(values.size());
    result.percentile_95 = base::quantile(values, .95);
    result.percentile_99_9 = base::quantile(values, .999);
    result.max = *std::ranges::max_element(values);
    return result;
}

void add(CLI::App& program)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command =
        program.add_subcommand("compare", "Compare two scenes: their pictures, colour differences and costs");
    scene::add_scene_options(*command, *options);
    command->get_option("scene")->description(
        "First scene, A (docs/scene.md); with --systems the default scene if left out");
    command
        ->add_option("other", options->other,
                     "Second scene, B, of the same size and days; the options below apply to both")
        ->type_name("OTHER.json");
    add_reference_options(*command, *options);
    command
        ->add_option("--views", options->views,
                     "Views to compare, as in cicatrix capture, separated by commas")
        ->delimiter(',')
        ->type_name("NAMES");
    command
        ->add_option("--rounds", options->rounds, "Number of times each scene is drawn to measure its cost")
        ->transform(base::whole_number_from(1, 1000))
        ->capture_default_str();
    command
        ->add_option("--out", options->out,
                     "Folder for compare.png and compare.json, and with --reference the maps")
        ->capture_default_str()
        ->type_name("DIR");
    command->footer("Example: cicatrix compare scenes/translucency_published.json "
                    "scenes/translucency_bounded.json --days 0 --out out/translucency\n"
                    "A difference of 1 (CIEDE2000) is just noticeable. All settings of a scene file can be "
                    "compared: shading models, lights, tissue, healing.\n"
                    "Against the truth: cicatrix compare scene.json --reference --noise 0.5 --out out/truth\n"
                    "All systems: cicatrix compare scene.json --systems --noise 0.5 --out out/systems");
    command->callback([options] {
        if (options->scene.empty() && !options->reference.systems)
            throw CLI::RequiredError("scene");
        if (options->reference.wanted)
            return compare_with_reference(*options);
        if (options->reference.systems)
            return compare_systems(*options);
        if (options->other.empty())
            throw CLI::RequiredError("other, --reference or --systems");
        run_compare(*options);
    });
}

} // namespace compare_command
