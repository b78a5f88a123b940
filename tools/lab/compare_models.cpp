// Error and cost of all reflectance models against the photon walk; errors of tables by size; the presets
// against measured skin.
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>
#include <random>

#include "base/chart.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/progress.hpp"
#include "base/statistics.hpp"
#include "tools/lab/reflectance.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/reflectance_table.hpp"

namespace lab {

using nlohmann::ordered_json;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

ordered_json list(const base::Color& color)
{
    return {color[0], color[1], color[2]};
}

ordered_json list(const base::Lab& lab)
{
    return {lab.l, lab.a, lab.b};
}

double rms(const base::Color& difference)
{
    return cv::norm(difference) / std::sqrt(3.0);
}

/// The colour and its time per channel; cheap models are repeated until the clock can resolve them.
Measured measure(const optics::SkinLayers& tissue, optics::ReflectanceModel model,
                 const optics::ReflectanceOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    Measured result{.model = model, .color = optics::tissue_color(tissue, model, options)};
    int runs = 1;
    while (model != optics::ReflectanceModel::MonteCarlo && seconds_since(start) < 0.02 && ++runs)
        result.color = optics::tissue_color(tissue, model, options);
    result.seconds = seconds_since(start) / runs / static_cast<double>(tissue.channels());
    return result;
}

std::vector<std::pair<std::string, optics::SkinLayers>> compared_stacks()
{
    return {{"Table 1, 0.2 1 4 mm", optics::table1(.2, 1, 4)},
            {"Table 1, 0.2 4 9 mm", optics::table1(.2, 4, 9)},
            {"Table 1, no epidermis", optics::layers_at(optics::restored_skin(optics::table1(), 1), .2)},
            {"light skin", *optics::tissue_preset("light")},
            {"dark skin", *optics::tissue_preset("dark")},
            {"granulation bed", *optics::tissue_preset("granulation")},
            {"scar, 1 month", *optics::tissue_preset("scar")}};
}

} // namespace

std::vector<MeasuredStack> measure_models(const optics::ReflectanceOptions& options, base::Progress& progress)
{
    std::vector<MeasuredStack> result;
    const auto stacks = compared_stacks();
    progress.expect(stacks.size());
    for (const auto& [stack_name, tissue] : stacks) {
        progress.show(stack_name);
        optics::ReflectanceOptions walk =
            options; // `photons` counts 3 channels; a spectrum's channels share them
        walk.photons = std::max<std::uint64_t>(1000, options.photons * 3 / tissue.channels());
        const Measured reference = measure(tissue, optics::ReflectanceModel::MonteCarlo, walk);
        MeasuredStack stack{stack_name, {}};
        for (optics::ReflectanceModel model : optics::all_reflectance_models()) {
            Measured m =
                model == optics::ReflectanceModel::MonteCarlo ? reference : measure(tissue, model, options);
            m.rms_error = rms(m.color - reference.color);
            m.delta_e =
                base::delta_e2000(base::lab_from_linear(m.color), base::lab_from_linear(reference.color));
            stack.models.push_back(m);
        }
        result.push_back(std::move(stack));
        progress.step();
    }
    return result;
}

namespace {

struct Place
{
    shared::uint part;
    double depth, day;
};

/// Random places in both parts of the table; denser towards depth 0 and day 0.
std::vector<Place> random_places(unsigned seed, shared::uint count, const shared::LutAxes& axes)
{
    std::mt19937 random(seed);
    const auto uniform = [&] { return std::uniform_real_distribution(0.0, 1.0)(random); };
    std::vector<Place> places;
    for (shared::uint i = 0; i < count; ++i) {
        const double u = uniform(), v = uniform();
        places.push_back({i % shared::LUT_PARTS, u * u * axes.deepest_mm, v * v * axes.last_day});
    }
    return places;
}

/// Colour of the tissue at each place, computed by a model without a table.
std::vector<base::Color> direct_colors(const optics::HealingTissue& tissue, const std::vector<Place>& places,
                                       optics::ReflectanceModel model, optics::ReflectanceOptions options)
{
    std::vector<base::Color> colors;
    for (const Place& place : places) {
        const optics::SkinLayers layers =
            optics::layers_at(wound::tissue_on(tissue, place.part, place.day), place.depth);
        optics::ReflectanceOptions shared_photons = options; // the channels of a spectrum share them
        shared_photons.photons = std::max<std::uint64_t>(1000, options.photons * 3 / layers.channels());
        colors.push_back(optics::tissue_color(layers, model, shared_photons));
    }
    return colors;
}

struct TableError
{
    double rms = 0, worst = 0;
};

TableError table_error(const cv::Mat3f& table, const shared::LutAxes& axes, const std::vector<Place>& places,
                       const std::vector<base::Color>& truth)
{
    TableError result;
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place& place = places[i];
        const double error =
            rms(wound::sample_table(table, axes, place.part, place.depth, place.day) - truth[i]);
        sum += error * error;
        result.worst = std::max(result.worst, error);
    }
    result.rms = std::sqrt(sum / static_cast<double>(places.size()));
    return result;
}

constexpr shared::uint walked_places = 24;

} // namespace

ordered_json measure_table_sizes(const TableOptions& options, std::span<const std::uint32_t> wanted,
                                 base::Progress& progress)
{
    ordered_json sizes = ordered_json::array();
    for (const std::uint32_t size : wanted)
        sizes.push_back({{"size", size}});
    std::vector<std::string> tissues{"light", "medium", "dark", "table1"};
    if (std::ranges::find(tissues, options.tissue) == tissues.end())
        tissues.push_back(options.tissue);
    progress.expect(tissues.size() * sizes.size());
    for (const std::string& tissue_name : tissues) {
        const optics::HealingTissue tissue = optics::healing_tissue_or_file(tissue_name);
        const shared::LutAxes axes = wound::lut_rows(tissue, wound::Healing{}, 2, options.last_day).axes;
        const std::vector<Place> places = random_places(11, 1000, axes);
        const std::vector<base::Color> direct =
            direct_colors(tissue, places, optics::ReflectanceModel::Calibrated, {});
        const bool walks = tissue_name == options.tissue;
        const std::vector<Place> walked = random_places(12, walks ? walked_places : 0, axes);
        progress.show("table of " + tissue_name);
        const std::vector<base::Color> walk =
            direct_colors(tissue, walked, optics::ReflectanceModel::MonteCarlo, options.reflectance_options);
        for (ordered_json& entry : sizes) {
            progress.show("table of " + tissue_name);
            const auto size = entry["size"].get<std::uint32_t>();
            const cv::Mat3f table = wound::bake_reflectance_table(
                wound::lut_rows(tissue, wound::Healing{}, size, options.last_day).days, size,
                optics::ReflectanceModel::Calibrated);
            const TableError interpolation = table_error(table, axes, places, direct);
            entry[tissue_name] = {{"rms", interpolation.rms}, {"worst", interpolation.worst}};
            if (walks)
                entry[tissue_name]["rms_to_walk"] = table_error(table, axes, walked, walk).rms;
            progress.step();
        }
    }
    return sizes;
}

ordered_json measure_table_against_walk(const TableOptions& options)
{
    const optics::HealingTissue tissue = optics::healing_tissue_or_file(options.tissue);
    const wound::LutRows rows = wound::lut_rows(tissue, wound::Healing{}, options.size, options.last_day);
    const cv::Mat3f table = wound::kept_table(rows, options.size, options.model, options.reflectance_options);
    const std::vector<Place> places = random_places(12, walked_places, rows.axes);
    const TableError error = table_error(
        table, rows.axes, places,
        direct_colors(tissue, places, optics::ReflectanceModel::MonteCarlo, options.reflectance_options));
    return {{"model", optics::name(options.model)},
            {"width", options.size},
            {"height", options.size},
            {"points", walked_places},
            {"rms", error.rms},
            {"worst", error.worst}};
}

/// Colour of each skin preset by model, the measured skin it was fitted to, and the error of using only three
/// wavelengths.
ordered_json measure_presets()
{
    ordered_json presets = ordered_json::array();
    for (const optics::MeasuredSkin& measured : optics::measured_skins()) {
        const optics::SkinLayers skin = *optics::tissue_preset(measured.preset);
        ordered_json entry{{"preset", measured.preset},
                           {"site", measured.site},
                           {"source", measured.source},
                           {"measured_lab", list(measured.lab)}};
        for (const optics::ReflectanceModel model :
             {optics::ReflectanceModel::AddingDoubling, optics::ReflectanceModel::Calibrated})
        {
            const std::vector<double> channels = optics::diffuse_color(skin, model);
            optics::Spectrum spectrum{};
            std::ranges::copy(channels, spectrum.begin());
            const base::Lab lab = optics::lab_10_degrees(spectrum);
            entry[std::string(optics::name(model))] = {{"lab", list(lab)},
                                                       {"delta_e2000", base::delta_e2000(lab, measured.lab)}};
            const base::Color shortcut(spectrum[21], spectrum[14], spectrum[5]); // 610, 540, 450 nm
            if (model == optics::ReflectanceModel::AddingDoubling)
                entry["three_wavelengths_delta_e2000"] = base::delta_e2000(
                    base::lab_from_linear(shortcut), base::lab_from_linear(optics::linear_rgb(spectrum)));
        }
        presets.push_back(std::move(entry));
    }
    return presets;
}

namespace {

ordered_json ladder_json(const std::vector<MeasuredStack>& ladder)
{
    ordered_json stacks = ordered_json::array();
    for (const MeasuredStack& stack : ladder) {
        ordered_json models = ordered_json::array();
        for (const Measured& m : stack.models)
            models.push_back({{"model", optics::name(m.model)},
                              {"rgb", list(m.color)},
                              {"rms_error", m.rms_error},
                              {"delta_e2000", m.delta_e},
                              {"microseconds", 1e6 * m.seconds}});
        stacks.push_back({{"stack", stack.name}, {"models", models}});
    }
    return stacks;
}

void print_ladder(const std::vector<MeasuredStack>& ladder, std::ostream& out)
{
    for (const MeasuredStack& stack : ladder) {
        fmt::print(out, "{}\n  {:17} {:>7} {:>7} {:>7}  {:>9} {:>7} {:>12}\n", stack.name, "model", "R", "G",
                   "B", "rms error", "dE2000", "us/channel");
        for (const Measured& m : stack.models)
            fmt::print(out, "  {:17} {:7.3f} {:7.3f} {:7.3f}  {:9.4f} {:7.2f} {:12.2f}\n",
                       optics::name(m.model), m.color[0], m.color[1], m.color[2], m.rms_error, m.delta_e,
                       1e6 * m.seconds);
    }
}

void print_presets(const ordered_json& presets, std::ostream& out)
{
    fmt::print(out, "{:8} {:20} {:>16} {:>16} {:>7} {:>11} {:>18}\n", "preset", "measured at", "L* a* b*",
               "adding-doubling", "dE2000", "calibrated", "three wavelengths");
    const auto lab = [](const ordered_json& list) {
        return fmt::format("{:.1f} {:.1f} {:.1f}", list[0].get<double>(), list[1].get<double>(),
                           list[2].get<double>());
    };
    for (const ordered_json& p : presets)
        fmt::print(out, "{:8} {:20} {:>16} {:>16} {:7.2f} {:11.2f} {:18.2f}\n",
                   p["preset"].get<std::string>(), p["site"].get<std::string>(), lab(p["measured_lab"]),
                   lab(p["adding-doubling"]["lab"]), p["adding-doubling"]["delta_e2000"].get<double>(),
                   p["calibrated"]["delta_e2000"].get<double>(),
                   p["three_wavelengths_delta_e2000"].get<double>());
}

void print_table_sizes(const ordered_json& sizes, std::ostream& out)
{
    for (const ordered_json& entry : sizes) {
        const int size = entry["size"].get<int>();
        for (const auto& [tissue, error] : entry.items())
            if (tissue != "size")
                fmt::print(out, "table {0} x {0}, {1}: interpolation rms {2:.5f}, worst {3:.5f}{4}\n", size,
                           tissue, error["rms"].get<double>(), error["worst"].get<double>(),
                           error.contains("rms_to_walk") ? fmt::format("; against the photon walk rms {:.4f}",
                                                                       error["rms_to_walk"].get<double>())
                                                         : "");
    }
}

/// Mean cost per channel and rms error over all stacks of each model except the reference.
struct ModelCost
{
    std::string name;
    double microseconds = 0, rms_error = 0;
};

std::vector<ModelCost> model_costs(const std::vector<MeasuredStack>& ladder)
{
    std::vector<ModelCost> costs;
    for (std::size_t r = 0; r + 1 < optics::all_reflectance_models().size(); ++r) {
        double squares = 0, cost = 0;
        for (const MeasuredStack& stack : ladder) {
            squares += stack.models[r].rms_error * stack.models[r].rms_error;
            cost += 1e6 * stack.models[r].seconds;
        }
        const auto count = static_cast<double>(ladder.size());
        costs.push_back({std::string(optics::name(optics::all_reflectance_models()[r])), cost / count,
                         std::max(1e-6, std::sqrt(squares / count))});
    }
    return costs;
}

base::Chart cost_chart(const std::vector<ModelCost>& costs)
{
    base::Series models{.paint = base::series_paint(0), .radius = 5};
    std::vector<double> cost, error;
    for (const ModelCost& model : costs) {
        models.points.emplace_back(model.microseconds, model.rms_error);
        models.names.push_back(model.name);
        cost.push_back(model.microseconds);
        error.push_back(model.rms_error);
    }
    base::Series frontier{.legend = "no other model is cheaper and more accurate",
                          .paint = base::palette::rest,
                          .line_width = 1,
                          .path = base::Path::Staircase};
    for (const std::size_t i : base::non_dominated(cost, error))
        frontier.points.push_back(models.points[i]);
    return {.title = "Models of skin's reflectance",
            .x = {.title = "cost per channel", .unit = "microseconds", .logarithmic = true},
            .y = {.title = "rms error against Monte Carlo", .logarithmic = true},
            .series = {frontier, models}};
}

} // namespace

void compare(const TableOptions& options, std::ostream& out)
{
    optics::healing_tissue_or_file(options.tissue); // reports a wrong name before the long measurement
    base::make_folder(options.out);
    base::Progress progress;
    const std::vector<MeasuredStack> ladder = measure_models(options.reflectance_options, progress);
    progress.clear();
    print_ladder(ladder, out);
    const std::vector<ModelCost> costs = model_costs(ladder);
    for (const ModelCost& model : costs)
        fmt::print(out, "{:17} rms {:.4f} over all stacks at {:.2f} us per channel\n", model.name,
                   model.rms_error, model.microseconds);
    base::write_png(options.out / "compare.png", base::chart_picture(cost_chart(costs), {840, 480}));
    ordered_json json{{"photons", options.reflectance_options.photons},
                      {"stacks", ladder_json(ladder)},
                      {"presets", measure_presets()}};
    print_presets(json["presets"], out);
    json["table_sizes"] =
        measure_table_sizes(options, std::array<std::uint32_t, 6>{8, 16, 32, 64, 128, 256}, progress);
    progress.clear();
    print_table_sizes(json["table_sizes"], out);
    json["table_against_walk"] = measure_table_against_walk(options);
    fmt::print(out, "table against the photon walk: {}\n", json["table_against_walk"].dump());
    base::write_json(options.out / "compare.json", json);
}

} // namespace lab
