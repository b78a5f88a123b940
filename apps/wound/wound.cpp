#include "apps/wound/wound.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "apps/wound/wound_page.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/number_option.hpp"
#include "scene/command_line.hpp"
#include "wound/prepare.hpp"

namespace wound_command {
namespace {

struct WoundCommand
{
    std::string photo, mask;
    std::filesystem::path out = "out/wound";
    scene::HintOptions hints;
    double width_mm = 30, spacing = 0;
    std::string model = "face";
};

void show_wound(const WoundCommand& command)
{
    base::make_folder(command.out);
    wound::Photograph photograph{base::read_rgb(command.photo), {}};
    if (!command.mask.empty())
        photograph.mask = base::read_mask(command.mask);
    wound::Preparation preparation;
    preparation.where = command.photo;
    preparation.width_mm = command.width_mm;
    preparation.hints = command.hints.hints(command.mask);
    preparation.control_spacing = 2 * command.spacing; // in patch units; the patch is 2 wide
    const std::vector<wound::PreparedWound> all = wound::prepare_all(photograph, preparation);
    wound::Healing healing;
    healing.model = command.model == "face" ? wound::HealingModel::Face : wound::HealingModel::Contraction;
    for (std::size_t i = 0; i < all.size(); ++i) // sorted by size; files of the largest have no number
    {
        const std::string suffix = i == 0 ? "" : fmt::format("_{}", i + 1);
        base::write_png(command.out / ("wound" + suffix + ".png"),
                        draw_wound_page(photograph, all[i], healing));
        base::write_png(command.out / ("mask" + suffix + ".png"), all[i].photo_mask);
        base::write_json(command.out / ("wound" + suffix + ".json"), wound_to_json(all[i], healing));
        if (!all[i].patch.shows_skin)
            fmt::print(stderr,
                       "note: {}: shows no healthy skin beside {}; the colour of average skin is used\n",
                       command.photo, all.size() == 1 ? "the wound" : fmt::format("wound {}", i + 1));
        fmt::print("wound{0}.png, mask{0}.png, wound{0}.json in {1}: {2} control points\n", suffix,
                   command.out.string(), all[i].control_points.size());
    }
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<WoundCommand>();
    CLI::App* command = program.add_subcommand(
        "wound", "Show how a photograph is processed: mask, control points, warp, depth");
    command->add_option("photo", options->photo, "Photograph of a wound, PNG or JPEG")
        ->required()
        ->type_name("PHOTO");
    command
        ->add_option("--mask", options->mask, "Mask, white in the wound; without it the wound is segmented")
        ->type_name("PICTURE");
    scene::add_hint_options(*command, options->hints);
    command->add_option("--width-mm", options->width_mm, "Longer side of the wound on the skin, mm")
        ->capture_default_str()
        ->check(base::number_from(0.5, 200));
    command
        ->add_option(
            "--spacing", options->spacing,
            "Spacing of the lines that give control points / patch width; 0: use the border's curvature")
        ->capture_default_str()
        ->check(base::number_from(0, 0.5));
    command->add_option("--model", options->model, "How the wound closes")
        ->capture_default_str()
        ->check(CLI::IsMember({"face", "contraction"}));
    command->add_option("--out", options->out, "Folder for wound.png, mask.png and wound.json")
        ->capture_default_str()
        ->type_name("DIR");
    command->footer("Example: cicatrix wound photo.jpg --rect 120,80,300,260 --out wound");
    command->callback([options] { show_wound(*options); });
}

} // namespace wound_command
