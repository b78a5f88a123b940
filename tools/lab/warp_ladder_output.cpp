// Measured warp models as tables, CSV and charts.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/chart.hpp"
#include "tools/lab/warp_ladder.hpp"

namespace lab {

namespace {

constexpr double patch_texels = 512. * 512;
constexpr double least_drawn = .01; // texels

/// Names of the shapes, each once, in order of the rows.
std::vector<std::string> shapes_of(const std::vector<LadderRow>& rows)
{
    std::vector<std::string> shapes;
    for (const LadderRow& row : rows)
        if (std::find(shapes.begin(), shapes.end(), row.shape) == shapes.end())
            shapes.push_back(row.shape);
    return shapes;
}

std::vector<LadderRow> of_model(const std::vector<LadderRow>& rows, wound::WarpModel model)
{
    std::vector<LadderRow> kept;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept),
                 [model](const LadderRow& row) { return row.model == model; });
    return kept;
}

const LadderRow& find(const std::vector<LadderRow>& rows, const std::string& shape, wound::WarpModel model,
                      double ratio)
{
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const LadderRow& row) {
        return row.shape == shape && row.model == model && row.ratio == ratio;
    });
    CV_Assert(found != rows.end());
    return *found;
}

template <typename Value>
double largest(const std::vector<LadderRow>& rows, Value value)
{
    double result = -1e300;
    for (const LadderRow& row : rows)
        result = std::max(result, static_cast<double>(value(row)));
    return result;
}

/// Table of one quantity for all models, ratios and shapes; `cell` formats a row's value.
template <typename Cell>
std::string table(const std::vector<LadderRow>& rows, const std::string& title,
                  const std::vector<wound::WarpModel>& models, Cell cell)
{
    const std::vector<std::string> shapes = shapes_of(rows);
    std::string text = fmt::format("{}\n\n| model | r |", title), line = "|---|---|";
    for (const std::string& shape : shapes) {
        text += fmt::format(" {} |", shape);
        line += "---|";
    }
    text += "\n" + line + "\n";
    for (const wound::WarpModel model : models)
        for (const double ratio : ladder_ratios) {
            text += fmt::format("| {} | {} |", wound::name_of(model), ratio);
            for (const std::string& shape : shapes)
                text += fmt::format(" {} |", cell(find(rows, shape, model, ratio)));
            text += "\n";
        }
    return text;
}

base::Paint paint_of(wound::WarpModel model)
{
    return base::series_paint(model == wound::WarpModel::Radial ? 4
                              : model == wound::WarpModel::Grid ? 1
                                                                : 3);
}

constexpr base::Paint fold = base::paint(0xe12828);
constexpr double fold_radius = 7, radius = 3, line_width = 2; // px
constexpr double limit_width = 1.5;

base::Chart panel(const std::vector<LadderRow>& rows, const std::string& shape)
{
    base::Chart chart{
        .title = shape,
        .x = {.title = "r", .low = .008, .high = 1.5, .logarithmic = true},
        .y = {.title = "error", .unit = "texels", .low = least_drawn, .high = 1000, .logarithmic = true},
        .references = {{.at = error_limit, .width = limit_width}}};
    for (const wound::WarpModel model :
         {wound::WarpModel::Dense, wound::WarpModel::Radial, wound::WarpModel::Grid})
    {
        base::Series folded{.paint = fold, .radius = fold_radius};
        base::Series shrinking{.paint = paint_of(model), .line_width = line_width};
        base::Series all{.paint = paint_of(model), .radius = radius};
        for (const double ratio : ladder_ratios) {
            const LadderRow& row = find(rows, shape, model, ratio);
            const cv::Point2d point(ratio, std::max(row.error_texels, least_drawn));
            all.points.push_back(point);
            if (ratio < 1) // no line across 1, where every warp is the identity
                shrinking.points.push_back(point);
            if (row.folded_texels > 0)
                folded.points.push_back(point);
        }
        chart.series.insert(chart.series.end(), {folded, shrinking, all});
    }
    return chart;
}

std::vector<base::LegendEntry> legend()
{
    std::vector<base::LegendEntry> entries;
    for (const wound::WarpModel model :
         {wound::WarpModel::Radial, wound::WarpModel::Grid, wound::WarpModel::Dense})
        entries.push_back({wound::name_of(model), paint_of(model), line_width, radius});
    entries.push_back({"folded somewhere", fold, 0, fold_radius});
    entries.push_back({fmt::format("the limit, {} texel", error_limit), base::palette::faint, limit_width});
    return entries;
}

void draw_explanation(base::Canvas& canvas, const cv::Rect2d& area)
{
    base::draw_legend(canvas, area + cv::Point2d(20, 40), legend());
    double y = area.y + 150;
    for (const std::string& line :
         {std::string("error: largest distance from the"), std::string("composed map, texels of 512 x 512;"),
          fmt::format("below {} it lies on the axis", least_drawn)})
        canvas.text({area.x + 20, y += 18}, line, {base::palette::ink, 9});
}

} // namespace

std::optional<wound::WarpModel> cheapest_exact(const std::vector<LadderRow>& rows)
{
    std::optional<wound::WarpModel> cheapest;
    double least_cost = 1e300;
    for (const wound::WarpModel model : warp_models) {
        const std::vector<LadderRow> own = of_model(rows, model);
        const double cost = largest(own, [](const LadderRow& row) { return row.ms_per_megatexel; });
        const bool exact = std::all_of(own.begin(), own.end(), [](const LadderRow& row) {
            return row.error_texels <= error_limit && row.folded_texels == 0;
        });
        if (exact && cost < least_cost) {
            cheapest = model;
            least_cost = cost;
        }
    }
    return cheapest;
}

std::string ladder_summary(const std::vector<LadderRow>& rows)
{
    std::string text =
        "| model | error, texels | near the wound | area, % | folded texels | least Jacobian | "
        "make, ms | CPU ms/megatexel |\n|---|---|---|---|---|---|---|---|\n";
    for (const wound::WarpModel model : warp_models) {
        const std::vector<LadderRow> own = of_model(rows, model);
        text += fmt::format(
            "| {} | {:.3f} | {:.3f} | {:.2f} | {:.0f} | {:.3f} | {:.1f} .. {:.1f} | {:.0f} .. {:.0f} |\n",
            wound::name_of(model), largest(own, [](const LadderRow& row) { return row.error_texels; }),
            largest(own, [](const LadderRow& row) { return row.near_error_texels; }),
            100 * largest(own, [](const LadderRow& row) { return std::abs(row.area_error); }),
            largest(own, [](const LadderRow& row) { return row.folded_texels; }),
            -largest(own, [](const LadderRow& row) { return -row.least_jacobian; }),
            -largest(own, [](const LadderRow& row) { return -row.make_ms; }),
            largest(own, [](const LadderRow& row) { return row.make_ms; }),
            -largest(own, [](const LadderRow& row) { return -row.ms_per_megatexel; }),
            largest(own, [](const LadderRow& row) { return row.ms_per_megatexel; }));
    }
    return text;
}

std::string ladder_tables(const std::vector<LadderRow>& rows)
{
    using enum wound::WarpModel;
    std::string text = table(rows, "Error, texels:", {Radial, Grid, Dense},
                             [](const LadderRow& row) { return fmt::format("{:.3f}", row.error_texels); });
    text += table(rows, "\nArea error, %:", {Radial, Grid, Dense, Composed}, [](const LadderRow& row) {
        const double hundredths = std::round(1e4 * row.area_error);
        return fmt::format("{:.2f}", hundredths == 0 ? 0 : hundredths / 100);
    });
    text += table(rows, "\nLeast Jacobian, and the share of the patch that is folded:",
                  {Radial, Grid, Dense, Composed}, [](const LadderRow& row) {
                      return row.folded_texels == 0 ? fmt::format("{:.3f}", row.least_jacobian)
                                                    : fmt::format("{:.3f}, {:.2g} %", row.least_jacobian,
                                                                  100 * row.folded_texels / patch_texels);
                  });
    text += table(rows, "\nCost per texel, the grid's = 1:", {Radial, Dense, Composed},
                  [&](const LadderRow& row) {
                      const double times =
                          row.ms_per_megatexel / find(rows, row.shape, Grid, row.ratio).ms_per_megatexel;
                      return fmt::format("{:.{}f}", times, times < 10 ? 2 : 0);
                  });
    return text;
}

std::string ladder_csv(const std::vector<LadderRow>& rows)
{
    std::string text = "shape,model,r,error_texels,near_error_texels,area_error,folded_texels,least_jacobian,"
                       "make_ms,ms_per_megatexel\n";
    for (const LadderRow& row : rows) {
        std::string name; // a file name may contain quotes
        for (const char c : row.shape)
            name += c == '"' ? std::string("\"\"") : std::string(1, c);
        text += fmt::format("\"{}\",{},{},{:.6g},{:.6g},{:.6g},{},{:.6g},{:.6g},{:.6g}\n", name,
                            wound::name_of(row.model), row.ratio, row.error_texels, row.near_error_texels,
                            row.area_error, row.folded_texels, row.least_jacobian, row.make_ms,
                            row.ms_per_megatexel);
    }
    return text;
}

cv::Mat3b draw_ladder(const std::vector<LadderRow>& rows)
{
    constexpr int column_count = 4, panel_width = 300, panel_height = 240; // px
    const std::vector<std::string> shapes = shapes_of(rows);
    const int count = static_cast<int>(shapes.size()) + 1; // with the legend
    const auto place = [](int i) {
        return cv::Rect2d(i % column_count * panel_width, i / column_count * panel_height, panel_width,
                          panel_height);
    };
    cv::Mat3b picture((count + column_count - 1) / column_count * panel_height, column_count * panel_width,
                      base::rgb_of(base::palette::white));
    base::PictureCanvas canvas(picture);
    for (int i = 0; i + 1 < count; ++i)
        base::draw_chart(canvas, place(i), panel(rows, shapes[i]));
    draw_explanation(canvas, place(count - 1));
    return picture;
}

} // namespace lab
