#include "wound/healing/fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"

namespace wound {

namespace {

constexpr double least_delta = 1e-14; // day^-gamma; the fit works with its logarithm

int parameters_of(CurveModel model)
{
    return model == CurveModel::Exponential ? 1 : model == CurveModel::Weibull ? 2 : 3;
}

/// ln delta, gamma, theta: the first parameters_of(model) are free.
using Parameters = Eigen::Vector3d;
const Parameters low_corner{std::log(least_delta), .5, -1};
const Parameters high_corner{std::log(10.), 4, 1};

H3 curve_of(const Parameters& p)
{
    return {p[0] <= low_corner[0] ? 0 : std::min(std::exp(p[0]), 10.), p[1], p[2], 0};
}

/// Weighted residuals and their derivatives; E = r for an asymptote of 0.
struct Linearised
{
    Eigen::VectorXd residual;
    Eigen::MatrixX3d jacobian;
};

Linearised linearise(const AreaSeries& series, const std::vector<double>& weights, const Parameters& p)
{
    const auto n = static_cast<Eigen::Index>(series.days.size());
    Linearised result{Eigen::VectorXd(n), Eigen::MatrixX3d(n, 3)};
    const H3 curve = curve_of(p);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double t = series.days[i];
        const double root = std::sqrt(weights[i]);
        const double e = unhealed_ratio(curve, t);
        const double power = t > 0 ? curve.delta * std::pow(t, curve.gamma) : 0;
        result.residual[i] = root * (e - series.ratios[i]);
        // If e has underflowed to 0, `power` may be infinite and 0 x infinity NaN; the limit is 0.
        const double slope = e > 0 ? e * power : 0;
        result.jacobian.row(i) << -root * slope, t > 0 ? -root * slope * std::log(t) : 0,
            -root * e * t / std::hypot(1, curve.theta * t);
    }
    return result;
}

/// Levenberg-Marquardt within the bounds: a step is clamped to the bounds, and a parameter at a bound is
/// fixed while the gradient points outwards.
Parameters minimise(const AreaSeries& series, const std::vector<double>& weights, int free, Parameters p)
{
    double damping = 1e-3;
    Linearised at = linearise(series, weights, p);
    for (int iteration = 0; iteration < 200 && damping < 1e12; ++iteration) {
        const auto jacobian = at.jacobian.leftCols(free);
        Eigen::VectorXd gradient = jacobian.transpose() * at.residual;
        Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
        for (int k = 0; k < free; ++k)
            if ((p[k] <= low_corner[k] && gradient[k] > 0) || (p[k] >= high_corner[k] && gradient[k] < 0)) {
                normal.row(k).setZero();
                normal.col(k).setZero();
                normal(k, k) = 1;
                gradient[k] = 0;
            }
        const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-12);
        normal.diagonal() += damping * scale;
        const Eigen::VectorXd step = normal.ldlt().solve(-gradient);
        Parameters next = p;
        next.head(free) = (p.head(free) + step).cwiseMax(low_corner.head(free)).cwiseMin(high_corner.head(free));
        Linearised there = linearise(series, weights, next);
        const double before = at.residual.squaredNorm();
        const double after = there.residual.squaredNorm();
        if (!(after < before)) {
            damping *= 4;
            continue;
        }
        p = next;
        at = std::move(there);
        damping = std::max(damping / 6, 1e-15);
        if (before - after < 1e-15 * before)
            break;
    }
    return p;
}

/// The best minimum from several starts. Candidates are curves of several shapes and half-closure days; the
/// starts_to_try of them that lie nearest the data are minimised.
Parameters best_minimum(const AreaSeries& series, const std::vector<double>& weights, int free)
{
    constexpr std::size_t starts_to_try = 12;
    const double last = std::max(series.days.back(), 1e-6);
    const auto misfit = [&](const Parameters& p) {
        return linearise(series, weights, p).residual.squaredNorm();
    };
    std::vector<std::pair<double, Parameters>> starts;
    for (double half : {.1, .3, .6, 1.5})
        for (double gamma : {1., .7, 1.6, 2.4, 3.4})
            for (double theta : {0., -.4, -.05, .05, .4}) {
                if ((free < 2 && gamma != 1) || (free < 3 && theta != 0))
                    continue;
                const double log_delta = std::log(std::log(2.)) - gamma * std::log(half * last);
                const Parameters start(std::clamp(log_delta, low_corner[0], high_corner[0]), gamma, theta);
                starts.emplace_back(misfit(start), start);
            }
    std::stable_sort(starts.begin(), starts.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    starts.resize(std::min(starts.size(), starts_to_try));
    Parameters best = starts.front().second;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [unused, start] : starts) {
        const Parameters found = minimise(series, weights, free, start);
        if (const double residual = misfit(found); residual < least) {
            least = residual;
            best = found;
        }
    }
    return best;
}

/// Huber's weights for residuals beyond 1.345 robust standard deviations.
std::vector<double> huber_weights(const AreaSeries& series, const Parameters& p)
{
    std::vector<double> sizes;
    for (std::size_t i = 0; i < series.days.size(); ++i)
        sizes.push_back(std::abs(unhealed_ratio(curve_of(p), series.days[i]) - series.ratios[i]));
    std::vector<double> sorted = sizes;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    const double allowed = std::max(1.345 * 1.4826 * sorted[sorted.size() / 2], 1e-9);
    std::vector<double> weights = series.weights;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        weights[i] *= std::min(1., allowed / std::max(sizes[i], 1e-300));
    return weights;
}

/// From the covariance s^2 (J^T J)^-1 of the free parameters that are off their bounds.
std::array<double, 3> standard_errors(const Linearised& at, const Parameters& p, int free)
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::array<double, 3> errors{unknown, unknown, unknown};
    std::vector<int> inside;
    for (int k = 0; k < free; ++k)
        if (p[k] > low_corner[k] && p[k] < high_corner[k])
            inside.push_back(k);
    const auto m = static_cast<Eigen::Index>(inside.size());
    const Eigen::Index n = at.residual.size();
    if (m == 0 || n <= m)
        return errors;
    Eigen::MatrixXd jacobian(n, m);
    for (Eigen::Index k = 0; k < m; ++k)
        jacobian.col(k) = at.jacobian.col(inside[k]);
    const Eigen::FullPivLU<Eigen::MatrixXd> normal(jacobian.transpose() * jacobian);
    if (!normal.isInvertible())
        return errors;
    const Eigen::MatrixXd covariance =
        normal.inverse() * (at.residual.squaredNorm() / static_cast<double>(n - m));
    for (Eigen::Index k = 0; k < m; ++k)
        errors[inside[k]] = std::sqrt(covariance(k, k)) *
                            (inside[k] == 0 ? std::exp(p[0]) : 1); // of delta, not of its logarithm
    return errors;
}

CurveFit fit_model(const AreaSeries& series, CurveModel model, const FitOptions& options)
{
    const int free = parameters_of(model);
    std::vector<double> weights = series.weights;
    Parameters p = best_minimum(series, weights, free);
    for (int round = 0; options.robust && round < 20; ++round) {
        weights = huber_weights(series, p);
        p = minimise(series, weights, free, p);
    }
    const Linearised at = linearise(series, weights, p);
    CurveFit fit;
    fit.model = model;
    fit.curve = curve_of(p);
    fit.standard_errors = standard_errors(at, p, free);
    fit.residual = at.residual.squaredNorm();
    const double total = [&] {
        double sum = 0;
        for (double w : weights)
            sum += w;
        return sum;
    }();
    fit.rmse = std::sqrt(fit.residual / total);
    const auto n = static_cast<double>(series.days.size());
    // The RMSE is at least 1e-6, the precision of a ratio: a perfect fit would have an AIC of minus infinity.
    fit.aic = n * std::log(std::max(fit.rmse * fit.rmse, 1e-12)) + 2 * (free + 1);
    return fit;
}

nlohmann::json finite_or_null(double value)
{
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

} // namespace

const char* name_of(CurveModel model)
{
    return model == CurveModel::Exponential ? "exponential" : model == CurveModel::Weibull ? "weibull" : "h3";
}

SeriesFit fit_series(const AreaSeries& series, std::string_view where, const FitOptions& options)
{
    if (series.days.size() < 2)
        throw base::InputError(where, fmt::format("{}: measured on one day only", series.name),
                               "give areas on two days or more");
    SeriesFit fit{series, {}, 0};
    for (CurveModel model : curve_models)
        // Every curve is 1 on day 0, so that day determines no parameter.
        if (parameters_of(model) <= static_cast<int>(series.days.size()) - 1)
            fit.models.push_back(fit_model(series, model, options));
    for (std::size_t i = 1; i < fit.models.size(); ++i)
        if (fit.models[i].aic < fit.models[fit.preferred].aic)
            fit.preferred = i;
    return fit;
}

std::vector<SeriesFit> fit_table(const std::vector<AreaSeries>& table, std::string_view where,
                                 const FitOptions& options)
{
    std::vector<SeriesFit> fits;
    for (const AreaSeries& series : table)
        if (series.days.size() >= 2 || table.size() == 1)
            fits.push_back(fit_series(series, where, options));
    for (const AreaSeries& mean : group_means(table, options.mean))
        fits.push_back(fit_series(mean, where, options));
    if (table.size() > 1)
        fits.push_back(fit_series(mean_series(table, options.mean), where, options));
    return fits;
}

SeriesFit fit_from_areas(const std::filesystem::path& table, std::string_view series)
{
    const std::vector<SeriesFit> fits = fit_table(read_area_table(table), table.string());
    if (series.empty())
        return fits.back();
    std::string names;
    for (const SeriesFit& fit : fits) {
        if (fit.series.name == series)
            return fit;
        names += (names.empty() ? "" : ", ") + fit.series.name;
    }
    throw base::InputError(table.string(), fmt::format("has no series \"{}\"", series),
                           "name one of: " + names);
}

H3 curve_from_areas(const std::filesystem::path& table, std::string_view series)
{
    return fit_from_areas(table, series).best().curve;
}

Peak largest_ratio(const H3& curve)
{
    // r rises only while -theta / sqrt(1 + theta^2 t^2) exceeds delta gamma t^(gamma-1): search days on a
    // logarithmic scale.
    Peak peak;
    for (double day = 1e-4; day < 1e6; day *= 1.005)
        if (const double ratio = unhealed_ratio(curve, day); ratio > peak.ratio)
            peak = {ratio, day};
    if (peak.day > 9e5) // still rising at the end of the search
        peak = {std::numeric_limits<double>::infinity(), peak.day};
    return peak;
}

nlohmann::json fit_to_json(const std::vector<SeriesFit>& fits)
{
    nlohmann::json all = nlohmann::json::array();
    for (const SeriesFit& fit : fits) {
        nlohmann::json models;
        for (const CurveFit& model : fit.models) {
            const auto& errors = model.standard_errors;
            models[name_of(model.model)] = {{"delta", model.curve.delta},
                                            {"gamma", model.curve.gamma},
                                            {"theta", model.curve.theta},
                                            {"delta_se", finite_or_null(errors[0])},
                                            {"gamma_se", finite_or_null(errors[1])},
                                            {"theta_se", finite_or_null(errors[2])},
                                            {"residual", model.residual},
                                            {"rmse", model.rmse},
                                            {"aic", model.aic}};
        }
        const H3& curve = fit.best().curve;
        all.push_back({{"name", fit.series.name},
                       {"n", fit.series.days.size()},
                       {"left_out", fit.series.left_out},
                       {"models", models},
                       {"preferred", name_of(fit.best().model)},
                       {"half_time_days", finite_or_null(half_time(curve))},
                       {"day_90_percent_closed", finite_or_null(day_below(curve, .1))},
                       {"day_99_percent_closed", finite_or_null(day_below(curve, .01))},
                       {"largest_ratio", finite_or_null(largest_ratio(curve).ratio)}});
    }
    return {{"series", all}};
}

} // namespace wound
