// What a measured ladder looks like: as tables, as CSV, as a plot.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/plot.hpp"
#include "tools/lab/warp_ladder.hpp"

namespace lab {

namespace {

constexpr double patch_texels = 512. * 512;
constexpr double least_drawn = .01; // texels

/// In their order.
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

/// One quantity over the whole cross; `cell` makes the text of a row.
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

cv::Scalar color_of(wound::WarpModel model)
{
    return model == wound::WarpModel::Radial ? cv::Scalar(214, 130, 20)
           : model == wound::WarpModel::Grid ? cv::Scalar(30, 100, 190)
                                             : cv::Scalar(110, 70, 150);
}

const cv::Scalar fold(225, 40, 40), limit_color(120, 120, 120);

void draw_panel(const cv::Mat3b& picture, cv::Rect area, const std::vector<LadderRow>& rows,
                const std::string& shape)
{
    constexpr base::Range shown_ratios{.008, 1.5, true}, errors{least_drawn, 1000, true};
    base::Plot plot(picture, area, shown_ratios, errors, shape, "r");
    plot.line({{shown_ratios.low, error_limit}, {shown_ratios.high, error_limit}}, limit_color, 1);
    for (const wound::WarpModel model :
         {wound::WarpModel::Dense, wound::WarpModel::Radial, wound::WarpModel::Grid})
    {
        std::vector<cv::Point2d> points, shrinking, folded;
        for (const double ratio : ladder_ratios) {
            const LadderRow& row = find(rows, shape, model, ratio);
            points.emplace_back(ratio, std::max(row.error_texels, least_drawn));
            if (ratio < 1) // in between, at 1, every warp is the identity
                shrinking.push_back(points.back());
            if (row.folded_texels > 0)
                folded.push_back(points.back());
        }
        plot.points(folded, fold, 7);
        plot.line(shrinking, color_of(model), 2);
        plot.points(points, color_of(model), 3);
    }
}

void draw_legend(const cv::Mat3b& picture, cv::Rect area)
{
    cv::Mat3b target = picture;
    cv::Point at = area.tl() + cv::Point(56, 50);
    const auto entry = [&](const std::string& text) {
        base::draw_text(picture, text, at + cv::Point(24, 0));
        at.y += 24;
    };
    for (const wound::WarpModel model :
         {wound::WarpModel::Radial, wound::WarpModel::Grid, wound::WarpModel::Dense})
    {
        cv::line(target, at + cv::Point(-6, -5), at + cv::Point(16, -5), color_of(model), 2, cv::LINE_AA);
        cv::circle(target, at + cv::Point(5, -5), 3, color_of(model), cv::FILLED, cv::LINE_AA);
        entry(wound::name_of(model));
    }
    cv::circle(target, at + cv::Point(5, -5), 7, fold, cv::FILLED, cv::LINE_AA);
    entry("folded somewhere");
    cv::line(target, at + cv::Point(-6, -5), at + cv::Point(16, -5), limit_color, 1);
    entry(fmt::format("the limit, {} texel", error_limit));
    at += cv::Point(-6, 8);
    for (const std::string& line :
         {std::string("largest distance from the"), std::string("composed map, texels of 512 x 512;"),
          fmt::format("below {} it lies on the axis", least_drawn)})
    {
        base::draw_text(picture, line, at);
        at.y += 18;
    }
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
        std::string name; // a file's may hold anything
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
    constexpr int column_count = 4, page_width = 300, height = 240;
    const std::vector<std::string> shapes = shapes_of(rows);
    const int count = static_cast<int>(shapes.size()) + 1; // and the legend
    const auto panel = [](int i) {
        return cv::Rect(i % column_count * page_width, i / column_count * height, page_width, height);
    };
    cv::Mat3b picture((count + column_count - 1) / column_count * height, column_count * page_width,
                      cv::Vec3b(255, 255, 255));
    for (int i = 0; i + 1 < count; ++i)
        draw_panel(picture, panel(i), rows, shapes[i]);
    draw_legend(picture, panel(count - 1));
    return picture;
}

} // namespace lab
