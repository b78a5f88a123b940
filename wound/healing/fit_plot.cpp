// The picture of a fit: measurements, curves, residuals.
#include <algorithm>
#include <fmt/format.h>

#include "base/plot.hpp"
#include "wound/healing/fit.hpp"

namespace wound {

namespace {

cv::Scalar color_of(CurveModel model)
{
    return model == CurveModel::Exponential ? cv::Scalar(60, 160, 60)
           : model == CurveModel::Weibull   ? cv::Scalar(30, 110, 200)
                                            : cv::Scalar(210, 40, 40);
}

} // namespace

cv::Mat3b draw_fit(const SeriesFit& fit)
{
    cv::Mat3b picture(640, 960, cv::Vec3b(255, 255, 255));
    const AreaSeries& series = fit.series;
    const double last = series.days.back();
    std::vector<cv::Point2d> measured;
    for (std::size_t i = 0; i < series.days.size(); ++i)
        measured.emplace_back(series.days[i], series.ratios[i]);

    const double highest =
        std::max(1.1, 1.05 * *std::max_element(series.ratios.begin(), series.ratios.end()));
    base::Plot curves(picture, {0, 0, 960, 420}, {0, 1.05 * last}, {0, highest},
                      fmt::format("{}: area / area on the first day; preferred: {}", series.name,
                                  name_of(fit.best().model)),
                      "days");
    double widest = .01;
    for (const CurveFit& model : fit.models) {
        std::vector<cv::Point2d> line;
        for (int i = 0; i <= 400; ++i) {
            const double day = 1.05 * last * i / 400;
            line.emplace_back(day, unhealed_ratio(model.curve, day));
        }
        curves.line(line, color_of(model.model), 2);
        curves.legend(fmt::format("{}  RMSE {:.4f}", name_of(model.model), model.rmse),
                      color_of(model.model));
        for (cv::Point2d p : measured)
            widest = std::max(widest, std::abs(p.y - unhealed_ratio(model.curve, p.x)));
    }
    curves.points(measured, {30, 30, 30}, 5);

    base::Plot residuals(picture, {0, 420, 960, 220}, {0, 1.05 * last}, {-1.1 * widest, 1.1 * widest},
                         "measured - curve", "days");
    for (const CurveFit& model : fit.models) {
        std::vector<cv::Point2d> points;
        for (cv::Point2d p : measured)
            points.emplace_back(p.x, p.y - unhealed_ratio(model.curve, p.x));
        residuals.line(points, color_of(model.model), 1);
        residuals.points(points, color_of(model.model), 3);
    }
    return picture;
}

} // namespace wound
