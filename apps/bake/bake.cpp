#include "apps/bake/bake.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <iostream>

#include "apps/bake/pictures.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/number_option.hpp"
#include "base/progress.hpp"
#include "scene/command_line.hpp"
#include "wound/healing/healing.hpp"
#include "wound/optics/shading.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/reflectance_table.hpp"

namespace bake_command {

using nlohmann::ordered_json;

namespace {

// Days of the strip, up to `last_day`; the steps grow from 1 day to several months.
std::vector<double> days_until(double last_day)
{
    std::vector<double> days;
    for (const double day : {0, 1, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 60, 90, 180, 365, 1000})
        if (day < last_day)
            days.push_back(day);
    days.push_back(last_day);
    return days;
}

// Figure 6 of the paper, colour only: rows of the published model, the corrected model, the open bed (until
// the closure day) and the covered wound, for a wound of one depth.
cv::Mat3b strip(const std::string& title, const cv::Mat3f& table, const shared::LutAxes& axes)
{
    const base::Color wound_color(.30, .035, .03);
    const base::Color skin_color = wound::sample_table(table, axes, shared::LUT_OPEN, 0, 0);
    constexpr double depth_mm = 1;
    const wound::Healing healing;
    const double closure = wound::closure_day(healing.curve);
    const std::vector<double> days = days_until(axes.last_day);
    ColorRow published{"published", "eq. (4) as printed, Table 1", {}},
        corrected{"corrected", "eq. (4) ending at the skin", {}},
        open{"open bed", fmt::format("tissue until day {:.1f}", closure), {}},
        covered{"covered", "new epithelium, then scar", {}};
    for (const double day : days) {
        const wound::HealingState state = wound::healing_at(healing, day);
        const optics::SkinLayers printed =
            optics::layers_at(optics::restored_skin(optics::table1(), state.depth_scale), depth_mm, true);
        const base::Color bed = wound::sample_table(table, axes, shared::LUT_OPEN, depth_mm, day);
        open.colors.push_back(day <= closure ? std::optional(bed) : std::nullopt);
        covered.colors.push_back(wound::sample_table(table, axes, shared::LUT_COVERED, depth_mm, day));
        published.colors.push_back(
            optics::blend(optics::BlendModel::Published, wound_color,
                          optics::tissue_color(printed, optics::ReflectanceModel::Published), skin_color,
                          state.recovery_ratio));
        corrected.colors.push_back(
            optics::blend(optics::BlendModel::Corrected, wound_color, bed, skin_color, state.recovery_ratio));
    }
    return draw_strip(
        fmt::format("{}: a wound {:g} mm deep, day by day (gaps: the step changes)", title, depth_mm), days,
        {published, corrected, open, covered});
}

} // namespace

void bake(const BakeOptions& options, std::ostream& out, std::ostream& notes)
{
    const optics::HealingTissue tissue = optics::healing_tissue_or_file(options.tissue);
    const wound::LutRows rows = wound::lut_rows(tissue, wound::Healing{}, options.height, options.last_day);
    base::make_folder(options.out);
    if (const auto note = optics::domain_note(optics::layers_of(tissue), options.model))
        fmt::print(notes, "note: {}\n", *note);
    const std::string title = fmt::format("{}, {}", std::filesystem::path(options.tissue).filename().string(),
                                          optics::name(options.model));
    const cv::Mat3f table = kept_table(rows, options.width, options.model, options.reflectance_options);
    const auto height = static_cast<int>(options.height);
    const cv::Mat3f open = table.rowRange(0, height), covered = table.rowRange(height, 2 * height);
    base::write_exr(options.out / "open_bed.exr", open);
    base::write_exr(options.out / "covered.exr", covered);
    base::write_png(options.out / "tables.png",
                    draw_tables(title, {{"open bed", open}, {"covered", covered}}, rows.axes));
    base::write_png(options.out / "color_over_days.png", strip(title, table, rows.axes));
    fmt::print(out, "{}: open_bed.exr, covered.exr ({} x {}, {}), tables.png, color_over_days.png\n",
               options.out.string(), options.width, options.height, optics::name(options.model));
}

namespace {

// Parses "WIDTHxHEIGHT", for example "64x32".
void read_size(const std::string& text, BakeOptions& options)
{
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || width < 2 || height < 2 ||
        width > 1024 || height > 1024)
        throw base::InputError("--size " + text, "is not a size", "give WIDTHxHEIGHT, each from 2 to 1024");
    options.width = width;
    options.height = height;
}

} // namespace

void add(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("bake", "Write the reflectance table and the colour over days");
    auto options = std::make_shared<BakeOptions>();
    command
        ->add_option(
            "--tissue", options->tissue,
            fmt::format("Tissue file, or one of {}", fmt::join(optics::healing_tissue_names(), ", ")))
        ->capture_default_str()
        ->type_name("TISSUE.json");
    scene::add_model_option(*command, options->model);
    command->add_option_function<std::string>(
        "--size", [options](const std::string& text) { read_size(text, *options); },
        "Texels of the table, depth x days (default 64x64)");
    command->add_option("--last-day", options->last_day, "Last day of the table")
        ->check(base::number_from(1, 3650))
        ->capture_default_str();
    command->add_option("--out", options->out, "Folder to write")->capture_default_str();
    command
        ->add_option("--photons", options->reflectance_options.photons, "Photons per colour of monte-carlo")
        ->transform(base::whole_number_from(100, 1e10))
        ->capture_default_str();
    command->footer("Example: cicatrix bake --tissue dark --out out/bake");
    command->callback([options] { bake(*options, std::cout, std::cerr); });
}

} // namespace bake_command
