#include "apps/figure/figure.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/figure/figures.hpp"
#include "apps/figure/workbench.hpp"
#include "base/file.hpp"
#include "base/html.hpp"
#include "base/input_error.hpp"
#include "base/number_option.hpp"
#include "base/palette.hpp"

namespace figure_command {
namespace {

constexpr const char* page_name = "figures.html";
constexpr const char* style =
    R"(body { background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; max-width: 1000px;
  margin: 2em auto; padding: 0 1em; }
h2 { margin-top: 2em; border-bottom: 1px solid var(--grid); } img { max-width: 100%; } .faint { color: var(--faint); }
)";

std::vector<std::string> names_of_all()
{
    std::vector<std::string> names;
    for (const Figure& figure : all_figures())
        names.emplace_back(figure.name);
    return names;
}

/// The chosen figures in the paper's order; all if none is chosen. Throws base::InputError.
std::vector<Figure> chosen_figures(const std::vector<std::string>& names)
{
    const std::vector<std::string> known = names_of_all();
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw base::InputError("figure " + name, "the paper has no such figure",
                                   fmt::format("choose from {}", fmt::join(known, ", ")));
    std::vector<Figure> chosen;
    for (const Figure& figure : all_figures())
        if (names.empty() || std::ranges::find(names, figure.name) != names.end())
            chosen.push_back(figure);
    return chosen;
}

/// A figure's section of the page. A drawing that exists as SVG too is shown as SVG.
std::string section(const Figure& figure, const Workbench::Output& output)
{
    std::string text = fmt::format(
        "<h2>{}: {}</h2>\n<p><code>cicatrix figure {}</code></p>\n<p>The paper: {}</p>\n<p>Here: {}</p>\n",
        figure.heading(), base::escaped(figure.title), figure.name, base::escaped(figure.paper),
        base::escaped(figure.ours));
    for (const std::filesystem::path file : output.files) {
        const std::string svg = file.stem().string() + ".svg";
        const bool drawn =
            file.extension() == ".png" && std::ranges::find(output.files, svg) != output.files.end();
        if (file.extension() != ".json" && !drawn)
            text += fmt::format("<p><img src=\"{}\" alt=\"{}\"></p>\n", file.string(), figure.heading());
    }
    for (const std::string& line : output.lines)
        text += fmt::format("<p class=\"faint\">{}</p>\n", base::escaped(line));
    return text;
}

void make_figures(const FigureOptions& options)
{
    const std::vector<Figure> figures = chosen_figures(options.names);
    base::make_folder(options.out);
    base::Progress progress;
    progress.expect(figures.size());
    Workbench bench(options, progress);
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>The figures of Choi &amp; "
        "Chin "
        "2014</title>\n<style>{}{}</style></head><body>\n<h1>The figures of Choi &amp; Chin 2014, made by "
        "Cicatrix</h1>\n",
        base::css_variables(), style);
    for (const Figure& figure : figures) {
        progress.show(figure.heading());
        figure.draw(bench);
        progress.step();
        const Workbench::Output output = bench.take_output();
        page += section(figure, output);
        progress.clear();
        fmt::print("{}: {}: {}\n", figure.heading(), figure.title, fmt::join(output.files, ", "));
        for (const std::string& line : output.lines)
            fmt::print("  {}\n", line);
    }
    if (bench.has_renderer())
        stage::fail_on_validation(bench.renderer().device);
    const bool all = figures.size() == all_figures().size();
    if (all)
        base::write_text(options.out / page_name, page + "</body></html>\n");
    fmt::print("{}in {}\n", all ? fmt::format("all on {} ", page_name) : "", options.out.string());
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<FigureOptions>();
    CLI::App* command =
        program.add_subcommand("figure", "Draw the figures of the paper and its frame rates, ours of each");
    CLI::Option* names = command->add_option("figures", options->names,
                                             fmt::format("Figures to draw: {}; without any: all, and a page "
                                                         "that shows them, {}",
                                                         fmt::join(names_of_all(), ", "), page_name));
    names->type_name("N");
    command->add_option("--out", options->out, "Folder for the figures")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_option("--head", options->head, "Head to use instead of the default one")
        ->type_name("FILE.glb");
    command
        ->add_option("--wound", options->wound,
                     "Photograph to use for the wound of Figures 1, 4, 5, 6, 8 (a) and frame-rate")
        ->type_name("PHOTO");
    command
        ->add_option(
            "--mask", options->mask,
            "Mask of that photograph, white in the wound; without a mask the photograph is segmented")
        ->type_name("PICTURE");
    command
        ->add_option("--cell", options->cell,
                     "Width of each picture in Figures 1, 4, 6, 7, 8 and 9, in pixels")
        ->transform(base::whole_number_from(60, 2000))
        ->capture_default_str()
        ->type_name("PX");
    command
        ->add_option("--size", options->size,
                     "Size of the frames that frame-rate measures (default 1280x720)")
        ->type_name("WxH");
    command->add_option("--frames", options->frames, "Measured frames of each case of frame-rate")
        ->transform(base::whole_number_from(5, 10000))
        ->capture_default_str()
        ->type_name("N");
    command
        ->add_option("--device", options->device,
                     "Vulkan device by index or part of its name; also CICATRIX_DEVICE")
        ->type_name("NAME|INDEX");
    command->add_flag("--validation", options->validation,
                      "Run under the Vulkan validation layers; any message is a failure");
    std::string list;
    for (const Figure& figure : all_figures())
        list += fmt::format("  {:<11}{}\n", figure.name, figure.title);
    command->footer(
        "The figures:\n" + list +
        "Each is drawn by the paper's equations as published; where our default differs it stands "
        "beside, labelled (docs/figures.md). Figures 2 and 3 need neither a head nor a device.\n"
        "Examples:\n"
        "  cicatrix figure 4 --out out/figures\n"
        "  cicatrix figure --out out/figures\n"
        "  cicatrix figure 1 4 6 --wound photo.jpg --mask mask.png\n"
        "  cicatrix figure frame-rate --frames 100");
    command->callback([options] { make_figures(*options); });
}

} // namespace figure_command
