// `cicatrix predict`: a synthetic series with a known healing curve, and invalid series.
#include "apps/predict/predict.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/wound_photographs.hpp"

namespace {

using testing::HasSubstr;
using testing_wounds::ellipse;
using testing_wounds::photograph;

constexpr double healing_rate = .2; // of the drawn wound's area, per day

/// A drifting ellipse with the area ratio exp(-healing_rate day), and a table of areas that lacks day 3.
struct DrawnSeries
{
    TemporaryFolder folder;
    nlohmann::json series{{"areas", "areas.csv"}, {"days", nlohmann::json::array()}};

    DrawnSeries()
    {
        std::string areas = "day,area\n";
        for (int day = 0; day < 6; ++day) {
            const double ratio = std::exp(-healing_rate * day), scale = std::sqrt(ratio);
            const cv::Point center(150 + 4 * day, 120 - 3 * day);
            const auto drawn = photograph({300, 240}, center, ellipse(70 * scale, 45 * scale));
            const std::string name = "day" + std::to_string(day);
            base::write_png(folder / (name + ".png"), drawn.srgb);
            base::write_png(folder / (name + "_mask.png"), drawn.mask);
            if (day != 3)
                areas += std::to_string(day) + "," + std::to_string(40 * ratio) + "\n";
            series["days"].push_back({{"day", day}, {"photo", name + ".png"}});
            if (day % 2 == 0)
                series["days"].back()["mask"] = name + "_mask.png";
            else
                series["days"].back()["segmentation"]["rect"] = {center.x - 90, center.y - 65, 180, 130};
        }
        folder.with("areas.csv", areas);
    }

    predict_command::Prediction predict() const
    {
        return predict_command::predict(folder.with("series.json", series.dump()), folder.path());
    }
    std::string refusal() const
    {
        try {
            predict();
        } catch (const base::InputError& error) {
            return error.what();
        }
        return "accepted";
    }
};

TEST(Predict, AWoundThatHealsAsMeasuredIsFoundAsPredicted)
{
    const predict_command::Prediction prediction = DrawnSeries().predict();
    ASSERT_EQ(prediction.days.size(), 6U);
    EXPECT_FALSE(prediction.days[0].agreement) << "the other days are predicted from it";
    EXPECT_EQ(prediction.days[0].observed_ratio, 1);
    for (const predict_command::PredictedDay& day : prediction.days) {
        const double ratio = std::exp(-healing_rate * day.day);
        EXPECT_NEAR(day.curve_ratio, ratio, .005);
        EXPECT_NEAR(day.observed_ratio, ratio, .04) << day.day;
        EXPECT_EQ(day.traced_ratio.has_value(), day.day != 3);
        if (day.day > 0) {
            ASSERT_TRUE(day.agreement);
            EXPECT_GT(day.agreement->intersection_over_union, .9) << day.day;
            EXPECT_LT(day.agreement->border_distance_px, 2) << day.day;
        }
    }
    EXPECT_THAT(predict_command::to_markdown(prediction), HasSubstr("\n| 3 | - | 0.55 | 0.5"));
}

TEST(Predict, AWoundThatShrankFasterThanPredictedAgreesLess)
{
    DrawnSeries drawn;
    for (auto& day : drawn.series["days"]) // the photographs of two days later
        if (const int number = day["day"]; number > 0 && number < 4) {
            day["photo"] = "day" + std::to_string(number + 2) + ".png";
            day["mask"] = "day" + std::to_string(number + 2) + "_mask.png";
            day.erase("segmentation");
        }
    const predict_command::Prediction prediction = drawn.predict();
    EXPECT_NEAR(prediction.days[2].agreement->intersection_over_union, std::exp(-2 * healing_rate), .04);
    EXPECT_NEAR(prediction.days[2].agreement->area_ratio, std::exp(2 * healing_rate), .06);
}

TEST(Predict, ADayWithoutAVisibleWoundIsReported)
{
    DrawnSeries drawn;
    base::write_png(drawn.folder / "day3.png",
                    photograph({300, 240}, {0, 0}, [](double, double) { return 2.; }).srgb);
    const predict_command::Prediction prediction = drawn.predict();
    EXPECT_THAT(prediction.days[3].not_found, HasSubstr("day3.png: no wound found"));
    EXPECT_FALSE(prediction.days[3].agreement);
    EXPECT_THAT(predict_command::to_markdown(prediction),
                HasSubstr("\n| 3 | - | 0.55 | not found | - | - |\n"));
    const nlohmann::json json = predict_command::to_json(prediction);
    EXPECT_TRUE(json["days"][3]["segmented_ratio"].is_null());
    EXPECT_GT(json["days"][4]["intersection_over_union"], .9);
    EXPECT_EQ(json["fit"]["n"], 5);
}

TEST(Predict, PictureShowsBothOutlines)
{
    const cv::Mat3b picture = predict_command::draw_prediction(DrawnSeries().predict());
    const auto count = [](const cv::Mat3b& part, cv::Scalar color) {
        cv::Mat1b found;
        cv::inRange(part, color, color, found);
        return cv::countNonZero(found);
    };
    const cv::Scalar blue(30, 80, 255);
    const cv::Rect first(6, 44, 200, 160), second(212, 44, 200, 160);
    EXPECT_EQ(count(picture(first), blue), 0);
    EXPECT_GT(count(picture(second), blue), 100);
    EXPECT_GT(count(picture(first), cv::Scalar(255, 255, 255)), 100);
}

TEST(Predict, BrokenSeriesAreRefused)
{
    const auto refused = [](const std::string& pointer, const nlohmann::json& value) {
        DrawnSeries drawn;
        drawn.series[nlohmann::json::json_pointer(pointer)] = value;
        return drawn.refusal();
    };
    EXPECT_THAT(refused("/days/2/day", 1), HasSubstr("series.json: /days/2/day"));
    EXPECT_THAT(refused("/days/2/day", "two"), HasSubstr("/days/2/day"));
    EXPECT_THAT(refused("/days/1", 7), HasSubstr("/days/1"));
    EXPECT_THAT(refused("/days", nlohmann::json::array()), HasSubstr("/days"));
    EXPECT_THAT(refused("/days/1/colour", 1), HasSubstr("colour"));
    EXPECT_THAT(refused("/days/1/mask", "day1_mask.png"), HasSubstr("/days/1/segmentation"));
    EXPECT_THAT(refused("/days/1/photo", "none.png"), HasSubstr("none.png"));
    EXPECT_THAT(refused("/days/2/mask", "none.png"), HasSubstr("none.png"));
    EXPECT_THAT(refused("/days/1/segmentation/rect", {200, 100, 180, 130}), HasSubstr("day1.png: the rect"));
    EXPECT_THAT(refused("/areas", "none.csv"), HasSubstr("none.csv"));
    EXPECT_THAT(refused("/series", "another"), HasSubstr("another"));
    EXPECT_THAT(refused("/days/0/mask", "day1_mask.png"), HasSubstr("accepted"));
}

TEST(Predict, AFirstDayWithoutAWoundIsRefused)
{
    DrawnSeries drawn;
    base::write_png(drawn.folder / "day0.png", cv::Mat3b(240, 300, cv::Vec3b(200, 160, 140)));
    drawn.series["days"][0].erase("mask");
    EXPECT_THAT(drawn.refusal(), HasSubstr("day0.png: no wound found"));
}

} // namespace
