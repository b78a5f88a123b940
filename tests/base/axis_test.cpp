// The axes of a chart: ticks and their labels.
#include "base/axis.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include "base/draw_text.hpp"

namespace {

using base::Scale;
using base::Tick;

double label_extent(const std::string& label)
{
    return base::text_width(label, 9);
}

/// Whether `value` is 1, 2 or 5 times a power of ten.
bool is_round(double value)
{
    const double mantissa = value / std::pow(10, std::floor(std::log10(value) + 1e-9));
    return std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6;
}

void expect_inside_and_apart(const std::vector<Tick>& ticks, const Scale& scale, double gap)
{
    const double slack = 1e-6 * (scale.high - scale.low);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_GE(ticks[i].value, scale.low - slack);
        EXPECT_LE(ticks[i].value, scale.high + slack);
        EXPECT_NEAR(std::stod(ticks[i].label), ticks[i].value, 1e-6 * (scale.high - scale.low));
        if (i > 0) {
            EXPECT_GE(std::abs(ticks[i].at - ticks[i - 1].at),
                      (label_extent(ticks[i].label) + label_extent(ticks[i - 1].label)) / 2 + gap);
        }
    }
}

TEST(Axis, TicksAreRoundAndInsideTheRange)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-6, 9), share(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const double size = std::pow(10, exponent(random)), low = size * share(random);
        const Scale scale{low, low + size * (1.1 + share(random)), false, 0, 700};
        const std::vector<Tick> ticks = base::round_ticks(scale, label_extent, 40);
        SCOPED_TRACE(testing::Message() << scale.low << " to " << scale.high);
        ASSERT_GE(ticks.size(), 2u);
        const double step = ticks[1].value - ticks[0].value;
        EXPECT_TRUE(is_round(step)) << step;
        for (const Tick& tick : ticks)
            EXPECT_NEAR(std::remainder(tick.value, step), 0, 1e-6 * step);
        expect_inside_and_apart(ticks, scale, 40);
    }
}

TEST(Axis, LogarithmicTicksAreRoundToo)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> exponent(-6, 6), decades(1, 12);
    for (int i = 0; i < 2000; ++i) {
        const double low = std::pow(10, exponent(random));
        const Scale scale{low, low * std::pow(10, decades(random)), true, 0, 700};
        const std::vector<Tick> ticks = base::round_ticks(scale, label_extent, 20);
        SCOPED_TRACE(testing::Message() << scale.low << " to " << scale.high);
        ASSERT_GE(ticks.size(), 3u);
        for (const Tick& tick : ticks)
            EXPECT_TRUE(is_round(tick.value)) << tick.value;
        expect_inside_and_apart(ticks, scale, 20);
    }
}

TEST(Axis, ALogarithmicAxisOfLessThanADecadeHasTicks)
{
    for (const auto& [low, high] : {std::pair(.8, 1.25), {11., 19.}, {210., 480.}, {1.01, 1.02}}) {
        const Scale scale{low, high, true, 0, 700};
        const std::vector<Tick> ticks = base::round_ticks(scale, label_extent, 20);
        EXPECT_GE(ticks.size(), 3u) << low;
        expect_inside_and_apart(ticks, scale, 20);
    }
}

TEST(Axis, LabelsOfTicksAreShort)
{
    const auto labels = [](const Scale& scale) {
        std::vector<std::string> result;
        for (const Tick& tick : base::round_ticks(scale, label_extent, 60))
            result.push_back(tick.label);
        return result;
    };
    EXPECT_THAT(labels({-.25, .45, false, 0, 700}),
                testing::ElementsAre("-0.2", "-0.1", "0", "0.1", "0.2", "0.3", "0.4"));
    EXPECT_THAT(labels({1e-5, 1e9, true, 0, 500}), testing::IsSupersetOf({"0.001", "1", "1000", "1e9"}));
}

TEST(Axis, RoundUp)
{
    EXPECT_DOUBLE_EQ(base::round_up(.1), .1);
    EXPECT_DOUBLE_EQ(base::round_up(.11), .2);
    EXPECT_DOUBLE_EQ(base::round_up(3), 5);
    EXPECT_DOUBLE_EQ(base::round_up(50.1), 100);
}

} // namespace
