// The colour difference of two pictures, and `cicatrix compare`.
#include "apps/compare/compare.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/color.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using testing::HasSubstr;

const cv::Vec4b skin(210, 160, 140, 255), redder(210, 140, 130, 255), nothing(0, 0, 0, 0);

double difference_of(const cv::Vec4b& a, const cv::Vec4b& b)
{
    const auto lab = [](const cv::Vec4b& c) {
        return base::lab_from_linear(base::linear_from_srgb8({c[0], c[1], c[2]}));
    };
    return base::delta_e2000(lab(a), lab(b));
}

} // namespace

TEST(ColorDifference, IsMeasuredOnTheHeadOnly)
{
    cv::Mat4b a(10, 10, skin), b = a.clone();
    EXPECT_EQ(compare_command::color_difference(a, b).max, 0);
    b(cv::Rect(0, 0, 10, 1)).setTo(redder); // a tenth of the picture
    a(cv::Rect(0, 5, 10, 5)).setTo(nothing);
    const compare_command::ColorDifference difference = compare_command::color_difference(a, b);
    const double step = difference_of(skin, redder);
    EXPECT_GT(step, 3);
    EXPECT_EQ(difference.pixels, 50);
    EXPECT_NEAR(difference.mean, step / 5, 1e-5);
    EXPECT_NEAR(difference.max, step, 1e-5);
    EXPECT_NEAR(difference.percentile_95, step, 1e-5);
    EXPECT_EQ(difference.map(0, 3), float(step));
    EXPECT_EQ(difference.map(1, 3), 0);
    EXPECT_EQ(cv::countNonZero(difference.head), 50);
}

TEST(ColorDifference, OfPicturesWithoutAHeadIsZero)
{
    const cv::Mat4b empty(4, 4, nothing);
    const compare_command::ColorDifference difference = compare_command::color_difference(empty, empty);
    EXPECT_EQ(difference.pixels, 0);
    EXPECT_EQ(difference.mean + difference.max + difference.percentile_95, 0);
}

TEST(Compare, MeasuresTheDifferenceAndRefusesOtherSizesAndDays)
{
    const TemporaryFolder folder;
    const std::string head = "\"head\": \"" + small::saved(small::head()).string() + "\", ";
    const auto scene = [&](const char* name, const std::string& rest) {
        return folder.with(name, "{ " + head + rest + " }").string();
    };
    const std::string size = "\"size\": \"96x96\", \"days\": [0, 9]";
    const std::string a = scene("a.json", size),
                      b = scene("b.json", size + R"(, "shading": { "rho_d": 0.7 })"),
                      large = scene("large.json", R"("size": "64x64", "days": [0, 9])"),
                      other = scene("other.json", R"("size": "96x96", "days": [0])");
    const auto compare = [&](const std::string& second) {
        return run_program({"compare", a, second, "--rounds", "1", "--out", (folder / "out").string()});
    };
    const auto read = [&] { return nlohmann::json::parse(std::ifstream(folder / "out" / "compare.json")); };

    Outcome outcome = compare(a);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(read()["days"][1]["delta_e2000"]["max"], 0) << "a scene equals itself";

    outcome = compare(b);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json record = read();
    ASSERT_EQ(record["days"].size(), 2u);
    EXPECT_GT(record["days"][0]["head_pixels"], 1000);
    EXPECT_GT(record["days"][0]["delta_e2000"]["mean"], .1);
    EXPECT_GT(record["cost"]["forward_b_over_a"], 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / "compare.png"));

    for (const auto& [second, says] : {std::pair(large, "size"), {other, "days"}}) {
        outcome = compare(second);
        EXPECT_NE(outcome.code, 0);
        EXPECT_THAT(outcome.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    }
}
