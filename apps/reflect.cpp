#include "apps/reflect.hpp"

#include <cmath>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "apps/number_option.hpp"
#include "apps/tissue_choice.hpp"
#include "wound/chromophores.hpp"
#include "wound/input_error.hpp"
#include "wound/shading.hpp"

namespace app {

using nlohmann::ordered_json;
using namespace wound;

namespace {

// One number for one wavelength, else a list.
template <typename Get>
ordered_json per_channel(const std::vector<Response>& responses, Get get)
{
    if (responses.size() == 1)
        return get(responses[0]);
    ordered_json values = ordered_json::array();
    for (const Response& response : responses)
        values.push_back(get(response));
    return values;
}

// JSON has no infinity; tissue files write "inf".
ordered_json thickness(double mm)
{
    return std::isfinite(mm) ? ordered_json(mm) : ordered_json("inf");
}

ordered_json domain_report(const SkinLayers& tissue)
{
    ordered_json list = ordered_json::array();
    for (const OutsideDomain& case_ : outside_domain(tissue))
        list.push_back({{"layer", tissue.layers[case_.layer].name},
                        {"channel", case_.channel},
                        {"thickness_mm", thickness(case_.thickness_mm)},
                        {"limit_mm", case_.limit_mm}});
    return list;
}

} // namespace

void reflect(const ReflectOptions& options, std::ostream& out, std::ostream& notes)
{
    const SkinLayers tissue = tissue_or_file(options.tissue);
    std::vector<Response> responses;
    for (std::size_t c = 0; c < tissue.channels(); ++c) {
        RungOptions channel = options.rung_options;
        if (channel.progress)
            channel.progress = [&, c](double share) {
                options.rung_options.progress((static_cast<double>(c) + share) /
                                              static_cast<double>(tissue.channels()));
            };
        responses.push_back(reflectance(tissue.channel(c), options.rung, channel));
    }
    ordered_json json;
    json["model"] = name(options.rung);
    json["incidence"] = options.rung_options.incidence == Incidence::Normal ? "normal" : "diffuse";
    json["r"] = per_channel(responses, [](const Response& x) { return x.r; });
    json["r_without_specular"] =
        per_channel(responses, [](const Response& x) { return x.r_without_specular; });
    json["t"] = per_channel(responses, [](const Response& x) { return x.t; });
    json["layers"] = ordered_json::array(); // in the order of "absorbed"
    for (const Layer& layer : tissue.layers)
        json["layers"].push_back(layer.name);
    json["absorbed"] = ordered_json::array();
    for (std::size_t l = 0; l < tissue.layers.size(); ++l)
        json["absorbed"].push_back(per_channel(responses, [&](const Response& x) { return x.absorbed[l]; }));
    json["standard_error"] = per_channel(responses, [](const Response& x) { return x.standard_error; });
    std::vector<double> channels;
    for (const Response& response : responses)
        channels.push_back(response.r_without_specular);
    if (channels.size() == wavelength_count) {
        const Color color = linear_rgb(channels);
        json["linear_rgb"] = {color[0], color[1], color[2]};
        const Lab lab = lab_from_linear(color);
        json["cielab"] = {lab.l, lab.a, lab.b}; // D65, 2 degrees
    }
    if (options.rung == Rung::Published) {
        json["outside_domain"] = domain_report(tissue);
        if (const auto note = domain_note(tissue))
            fmt::print(notes, "note: {}\n", *note);
        if (std::ranges::any_of(tissue.layers, [](const Layer& l) { return std::isinf(l.thickness_mm); }))
            fmt::print(notes, "note: eqs. (2) and (3) have no value for a layer of infinite thickness: null "
                              "stands for it; give its thickness or take another --model\n");
    }
    out << json.dump(2) << '\n';
}

namespace {

void add_light_options(CLI::App& command, ReflectOptions& options)
{
    command
        .add_option_function<std::string>(
            "--incidence",
            [&options](const std::string& text) {
                options.rung_options.incidence = text == "normal" ? Incidence::Normal : Incidence::Diffuse;
            },
            "Light that arrives: normal or diffuse (default)")
        ->check(CLI::IsMember({"normal", "diffuse"}));
    command
        .add_option_function<std::string>(
            "--fresnel",
            [&options](const std::string& text) {
                options.rung_options.fresnel =
                    text == "exact" ? DiffuseFresnel::Exact : DiffuseFresnel::Polynomial;
            },
            "Diffuse Fresnel reflectance of the analytic models: exact (default) or polynomial")
        ->check(CLI::IsMember({"exact", "polynomial"}));
    RungOptions& rung = options.rung_options;
    command.add_option("--photons", rung.photons, "Photons of monte-carlo; a standard error takes two")
        ->transform(whole_number_from(2, 1e10))
        ->capture_default_str();
    command.add_option("--seed", rung.seed, "Seed of monte-carlo")
        ->transform(whole_number_from(0, 4294967295))
        ->capture_default_str();
    command.add_option("--threads", rung.threads, "Threads of monte-carlo; 0: one per core")
        ->transform(whole_number_from(0, 1024))
        ->capture_default_str();
    command.add_option("--angles", rung.angles, "Angles per panel of adding-doubling")
        ->transform(whole_number_from(2, 64))
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--quadrature",
            [&options](const std::string& text) {
                options.rung_options.quadrature = text == "smooth" ? Quadrature::Smooth : Quadrature::Slab;
            },
            "Variable of those angles: the cosine in the thinnest medium that carries the light (smooth, "
            "default) or in the densest, as Prahl's tables have it (slab)")
        ->check(CLI::IsMember({"smooth", "slab"}));
}

} // namespace

void add_reflect_command(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("reflect", "What layered tissue reflects, transmits and absorbs, as JSON");
    auto options = std::make_shared<ReflectOptions>();
    auto check = std::make_shared<bool>(false), ward = std::make_shared<bool>(false);
    command
        ->add_option("tissue", options->tissue,
                     fmt::format("Tissue file, or one of {}", fmt::join(tissue_preset_names(), ", ")))
        ->type_name("TISSUE.json");
    add_model_option(*command, options->rung);
    add_light_options(*command, *options);
    command->add_flag("--check", *check,
                      "Compare monte-carlo and adding-doubling with published values and each other");
    command->add_flag(
        "--ward", *ward,
        "Print the share of light that the three forms of Ward's gloss return, by slope and incidence");
    command->footer("Example: cicatrix reflect tissue.json --model adding-doubling\ntissue.json: {\"unit\": "
                    "\"1/mm\", \"layers\": [{\"name\": \"dermis\", \"sigma_a\": [0.1, 0.3, 0.4], "
                    "\"sigma_s_reduced\": [1.5, 1.9, 2.2], \"n\": 1.4, \"thickness_mm\": \"inf\"}]}\nAll "
                    "fields of a tissue file, and layers by what they "
                    "contain (blood, melanosomes, ...): docs/scene.md");
    command->callback([options, check, ward] {
        if (*ward) {
            print_ward_albedo_table(std::cout);
            return;
        }
        if (isatty(STDERR_FILENO))
            options->rung_options.progress = [](double share) {
                fmt::print(stderr, "\r{:3.0f} %{}", 100 * share, share >= 1 ? "\r     \r" : "");
            };
        if (*check) {
            options->rung_options.progress = {};
            if (!check_reflectance(options->rung_options, std::cout))
                throw CLI::RuntimeError(1);
            return;
        }
        if (options->tissue.empty())
            throw cicatrix::InputError("reflect", "no tissue given", "name a tissue file, or use --check");
        reflect(*options, std::cout, std::cerr);
    });
}

} // namespace app
