#include "apps/fit/fit.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "wound/healing/fit.hpp"

namespace fit_command {
namespace {

struct FitCommand
{
    std::string table;
    std::filesystem::path out = "out/fit";
    bool robust = false;
    std::string mean = "areas";
};

/// "value +- standard error"; only the value when the error is not finite.
std::string with_error(double value, double error)
{
    return std::isfinite(error) ? fmt::format("{:.4g} +- {:.2g}", value, error)
                                : fmt::format("{:.4g}", value);
}

std::string after(double day)
{
    return std::isfinite(day) ? fmt::format("after {:.2f} days", day) : "never";
}

void print_fit(const wound::SeriesFit& fit)
{
    fmt::print("{} ({} days{})\n  {:<12} {:>20} {:>18} {:>18} {:>8} {:>9}\n", fit.series.name,
               fit.series.days.size(),
               fit.series.left_out > 0 ? fmt::format(", {} rows left out", fit.series.left_out) : "", "model",
               "delta", "gamma", "theta", "rmse", "aic");
    for (const wound::CurveFit& model : fit.models)
        fmt::print("{} {:<12} {:>20} {:>18} {:>18} {:>8.4f} {:>9.2f}\n", &model == &fit.best() ? "*" : " ",
                   wound::name_of(model.model), with_error(model.curve.delta, model.standard_errors[0]),
                   with_error(model.curve.gamma, model.standard_errors[1]),
                   with_error(model.curve.theta, model.standard_errors[2]), model.rmse, model.aic);
    const wound::H3& curve = fit.best().curve;
    const double largest = wound::largest_ratio(curve).ratio;
    fmt::print("  half closed {}, 90 % {}, 99 % {}; largest ratio {}\n", after(wound::half_time(curve)),
               after(wound::day_below(curve, .1)), after(wound::closure_day(curve)),
               std::isfinite(largest) ? fmt::format("{:.3f}", largest) : "unbounded");
}

void fit(const FitCommand& command)
{
    base::make_folder(command.out);
    const std::vector<wound::AreaSeries> table = wound::read_area_table(std::filesystem::path(command.table));
    const std::vector<wound::SeriesFit> fits =
        wound::fit_table(table, command.table,
                         {.robust = command.robust,
                          .mean = command.mean == "areas" ? wound::MeanOf::Areas : wound::MeanOf::Ratios});
    for (const wound::AreaSeries& one : table)
        if (one.days.size() < 2)
            fmt::print("{}: measured on one day only, used only in the means\n", one.name);
    cv::Mat3b picture = wound::draw_fit(fits.back()); // the mean of all, or the only series
    std::string drawn = fits.back().series.name;
    for (const wound::SeriesFit& one : fits) {
        print_fit(one);
        if (one.series.name == "mean " + one.series.group) {
            cv::vconcat(picture.clone(), wound::draw_fit(one), picture);
            drawn += ", " + one.series.name;
        }
    }
    base::write_png(command.out / "fit.png", picture);
    base::write_json(command.out / "fit.json", wound::fit_to_json(fits));
    fmt::print("* preferred by AIC; fit.json and fit.png ({}) in {}\n", drawn, command.out.string());
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<FitCommand>();
    CLI::App* command = program.add_subcommand("fit", "Fit healing curves to measured wound areas");
    command
        ->add_option("areas", options->table,
                     "Table with columns day and area or ratio; optionally wound, group, weight, edge")
        ->required()
        ->type_name("AREAS.csv");
    command->add_option("--out", options->out, "Folder for fit.json and fit.png")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_flag("--robust", options->robust,
                      "Fit with Huber's loss, which limits the influence of outliers");
    command
        ->add_option("--mean", options->mean,
                     "Mean of several wounds: mean area / mean area on day 0, or mean of their ratios")
        ->capture_default_str()
        ->check(CLI::IsMember({"areas", "ratios"}));
    command->footer(
        "Example: cicatrix fit areas.csv --out fit\n\n"
        "  wound,day,area_reader1,edge_reader1,area_reader2,edge_reader2\n"
        "  old-1,0,22.1,seen,21.5,seen\n"
        "  old-1,3,17.4,seen,18.0,imagined\n"
        "  young-1,0,25.0,seen,,\n\n"
        "Areas of several readers are averaged; a row is skipped when all its readers imagined the "
        "edge.\nEvery wound is fitted, then the mean of each group (a column group, or the name before "
        "its first -)\nand of all. Use the table in a scene: \"healing\": {\"areas\": "
        "\"areas.csv\", \"series\": \"mean old\"};\nwithout series it is the mean of all.");
    command->callback([options] { fit(*options); });
}

} // namespace fit_command
