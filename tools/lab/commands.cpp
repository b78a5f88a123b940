#include "tools/lab/commands.hpp"
#include "tools/lab/document_tables.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/file.hpp"
#include "base/number_option.hpp"
#include "scene/command_line.hpp"
#include "scene/field_table.hpp"
#include "tools/lab/reflectance.hpp"
#include "wound/optics/skin_presets.hpp"
#include "wound/optics/specular.hpp"

namespace lab {
namespace {

std::shared_ptr<TableOptions> add_table_options(CLI::App& command)
{
    auto options = std::make_shared<TableOptions>();
    command
        .add_option("--tissue", options->tissue,
                    fmt::format("Tissue file, or one of {}", fmt::join(optics::healing_tissue_names(), ", ")))
        ->capture_default_str()
        ->type_name("TISSUE.json");
    scene::add_model_option(command, options->model);
    command.add_option("--size", options->size, "Texels per side of the table")
        ->transform(base::whole_number_from(2, 1024))
        ->capture_default_str();
    command.add_option("--last-day", options->last_day, "Last day of the table")
        ->check(base::number_from(1, 3650))
        ->capture_default_str();
    command.add_option("--out", options->out, "Output folder")->capture_default_str();
    command
        .add_option("--photons", options->reflectance_options.photons, "Photons per colour of the reference")
        ->transform(base::whole_number_from(100, 1e10))
        ->capture_default_str();
    return options;
}

void print_ward_albedo_table()
{
    fmt::print("| slope | incidence | published | Ward-Duer | bounded |\n|---|---|---|---|---|\n");
    for (double alpha : {0.1, 0.4, 1.0})
        for (double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9}) {
            const double theta = degrees * std::numbers::pi / 180;
            const cv::Vec3d incident(std::sin(theta), 0, std::cos(theta));
            fmt::print("| {} | {} deg |", alpha, degrees);
            for (optics::WardModel model :
                 {optics::WardModel::Published, optics::WardModel::Duer, optics::WardModel::Bounded})
                fmt::print(" {:.3f} |", optics::ward_albedo(model, alpha, alpha, incident));
            fmt::print("\n");
        }
}

} // namespace

void add_compare_models(CLI::App& program)
{
    CLI::App* command =
        program.add_subcommand("compare-models", "Measure every reflectance model against the photon walk");
    const auto options = add_table_options(*command);
    command->callback([options] { compare(*options, std::cout); });
}

void add_calibrate(CLI::App& program)
{
    CLI::App* command = program.add_subcommand("calibrate", "Fit the model 'calibrated' to the photon walk");
    const auto options = add_table_options(*command);
    command->callback([options] { calibrate(*options, std::cout); });
}

void add_check_reflectance(CLI::App& program)
{
    CLI::App* command = program.add_subcommand(
        "check-reflectance", "Compare monte-carlo and adding-doubling with published values and each other");
    auto options = std::make_shared<optics::ReflectanceOptions>();
    command->add_option("--photons", options->photons, "Photons of monte-carlo")
        ->transform(base::whole_number_from(2, 1e10))
        ->capture_default_str();
    command->add_option("--angles", options->angles, "Angles per panel of adding-doubling")
        ->transform(base::whole_number_from(2, 64))
        ->capture_default_str();
    command->callback([options] {
        if (!check_reflectance(*options, std::cout))
            throw CLI::RuntimeError(1);
    });
}

void add_ward_albedo(CLI::App& program)
{
    CLI::App* command = program.add_subcommand(
        "ward-albedo", "Print the albedo of the three forms of Ward's lobe, by slope and incidence");
    command->callback([] { print_ward_albedo_table(); });
}

void add_scene_fields(CLI::App& program)
{
    CLI::App* command = program.add_subcommand(
        "scene-fields", "Print the tables of a scene's fields, or insert them into docs/scene.md");
    auto document = std::make_shared<std::string>();
    command->add_option("document", *document, "Replace the tables in this file")->type_name("FILE.md");
    command->callback([document] {
        if (document->empty()) {
            for (const auto& [name, table] : scene::field_documentation())
                fmt::print("## {}\n\n{}\n", name, table);
            return;
        }
        replace_tables(*document, scene::field_documentation());
    });
}

} // namespace lab
