// Fits to known curves, to published data, and to degenerate series.
#include "wound/healing/fit.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

#include "base/input_error.hpp"
#include "base/palette.hpp"

namespace {

using wound::AreaSeries;
using wound::CurveModel;
using wound::H3;
using wound::SeriesFit;

AreaSeries series(const std::vector<double>& days, const std::vector<double>& ratios)
{
    return {"wound", days, ratios, std::vector<double>(days.size(), 1)};
}

AreaSeries sampled(const H3& curve, double last, int count, double noise = 0)
{
    AreaSeries result{"wound", {}, {}, {}};
    std::mt19937 random(3);
    std::normal_distribution<double> error(0, noise > 0 ? noise : 1);
    for (int i = 0; i < count; ++i) {
        const double day = last * i / (count - 1);
        result.days.push_back(day);
        result.ratios.push_back(wound::unhealed_ratio(curve, day) + (noise > 0 && i > 0 ? error(random) : 0));
        result.weights.push_back(1);
    }
    return result;
}

SeriesFit fit(const AreaSeries& data, bool robust = false)
{
    return wound::fit_series(data, "areas.csv", {robust});
}

TEST(Fit, RecoversCurvesFromTheirOwnValues)
{
    for (const H3& truth :
         {H3{.2251, 1.316, -.361, 0}, H3{.004261, 2.336, .0168, 0}, H3{.02822, 1.5, 0, 0}, H3{.5, .7, .2, 0}})
    {
        const SeriesFit found = fit(sampled(truth, 20, 15));
        const H3& h3 = found.models[2].curve;
        EXPECT_LT(found.models[2].rmse, 1e-6);
        EXPECT_NEAR(h3.delta, truth.delta, 1e-3 * truth.delta);
        EXPECT_NEAR(h3.gamma, truth.gamma, 1e-3);
        EXPECT_NEAR(h3.theta, truth.theta, 1e-3);
    }
}

TEST(Fit, PrefersTheSimplestModelThatExplainsTheData)
{
    const SeriesFit exponential = fit(sampled({.12, 1, 0, 0}, 20, 12, .01));
    EXPECT_EQ(exponential.best().model, CurveModel::Exponential);
    const SeriesFit growing = fit(sampled({.2251, 1.316, -.361, 0}, 15, 14, .02));
    EXPECT_EQ(growing.best().model, CurveModel::H3);
    EXPECT_LT(growing.best().curve.theta, 0);
}

TEST(Fit, StandardErrorsCoverTheTruth)
{
    const H3 truth{.02, 1.8, 0, 0};
    const SeriesFit found = fit(sampled(truth, 20, 60, .02));
    const auto& weibull = found.models[1];
    EXPECT_LT(std::abs(weibull.curve.gamma - truth.gamma), 3 * weibull.standard_errors[1]);
    EXPECT_LT(std::abs(weibull.curve.delta - truth.delta), 3 * weibull.standard_errors[0]);
    EXPECT_LT(weibull.standard_errors[1], .3);
    EXPECT_TRUE(std::isnan(weibull.standard_errors[2]));
}

// Mean ratios of the aged mice (A8) in the tracings 10.5281/zenodo.23062849 of the photographs
// Dryad 10.25338/B84W8Q: six wounds, two readers averaged, without the days on which both readers only
// imagined the edge.
TEST(Fit, AgedMiceNeedMoreThanAnExponential)
{
    const SeriesFit found = fit(series({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
                                       {1.0000, 0.9825, 0.9663, 0.9250, 0.8434, 0.6931, 0.6866, 0.5989,
                                        0.4320, 0.3518, 0.2665, 0.2025, 0.2410, 0.1326, 0.1076, 0.0551}));
    EXPECT_NEAR(found.models[2].rmse, .030, .002);
    EXPECT_NEAR(found.models[0].rmse, .119, .003);
    EXPECT_GT(found.models[0].aic, found.best().aic + 30);
}

TEST(Fit, YoungMiceGrowFirst)
{
    const SeriesFit found = fit(series({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14},
                                       {1.0000, 1.2157, 1.1140, 1.0026, 0.8906, 0.5792, 0.3965, 0.2941,
                                        0.2075, 0.1546, 0.0969, 0.0081, 0.0173, 0.0024, 0.0028}));
    EXPECT_NEAR(found.models[2].rmse, .033, .002);
    EXPECT_NEAR(found.models[1].rmse, .084, .002);
    EXPECT_NEAR(found.models[0].rmse, .209, .003);
    EXPECT_EQ(found.best().model, CurveModel::H3);
    EXPECT_LT(found.best().curve.theta, 0);
    EXPECT_GT(wound::largest_ratio(found.best().curve).ratio, 1.1);
}

TEST(Fit, IsDeterministic)
{
    const AreaSeries data = sampled({.05, 1.4, -.1, 0}, 18, 11, .03);
    const SeriesFit a = fit(data), b = fit(data);
    for (std::size_t i = 0; i < a.models.size(); ++i)
        EXPECT_EQ(a.models[i].curve.delta, b.models[i].curve.delta);
}

TEST(Fit, RobustLossIgnoresAnOutlier)
{
    const H3 truth{.02, 1.8, 0, 0};
    AreaSeries data = sampled(truth, 20, 20);
    data.ratios[14] += .6;
    const double plain = std::abs(wound::half_time(fit(data).models[1].curve) - wound::half_time(truth));
    const double robust =
        std::abs(wound::half_time(fit(data, true).models[1].curve) - wound::half_time(truth));
    EXPECT_GT(plain, .15);
    EXPECT_LT(robust, .05);
}

TEST(Fit, HostileSeriesGiveAFiniteFit)
{
    std::vector<double> many_days, many_ratios;
    for (int i = 0; i < 3000; ++i) {
        many_days.push_back(.01 * i);
        many_ratios.push_back(std::exp(-.002 * i));
    }
    for (const AreaSeries& data :
         {series({0, 1, 2, 3}, {1, 1, 1, 1}), series({0, 1, 2, 3}, {1, 1.5, 2, 9}), series({0, 5}, {1, .5}),
          series({0, 1e9}, {1, .1}), series({0, 1, 2}, {1, 0, 0}), series({0, 1e-9, 2e-9, 1}, {1, 1, .5, 0}),
          series(many_days, many_ratios)})
    {
        const SeriesFit found = fit(data);
        for (const auto& model : found.models) {
            EXPECT_TRUE(std::isfinite(model.rmse) && std::isfinite(model.aic));
            EXPECT_NO_THROW(wound::validate({model.curve, wound::HealingModel::Contraction, 0}, "fit"));
        }
    }
}

TEST(Fit, OneDayIsRefused)
{
    EXPECT_THROW(fit(series({0}, {1})), base::InputError);
}

TEST(Fit, ATableOfSeveralWoundsGetsTheirMean)
{
    AreaSeries a = sampled({.1, 1, 0, 0}, 10, 6), b = sampled({.2, 1, 0, 0}, 10, 6);
    a.name = "a";
    b.name = "b";
    const auto fits = wound::fit_table({a, b}, "areas.csv");
    ASSERT_EQ(fits.size(), 3U);
    EXPECT_EQ(fits[2].series.name, "mean");
    const auto json = wound::fit_to_json(fits);
    EXPECT_EQ(json["series"][0]["name"], "a");
    EXPECT_EQ(json["series"][0]["preferred"], "exponential");
    EXPECT_NEAR(json["series"][0]["half_time_days"].get<double>(), std::log(2) / .1, 1e-4);
    EXPECT_TRUE(json["series"][0]["models"]["h3"].contains("theta"));
    EXPECT_TRUE(json["series"][0]["models"]["exponential"]["gamma_se"].is_null());
}

/// A table by two readers: six wounds in two groups, with noise; rows that both imagined are far off.
std::filesystem::path table_of_two_groups()
{
    const auto file = std::filesystem::temp_directory_path() / "cicatrix_fit_test_groups.csv";
    std::ofstream table(file);
    table << "wound,day,area_mm2_reader1,edge_reader1,area_mm2_reader2,edge_reader2\n";
    std::mt19937 random(5);
    std::normal_distribution<double> error(0, .02);
    for (const std::string name : {"A8-1-L", "A8-1-R", "A8-2-L", "Y8-1-L", "Y8-1-R", "Y8-2-L"}) {
        const H3 curve = name.starts_with("A8") ? H3{.0128, 1.98, 0, 0} : H3{.3593, 1.129, -.5229, 0};
        const double first = 20 + double(random() % 10);
        for (int day = 0; day <= 15; ++day) {
            const double area = first * (wound::unhealed_ratio(curve, day) + (day > 0 ? error(random) : 0));
            const bool imagined = day == 5 && name != "A8-1-R";
            table << fmt::format("{},{},{:.4f},{},{:.4f},{}\n", name, day,
                                 std::max(0., area) + (imagined ? 60 : 0), imagined ? "imagined" : "seen",
                                 std::max(0., area) + (imagined ? 70 : 0),
                                 imagined || day == 7 ? "imagined" : "partly_seen");
        }
    }
    return file;
}

TEST(Fit, OneTableGivesTheMeanOfEachGroupAndASceneMayNameIt)
{
    const auto file = table_of_two_groups();
    const auto fits = wound::fit_table(wound::read_area_table(file), "areas.csv");
    ASSERT_EQ(fits.size(), 9U);
    const SeriesFit &aged = fits[6], &young = fits[7];
    EXPECT_EQ(aged.series.name, "mean A8");
    EXPECT_EQ(young.series.name, "mean Y8");
    EXPECT_EQ(fits[8].series.name, "mean");
    EXPECT_EQ(aged.series.left_out, 2);
    EXPECT_EQ(young.series.left_out, 3);
    EXPECT_EQ(aged.series.days.size(), 16U); // one wound's edge was seen on day 5
    EXPECT_EQ(young.series.days.size(), 15U);
    EXPECT_LT(aged.models[2].rmse, .03);
    EXPECT_GT(aged.models[0].rmse, .09);
    EXPECT_LT(young.best().curve.theta, 0);
    EXPECT_LT(young.models[2].rmse, .03);
    EXPECT_GT(young.models[1].rmse, .05);
    const double days_apart = wound::half_time(wound::curve_from_areas(file, "mean A8")) -
                              wound::half_time(wound::curve_from_areas(file, "mean Y8"));
    EXPECT_NEAR(days_apart, 2, .5);
    try {
        wound::curve_from_areas(file, "B9");
        ADD_FAILURE() << "an unknown series was accepted";
    } catch (const base::InputError& error) {
        EXPECT_NE(std::string(error.what()).find("mean A8, mean Y8, mean"), std::string::npos)
            << error.what();
    }
    std::filesystem::remove(file);
}

TEST(Fit, ACurveThatNeverStopsGrowingHasNoLargestRatio)
{
    const auto fits = wound::fit_table({series({0, 1, 2, 3, 9}, {1, 1.2, 1.6, 2.2, 10})}, "areas.csv");
    EXPECT_TRUE(wound::fit_to_json(fits)["series"][0]["largest_ratio"].is_null());
}

TEST(Fit, AreasFileGivesACurve)
{
    const auto file = std::filesystem::temp_directory_path() / "cicatrix_fit_test_areas.csv";
    std::ofstream(file) << "day,area\n0,20\n5,12.13\n10,7.36\n20,2.71\n30,1\n";
    EXPECT_NEAR(wound::half_time(wound::curve_from_areas(file)), 6.93, .05); // exp(-day / 10)
    std::filesystem::remove(file);
}

TEST(Fit, PictureShowsTheMeasurements)
{
    const SeriesFit found = fit(sampled({.2251, 1.316, -.361, 0}, 15, 14, .02));
    const cv::Mat3b picture = wound::draw_fit(found);
    EXPECT_EQ(picture.size(), cv::Size(960, 640));
    int dark = 0;
    for (const cv::Vec3b& p : picture)
        dark += p == base::rgb_of(base::palette::ink); // the points' colour
    EXPECT_GT(dark, 14 * 40);
}

} // namespace
