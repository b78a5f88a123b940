// The picture of a fit: measurements, curves, residuals.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/chart.hpp"
#include "wound/healing/fit.hpp"

namespace wound {

namespace {

base::Paint paint_of(CurveModel model)
{
    return base::series_paint(model == CurveModel::H3 ? 0 : model == CurveModel::Weibull ? 1 : 2);
}

std::vector<cv::Point2d> measured_points(const AreaSeries& series)
{
    std::vector<cv::Point2d> points;
    for (std::size_t i = 0; i < series.days.size(); ++i)
        points.emplace_back(series.days[i], series.ratios[i]);
    return points;
}

base::Chart curve_chart(const SeriesFit& fit, const base::Axis& days)
{
    base::Chart chart{.title = fmt::format("{}: {} is preferred", fit.series.name, name_of(fit.best().model)),
                      .x = days,
                      .y = {.title = "area / area on the first day", .low = 0}};
    for (const CurveFit& model : fit.models) {
        base::Series line{.legend = fmt::format("{}, RMSE {:.4f}", name_of(model.model), model.rmse),
                          .paint = paint_of(model.model),
                          .line_width = 2};
        for (int i = 0; i <= 400; ++i) {
            const double day = *days.high * i / 400;
            line.points.emplace_back(day, unhealed_ratio(model.curve, day));
        }
        chart.series.push_back(std::move(line));
    }
    chart.series.push_back({.legend = "measured", .points = measured_points(fit.series), .radius = 5});
    double highest = 1.1; // from the measurements only: a curve may rise far above them
    for (const double ratio : fit.series.ratios)
        highest = std::max(highest, 1.05 * ratio);
    chart.y.high = highest;
    return chart;
}

base::Chart residual_chart(const SeriesFit& fit, const base::Axis& days)
{
    base::Chart chart{.x = days, .y = {.title = "measured - curve"}};
    double widest = .01;
    for (const CurveFit& model : fit.models) {
        base::Series residuals{.paint = paint_of(model.model), .line_width = 1, .radius = 3};
        for (const cv::Point2d& p : measured_points(fit.series)) {
            residuals.points.emplace_back(p.x, p.y - unhealed_ratio(model.curve, p.x));
            widest = std::max(widest, std::abs(residuals.points.back().y));
        }
        chart.series.push_back(std::move(residuals));
    }
    chart.y.low = -1.1 * widest;
    chart.y.high = 1.1 * widest;
    return chart;
}

} // namespace

cv::Mat3b draw_fit(const SeriesFit& fit)
{
    cv::Mat3b picture(640, 960, base::rgb_of(base::palette::white));
    base::PictureCanvas canvas(picture);
    const base::Axis days{.title = "time", .unit = "days", .low = 0, .high = 1.05 * fit.series.days.back()};
    base::draw_chart(canvas, {0, 0, 960, 420}, curve_chart(fit, days));
    base::draw_chart(canvas, {0, 420, 960, 220}, residual_chart(fit, days));
    return picture;
}

} // namespace wound
