// Statistics of samples: known answers, and how often a comparison gives a false alarm.
#include "base/statistics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

/// Frame times like those of a real machine: neighbours are correlated, 5 % of the frames take twice as long.
std::vector<double> frame_times(std::uint64_t seed, double middle, std::size_t count = 60)
{
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 0.03);
    std::bernoulli_distribution hiccup(0.05);
    std::vector<double> times;
    double slow = 0;
    for (std::size_t i = 0; i < count; ++i) {
        slow = 0.6 * slow + noise(random);
        times.push_back(middle * std::exp(slow) * (hiccup(random) ? 2 : 1));
    }
    return times;
}

} // namespace

TEST(Statistics, QuantilesAreLinearBetweenSamples)
{
    EXPECT_EQ(base::quantile({3, 1, 2}, 0), 1);
    EXPECT_EQ(base::quantile({3, 1, 2}, 0.5), 2);
    EXPECT_EQ(base::quantile({3, 1, 2}, 1), 3);
    EXPECT_DOUBLE_EQ(base::quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(base::quantile({0, 10}, 0.05), 0.5);
    EXPECT_EQ(base::quantile({7}, 0.95), 7);
    EXPECT_FALSE(base::spread_of({}));
}

TEST(Statistics, EqualDistributionsAreSeldomCalledDifferent)
{
    int missed = 0;
    constexpr int trials = 80;
    for (std::uint64_t i = 0; i < trials; ++i) {
        const auto interval =
            base::ratio_of_medians(frame_times(2 * i + 1, 10), frame_times(2 * i + 2, 10), 0.05);
        EXPECT_LE(interval.low, interval.ratio);
        EXPECT_GE(interval.high, interval.ratio);
        missed += interval.low > 1 || interval.high < 1;
    }
    EXPECT_LE(missed, trials / 8) << "the interval should miss 1 in 20";
}

TEST(Statistics, ADifferenceLargerThanTheNoiseIsSeen)
{
    for (std::uint64_t i = 0; i < 20; ++i) {
        const auto interval = base::ratio_of_medians(frame_times(i + 1, 10), frame_times(i + 101, 13), 0.01);
        EXPECT_GT(interval.low, 1) << i;
        EXPECT_NEAR(interval.ratio, 1.3, 0.15) << i;
    }
}

TEST(Statistics, DriftComparesTheHalves)
{
    EXPECT_DOUBLE_EQ(base::drift_of(std::vector<double>{2, 2, 2, 3, 3, 3}), 1.5);
    EXPECT_DOUBLE_EQ(base::drift_of(std::vector<double>{3, 3, 3, 2, 2, 2}), 1.5);
    EXPECT_EQ(base::drift_of(std::vector<double>{5}), 1);
}

TEST(Statistics, PowerLawsAreRecovered)
{
    std::vector<double> x, y;
    for (const double at : {1., 2., 4., 8., 16.}) {
        x.push_back(at);
        y.push_back(3 * std::pow(at, 1.7));
    }
    const auto law = base::fit_power_law(x, y).value();
    EXPECT_NEAR(law.exponent, 1.7, 1e-12);
    EXPECT_NEAR(law.factor, 3, 1e-11);
    EXPECT_NEAR(law.standard_error, 0, 1e-9);
    EXPECT_NEAR(law.at(32), 3 * std::pow(32, 1.7), 1e-7);

    // By hand: ln y = 0, 1, 1 at ln x = 0, 1, 2 has slope 1/2 and residuals -1/6, 1/3, -1/6, so
    // s = sqrt(1/6 / 2).
    const double e = std::exp(1);
    const auto rough = base::fit_power_law(std::vector{1., e, e * e}, std::vector{1., e, e}).value();
    EXPECT_NEAR(rough.exponent, 0.5, 1e-12);
    EXPECT_NEAR(rough.standard_error, std::sqrt(1. / 12), 1e-12);

    EXPECT_EQ(base::fit_power_law(std::vector{0., 1., 2., 4.}, std::vector{9., 1., 2., 4.})->points, 3u)
        << "x = 0 has no logarithm";
    EXPECT_FALSE(base::fit_power_law(std::vector{1., 1., 2.}, std::vector{1., 1., 2.}));
}

TEST(Statistics, NonDominatedPointsAreThoseThatNoOtherBeats)
{
    const std::vector<double> cost{5, 1, 3, 2, 3, 9, 1}, error{1, 8, 2, 9, 2, 1, 8};
    EXPECT_EQ(base::non_dominated(cost, error),
              (std::vector<std::size_t>{1, 2, 0})); // equal points once only
    EXPECT_TRUE(base::non_dominated({}, {}).empty());
}
