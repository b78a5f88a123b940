#include "apps/bake.hpp"

#include <cstdio>
#include <cstdlib>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <iostream>

#include "apps/bake_pictures.hpp"
#include "apps/number_option.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "engine/image_io.hpp"
#include "passes/reflectance_table.hpp"
#include "wound/healing.hpp"
#include "wound/input_error.hpp"
#include "wound/shading.hpp"

namespace app {

using namespace wound;
using nlohmann::ordered_json;

TissueDay tissue_on(const HealingTissue& tissue, shared::uint part, double day)
{
    const Healing healing;
    return part == shared::LUT_OPEN ? open_bed(tissue, day, healing_at(healing, day).depth_scale)
                                    : covered_bed(tissue, day, closure_day(healing.curve));
}

namespace {

// Days of the strip: close together at first, up to the last of the table.
std::vector<double> days_until(double last_day)
{
    std::vector<double> days;
    for (const double day : {0, 1, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 60, 90, 180, 365, 1000})
        if (day < last_day)
            days.push_back(day);
    days.push_back(last_day);
    return days;
}

// Figure 6 of the paper: the colour alone. The printed blend of the printed reflectance beside ours, in the
// same wound. The open bed is there until it is closed.
cv::Mat3b strip(const std::string& title, const cv::Mat3f& table, const shared::LutAxes& axes)
{
    const Color wound_color(.30, .035, .03);
    const Color skin_color = passes::sample_table(table, axes, shared::LUT_OPEN, 0, 0);
    constexpr double depth_mm = 1;
    const Healing healing;
    const double closure = closure_day(healing.curve);
    const std::vector<double> days = days_until(axes.last_day);
    ColorRow published{"published", "eq. (4) as printed, Table 1", {}},
        corrected{"corrected", "eq. (4) ending at the skin", {}},
        open{"open bed", fmt::format("its tissue, until day {:.1f}", closure), {}},
        covered{"covered", "new epithelium, then scar", {}};
    for (const double day : days) {
        const HealingState state = healing_at(healing, day);
        const SkinLayers printed = layers_at(restored_skin(table1(), state.depth_scale), depth_mm);
        const Color bed = passes::sample_table(table, axes, shared::LUT_OPEN, depth_mm, day);
        open.colors.push_back(day <= closure ? std::optional(bed) : std::nullopt);
        covered.colors.push_back(passes::sample_table(table, axes, shared::LUT_COVERED, depth_mm, day));
        published.colors.push_back(blend(BlendModel::Published, wound_color,
                                         tissue_color(printed, Rung::Published), skin_color,
                                         state.recovery_ratio));
        corrected.colors.push_back(
            blend(BlendModel::Corrected, wound_color, bed, skin_color, state.recovery_ratio));
    }
    return draw_strip(
        fmt::format("{}: a wound {:g} mm deep, day by day (a gap: the step changes)", title, depth_mm), days,
        {published, corrected, open, covered});
}

} // namespace

std::filesystem::path cache_folder()
{
    const auto variable = [](const char* name) -> std::string {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty())
        return std::filesystem::path(cache) / "cicatrix";
    if (const std::string home = variable("HOME"); !home.empty())
        return std::filesystem::path(home) / ".cache" / "cicatrix";
    return std::filesystem::temp_directory_path() / "cicatrix";
}

cv::Mat3f kept_table(const passes::LutRows& rows, std::uint32_t width, Rung rung, RungOptions options)
{
    Progress progress;
    constexpr std::size_t steps = 100;
    std::size_t done = 0;
    progress.expect(steps);
    options.progress = [&](double share) {
        for (; static_cast<double>(done) < share * steps; ++done)
            progress.step();
        progress.show(fmt::format("reflectance table, {}", name(rung)));
    };
    return passes::cached_reflectance_table(cache_folder(), rows.days, width, rung, options);
}

void bake(const BakeOptions& options, std::ostream& out, std::ostream& notes)
{
    const HealingTissue tissue = healing_tissue_or_file(options.tissue);
    const passes::LutRows rows = passes::lut_rows(tissue, Healing{}, options.height, options.last_day);
    make_folder(options.out);
    if (options.rung == Rung::Published)
        if (const auto note = domain_note(layers_of(tissue)))
            fmt::print(notes, "note: {}\n", *note);
    const std::string title =
        fmt::format("{}, {}", std::filesystem::path(options.tissue).filename().string(), name(options.rung));
    const cv::Mat3f table = kept_table(rows, options.width, options.rung, options.rung_options);
    const auto height = static_cast<int>(options.height);
    const cv::Mat3f open = table.rowRange(0, height), covered = table.rowRange(height, 2 * height);
    engine::write_exr(options.out / "open_bed.exr", open);
    engine::write_exr(options.out / "covered.exr", covered);
    engine::write_png(options.out / "tables.png",
                      draw_tables(title, {{"open bed", open}, {"covered", covered}}, rows.axes));
    engine::write_png(options.out / "color_over_days.png", strip(title, table, rows.axes));
    fmt::print(out, "{}: open_bed.exr, covered.exr ({} x {}, {}), tables.png, color_over_days.png\n",
               options.out.string(), options.width, options.height, name(options.rung));
}

namespace {

// "64x32"
void read_size(const std::string& text, BakeOptions& options)
{
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || width < 2 || height < 2 ||
        width > 1024 || height > 1024)
        throw cicatrix::InputError("--size " + text, "is not a size",
                                   "give WIDTHxHEIGHT, each from 2 to 1024");
    options.width = width;
    options.height = height;
}

} // namespace

void add_bake_command(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "bake", "Write the reflectance table and the colour over days; compare the models");
    auto options = std::make_shared<BakeOptions>();
    auto comparing = std::make_shared<bool>(false), calibrating = std::make_shared<bool>(false);
    command
        ->add_option("--tissue", options->tissue,
                     fmt::format("Tissue file, or one of {}", fmt::join(healing_tissue_names(), ", ")))
        ->capture_default_str()
        ->type_name("TISSUE.json");
    add_model_option(*command, options->rung);
    command->add_option_function<std::string>(
        "--size", [options](const std::string& text) { read_size(text, *options); },
        "Texels over depth x days (default 64x64)");
    command->add_option("--last-day", options->last_day, "Last day of the table")
        ->check(number_from(1, 3650))
        ->capture_default_str();
    command->add_option("--out", options->out, "Folder to write")->capture_default_str();
    command->add_option("--photons", options->rung_options.photons, "Photons per colour of the reference")
        ->transform(whole_number_from(100, 1e10))
        ->capture_default_str();
    command->add_flag("--compare", *comparing, "Measure every model against the photon walk");
    command->add_flag("--calibrate", *calibrating, "Fit the model 'calibrated' to the photon walk")
        ->excludes("--compare");
    command->footer("Example: cicatrix bake --tissue dark --out out/bake");
    command->callback([options, comparing, calibrating] {
        if (*calibrating)
            calibrate(*options, std::cout);
        else if (*comparing)
            compare(*options, std::cout);
        else
            bake(*options, std::cout, std::cerr);
    });
}

} // namespace app
