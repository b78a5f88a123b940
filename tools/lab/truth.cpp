// `cicatrix-lab truth`: the tables of docs/truth.md.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <optional>

#include "base/file.hpp"
#include "base/number_option.hpp"
#include "head/default_head.hpp"
#include "stage/truth_error.hpp"
#include "tools/lab/commands.hpp"
#include "tools/lab/document_tables.hpp"

namespace lab {
namespace {

struct LightCase
{
    const char* name;
    std::optional<scene::Light> light; // none: the scene's default, key and fill
};

std::vector<LightCase> light_cases()
{
    scene::Light side, behind;
    side.from = {-90, 10};
    behind.from = {-150, 15};
    side.distance_m = behind.distance_m = .9;
    return {{"default", {}}, {"side", side}, {"behind", behind}};
}

/// The default head without its occlusion map, as a file.
std::filesystem::path bare_head(const std::filesystem::path& folder)
{
    head::Model model = head::load_model(head::default_head_path());
    for (head::Material& material : model.materials)
        material.occlusion = cv::Mat1b();
    base::make_folder(folder);
    head::save_model(folder / "bare.glb", model);
    return folder / "bare.glb";
}

std::string cell(const stage::RegionError& error)
{
    return error.pixels == 0 ? ""
                             : fmt::format("{:.2f} / {:.2f} ({:.2f})", error.mean, error.p95, error.noise);
}

class Table
{
  public:
    Table(double noise, std::uint32_t side) : renderer_({}), side_(side) { until_.noise_de = noise; }

    /// Rows for each light, tissue and day.
    std::string rows(const std::filesystem::path& head)
    {
        std::string text;
        for (const LightCase& light : light_cases())
            for (const char* tissue : {"light", "medium", "dark"})
                text += rows(head, light, tissue);
        return text;
    }
    base::Progress& progress() { return progress_; }

  private:
    std::string rows(const std::filesystem::path& head, const LightCase& light, const char* tissue)
    {
        scene::Scene scene;
        scene.head = head;
        scene.tissue = tissue;
        scene.size = {side_, side_};
        scene.days = {0, 5, 12, 40};
        if (light.light)
            scene.lights = {*light.light};
        progress_.expect(scene.days.size());
        const stage::Stage stage(renderer_.device, stage::Stage::prepare(scene));
        std::string text;
        std::vector<std::string> notes;
        for (const scene::Shot& shot :
             scene::shots_of_days(scene.days, scene::chosen_views(stage.loaded(), {}))) {
            const stage::TruthError error =
                stage::measure_truth_error(renderer_, stage, shot, {}, until_, progress_, notes).first;
            text += fmt::format("| {} | {} | {:g} |", light.name, tissue, shot.day);
            for (const cv::Mat1b& region : error.regions)
                text += fmt::format(" {} |", cell(stage::error_in(region, error.errors)));
            text += '\n';
            progress_.step();
        }
        return text;
    }

    stage::Renderer renderer_;
    reference::Until until_;
    const std::uint32_t side_;
    base::Progress progress_;
};

void write_tables(const std::filesystem::path& document, double noise, std::uint32_t side)
{
    const std::string header =
        "| light | tissue | day | skin | wound | ring, scar | shadow edges | thin parts |\n"
        "|---|---|---|---|---|---|---|---|\n";
    Table table(noise, side);
    const std::string with = header + table.rows({}),
                      without = header + table.rows(bare_head(base::cache_folder() / "lab"));
    table.progress().clear();
    replace_tables(document, {{"default head", with}, {"without occlusion", without}});
    fmt::print("tables of {}\n", document.string());
}

} // namespace

void add_truth(CLI::App& program)
{
    struct Options
    {
        std::filesystem::path document;
        double noise = .7;
        std::uint32_t side = 256;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "truth", "Distance from the path-traced reference over lights, tissues and days: docs/truth.md");
    command->add_option("document", options->document, "Where the tables stand: docs/truth.md")
        ->required()
        ->type_name("DOCUMENT.md");
    command->add_option("--noise", options->noise, "Noise of each truth, CIEDE2000")
        ->check(base::number_from(0.01, 100))
        ->capture_default_str();
    command->add_option("--side", options->side, "Width and height of the pictures")
        ->transform(base::whole_number_from(16, 4096))
        ->capture_default_str();
    command->callback([options] { write_tables(options->document, options->noise, options->side); });
}

} // namespace lab
