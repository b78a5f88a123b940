#include "apps/wound_commands.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/output.hpp"
#include "apps/scene_options.hpp"
#include "apps/wound_page.hpp"
#include "engine/image_io.hpp"
#include "wound/fit.hpp"
#include "wound/prepare.hpp"

namespace app {
namespace {

// ---- fit
// --------------------------------------------------------------------------------------------------------

struct FitCommand
{
    std::string table;
    std::filesystem::path out = "out/fit";
    bool robust = false;
    std::string mean = "ratios";
};

void print_fit(const wound::SeriesFit& fit)
{
    fmt::print("{} ({} days)\n  {:<12} {:>10} {:>8} {:>8} {:>8} {:>9}\n", fit.series.name,
               fit.series.days.size(), "model", "delta", "gamma", "theta", "rmse", "aic");
    for (const wound::CurveFit& model : fit.models)
        fmt::print("{} {:<12} {:>10.5g} {:>8.4g} {:>8.4g} {:>8.4f} {:>9.2f}\n",
                   &model == &fit.best() ? "*" : " ", wound::name_of(model.model), model.curve.delta,
                   model.curve.gamma, model.curve.theta, model.rmse, model.aic);
    const wound::H3& curve = fit.best().curve;
    fmt::print(
        "  half closed after {:.2f} days, 90 % after {:.2f}, 99 % after {:.2f}; largest ratio {:.3f}\n",
        wound::half_time(curve), wound::day_below(curve, .1), wound::closure_day(curve),
        wound::largest_ratio(curve).ratio);
}

void fit(const FitCommand& command)
{
    make_folder(command.out);
    const std::vector<wound::SeriesFit> fits =
        wound::fit_table(wound::read_area_table(std::filesystem::path(command.table)), command.table,
                         {.robust = command.robust,
                          .mean = command.mean == "areas" ? wound::MeanOf::areas : wound::MeanOf::ratios});
    for (const wound::SeriesFit& one : fits)
        print_fit(one);
    engine::write_png(command.out / "fit.png", wound::draw_fit(fits.back())); // the mean, or the only series
    write_json(command.out / "fit.json", wound::fit_to_json(fits));
    fmt::print("* preferred by AIC; fit.json and fit.png ({}) in {}\n", fits.back().series.name,
               command.out.string());
}

// ---- wound
// ------------------------------------------------------------------------------------------------------

struct WoundCommand
{
    std::string photo, mask;
    std::filesystem::path out = "out/wound";
    HintOptions hints;
    double width_mm = 30, spacing = 0;
    std::string model = "face";
};

void show_wound(const WoundCommand& command)
{
    make_folder(command.out);
    wound::Photograph photograph{engine::read_rgb(command.photo), {}};
    if (!command.mask.empty())
        photograph.mask = engine::read_mask(command.mask);
    wound::Preparation preparation;
    preparation.where = command.photo;
    preparation.width_mm = command.width_mm;
    preparation.hints = command.hints.hints(command.mask);
    preparation.control_spacing = 2 * command.spacing; // a patch is 2 patch units wide
    const std::vector<wound::PreparedWound> all = wound::prepare_all(photograph, preparation);
    wound::Healing healing;
    healing.model = command.model == "face" ? wound::HealingModel::face : wound::HealingModel::contraction;
    for (std::size_t i = 0; i < all.size(); ++i) // the largest first; only the others carry a number
    {
        const std::string suffix = i == 0 ? "" : fmt::format("_{}", i + 1);
        engine::write_png(command.out / ("wound" + suffix + ".png"),
                          draw_wound_page(photograph, all[i], healing));
        engine::write_png(command.out / ("mask" + suffix + ".png"), all[i].photo_mask);
        write_json(command.out / ("wound" + suffix + ".json"), wound_to_json(all[i], healing));
        fmt::print("wound{0}.png, mask{0}.png, wound{0}.json in {1}: {2} control points\n", suffix,
                   command.out.string(), all[i].control_points.size());
    }
}

} // namespace

void add_fit_command(CLI::App& program)
{
    auto options = std::make_shared<FitCommand>();
    CLI::App* command = program.add_subcommand("fit", "Fit healing curves to measured wound areas");
    command
        ->add_option("areas", options->table,
                     "Table with columns day and area or ratio; optionally wound, weight, edge")
        ->required()
        ->type_name("AREAS.csv");
    command->add_option("--out", options->out, "Folder for fit.json and fit.png")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_flag("--robust", options->robust,
                      "One bad measurement does not pull the curve (Huber's loss)");
    command
        ->add_option("--mean", options->mean,
                     "Of several wounds: the mean of their ratios, or of their areas over that on day 0")
        ->capture_default_str()
        ->check(CLI::IsMember({"ratios", "areas"}));
    command->footer("Example: cicatrix fit areas.csv --out fit\nPut the table into a scene: \"healing\": "
                    "{\"areas\": \"areas.csv\"}");
    command->callback([options] { fit(*options); });
}

void add_wound_command(CLI::App& program)
{
    auto options = std::make_shared<WoundCommand>();
    CLI::App* command = program.add_subcommand(
        "wound", "Show what is made of a photograph: mask, control points, warp, depth");
    command->add_option("photo", options->photo, "Photograph of a wound, PNG or JPEG")
        ->required()
        ->type_name("PHOTO");
    command->add_option("--mask", options->mask, "White where the wound is; without one it is segmented")
        ->type_name("PICTURE");
    add_hint_options(*command, options->hints);
    command->add_option("--width-mm", options->width_mm, "The wound's longer side on the skin, mm")
        ->capture_default_str()
        ->check(CLI::Range(0.5, 200.0));
    command
        ->add_option(
            "--spacing", options->spacing,
            "Of the lines that give control points, as a share of the patch; 0: from the border's curvature")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 0.5));
    command->add_option("--model", options->model, "How it closes")
        ->capture_default_str()
        ->check(CLI::IsMember({"face", "contraction"}));
    command->add_option("--out", options->out, "Folder for wound.png, mask.png and wound.json")
        ->capture_default_str()
        ->type_name("DIR");
    command->footer("Example: cicatrix wound photo.jpg --rect 120,80,300,260 --out wound");
    command->callback([options] { show_wound(*options); });
}

} // namespace app
