// Fits healing curves to measured areas: H3, and its special cases Weibull (theta = 0) and exponential (theta
// = 0, gamma = 1). Bounded Levenberg-Marquardt with analytic Jacobian from many fixed starts, so a fit is
// deterministic.
#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "wound/healing/area_table.hpp"
#include "wound/healing/healing.hpp"

namespace wound {

enum class CurveModel
{
    Exponential,
    Weibull,
    H3
};
inline constexpr std::array curve_models{CurveModel::Exponential, CurveModel::Weibull, CurveModel::H3};
const char* name_of(CurveModel model);

struct FitOptions
{
    bool robust = false; // Huber's loss, which limits the influence of outliers
    MeanOf mean = MeanOf::Areas;
};

struct CurveFit
{
    CurveModel model = CurveModel::Exponential;
    H3 curve;
    std::array<double, 3> standard_errors{}; // of delta, gamma, theta; NaN if fixed, at a bound or not
                                             // identifiable
    double residual = 0;                     // weighted sum of squares
    double rmse = 0;                         // of the ratio
    double aic = 0;                          // n ln(residual / n) + 2 (parameters + 1)
};

struct SeriesFit
{
    AreaSeries series;
    std::vector<CurveFit>
        models; // by number of parameters, which is at most the number of measured days after day 0
    std::size_t preferred = 0; // index of the least AIC
    const CurveFit& best() const { return models[preferred]; }
};

/// Throws base::InputError (`where` names the table) for a series of fewer than two days.
SeriesFit fit_series(const AreaSeries& series, std::string_view where, const FitOptions& options = {});

/// Fits every series measured on two days or more; for several series also the means of their groups and,
/// last, the mean of all.
std::vector<SeriesFit> fit_table(const std::vector<AreaSeries>& table, std::string_view where,
                                 const FitOptions& options = {});

/// The series of that name; for an empty name the table's mean or its only wound. Throws base::InputError for
/// an unknown name.
SeriesFit fit_from_areas(const std::filesystem::path& table, std::string_view series = {});
/// The preferred curve of fit_from_areas(); used for a scene's "areas" file.
H3 curve_from_areas(const std::filesystem::path& table, std::string_view series = {});

/// The curve's largest ratio, infinite if it never stops growing, and the day of that ratio.
struct Peak
{
    double ratio = 1, day = 0;
};
Peak largest_ratio(const H3& curve);

/// fit.json: {"series": [{"name", "n", "models": {...}, "preferred", "half_time_days", ...}]}; unknown or
/// infinite values are null.
nlohmann::json fit_to_json(const std::vector<SeriesFit>& fits);

/// Measurements with the three curves above their residuals, RGB, 960 x 640.
cv::Mat3b draw_fit(const SeriesFit& fit);

} // namespace wound
