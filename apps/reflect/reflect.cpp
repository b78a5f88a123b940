#include "apps/reflect/reflect.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/input_error.hpp"
#include "base/number_option.hpp"
#include "scene/command_line.hpp"
#include "wound/optics/chromophores.hpp"
#include "wound/optics/shading.hpp"
#include "wound/optics/tissue_choice.hpp"

namespace reflect_command {

using nlohmann::ordered_json;
namespace {

// A number for one wavelength, a list for several.
template <typename Get>
ordered_json per_channel(const std::vector<optics::Response>& responses, Get get)
{
    if (responses.size() == 1)
        return get(responses[0]);
    ordered_json values = ordered_json::array();
    for (const optics::Response& response : responses)
        values.push_back(get(response));
    return values;
}

// JSON has no infinity; tissue files write "inf".
ordered_json thickness(double mm)
{
    return std::isfinite(mm) ? ordered_json(mm) : ordered_json("inf");
}

ordered_json domain_report(const optics::SkinLayers& tissue)
{
    ordered_json list = ordered_json::array();
    for (const optics::OutsideDomain& outside : optics::outside_domain(tissue))
        list.push_back({{"layer", tissue.layers[outside.layer].name},
                        {"channel", outside.channel},
                        {"thickness_mm", thickness(outside.thickness_mm)},
                        {"limit_mm", outside.limit_mm}});
    return list;
}

} // namespace

void reflect(const ReflectOptions& options, std::ostream& out, std::ostream& notes)
{
    const optics::SkinLayers tissue = optics::tissue_or_file(options.tissue);
    std::vector<optics::Response> responses;
    for (std::size_t c = 0; c < tissue.channels(); ++c) {
        optics::ReflectanceOptions channel = options.reflectance_options;
        if (channel.progress)
            channel.progress = [&, c](double share) {
                options.reflectance_options.progress((static_cast<double>(c) + share) /
                                                     static_cast<double>(tissue.channels()));
            };
        responses.push_back(optics::reflectance(tissue.channel(c), options.model, channel));
    }
    ordered_json json;
    json["model"] = optics::name(options.model);
    json["incidence"] =
        options.reflectance_options.incidence == optics::Incidence::Normal ? "normal" : "diffuse";
    json["r"] = per_channel(responses, [](const optics::Response& x) { return x.r; });
    json["r_without_specular"] =
        per_channel(responses, [](const optics::Response& x) { return x.r_without_specular; });
    json["t"] = per_channel(responses, [](const optics::Response& x) { return x.t; });
    json["layers"] = ordered_json::array(); // in the order of "absorbed"
    for (const optics::Layer& layer : tissue.layers)
        json["layers"].push_back(layer.name);
    json["absorbed"] = ordered_json::array();
    for (std::size_t l = 0; l < tissue.layers.size(); ++l)
        json["absorbed"].push_back(
            per_channel(responses, [&](const optics::Response& x) { return x.absorbed[l]; }));
    json["standard_error"] =
        per_channel(responses, [](const optics::Response& x) { return x.standard_error; });
    std::vector<double> channels;
    for (const optics::Response& response : responses)
        channels.push_back(response.r_without_specular);
    if (channels.size() == optics::wavelength_count) {
        const base::Color color = optics::linear_rgb(channels);
        json["linear_rgb"] = {color[0], color[1], color[2]};
        const base::Lab lab = base::lab_from_linear(color);
        json["cielab"] = {lab.l, lab.a, lab.b}; // D65, 2 degrees
    }
    if (optics::is_the_papers(options.model))
        json[options.model == optics::ReflectanceModel::Published ? "limited" : "outside_domain"] =
            domain_report(tissue);
    if (const auto note = optics::domain_note(tissue, options.model))
        fmt::print(notes, "note: {}\n", *note);
    if (options.model == optics::ReflectanceModel::Printed &&
        std::ranges::any_of(tissue.layers, [](const optics::Layer& l) { return std::isinf(l.thickness_mm); }))
        fmt::print(
            notes,
            "note: eqs. (2) and (3) as printed have no value for a layer of infinite thickness (null in "
            "the output); give its thickness or choose another --model\n");
    out << json.dump(2) << '\n';
}

namespace {

void add_light_options(CLI::App& command, ReflectOptions& options)
{
    command
        .add_option_function<std::string>(
            "--incidence",
            [&options](const std::string& text) {
                options.reflectance_options.incidence =
                    text == "normal" ? optics::Incidence::Normal : optics::Incidence::Diffuse;
            },
            "Incident light: normal or diffuse (default)")
        ->check(CLI::IsMember({"normal", "diffuse"}));
    command
        .add_option_function<std::string>(
            "--fresnel",
            [&options](const std::string& text) {
                options.reflectance_options.fresnel =
                    text == "exact" ? optics::DiffuseFresnel::Exact : optics::DiffuseFresnel::Polynomial;
            },
            "Diffuse Fresnel reflectance of the analytic models: exact (default) or polynomial")
        ->check(CLI::IsMember({"exact", "polynomial"}));
    optics::ReflectanceOptions& model = options.reflectance_options;
    command.add_option("--photons", model.photons, "Photons of monte-carlo, at least 2")
        ->transform(base::whole_number_from(2, 1e10))
        ->capture_default_str();
    command.add_option("--seed", model.seed, "Seed of monte-carlo")
        ->transform(base::whole_number_from(0, 4294967295))
        ->capture_default_str();
    command.add_option("--threads", model.threads, "Threads of monte-carlo; 0: one per core")
        ->transform(base::whole_number_from(0, 1024))
        ->capture_default_str();
    command.add_option("--angles", model.angles, "Angles per panel of adding-doubling")
        ->transform(base::whole_number_from(2, 64))
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--quadrature",
            [&options](const std::string& text) {
                options.reflectance_options.quadrature =
                    text == "smooth" ? optics::Quadrature::Smooth : optics::Quadrature::Slab;
            },
            "Integration variable of adding-doubling: cosine in the optically thinnest medium that carries "
            "the light (smooth, default) or in the densest, as in Prahl's tables (slab)")
        ->check(CLI::IsMember({"smooth", "slab"}));
}

} // namespace

void add(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("reflect", "Compute what layered tissue reflects, transmits and absorbs, as JSON");
    auto options = std::make_shared<ReflectOptions>();
    command
        ->add_option("tissue", options->tissue,
                     fmt::format("Tissue file, or one of {}", fmt::join(optics::tissue_preset_names(), ", ")))
        ->type_name("TISSUE.json");
    scene::add_model_option(*command, options->model);
    add_light_options(*command, *options);
    command->footer(
        "Example: cicatrix reflect tissue.json --model adding-doubling\ntissue.json: {\"unit\": "
        "\"1/mm\", \"layers\": [{\"name\": \"dermis\", \"sigma_a\": [0.1, 0.3, 0.4], "
        "\"sigma_s_reduced\": [1.5, 1.9, 2.2], \"n\": 1.4, \"thickness_mm\": \"inf\"}]}\ndocs/scene.md "
        "lists all fields of a tissue file, and layers "
        "given by their content (blood, melanosomes, ...)");
    command->callback([options] {
        if (isatty(STDERR_FILENO))
            options->reflectance_options.progress = [](double share) {
                fmt::print(stderr, "\r{:3.0f} %{}", 100 * share, share >= 1 ? "\r     \r" : "");
            };
        if (options->tissue.empty())
            throw base::InputError("reflect", "no tissue given", "name a tissue file or a preset");
        reflect(*options, std::cout, std::cerr);
    });
}

} // namespace reflect_command
