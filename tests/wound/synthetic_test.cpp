#include "wound/synthetic/synthetic.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"

namespace {

using wound::Photograph;
using wound::SyntheticWound;

bool same(const cv::Mat& a, const cv::Mat& b)
{
    return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

cv::Vec3d mean_linear(const Photograph& photo, const cv::Mat1b& where)
{
    cv::Vec3d sum;
    double count = 0;
    for (int y = 0; y < where.rows; ++y)
        for (int x = 0; x < where.cols; ++x)
            if (where(y, x)) {
                for (int k = 0; k < 3; ++k)
                    sum[k] += base::srgb_to_linear(float(photo.srgb(y, x)[k]) / 255);
                ++count;
            }
    return sum / count;
}

/// Pixels outside the mask at a distance from it between two bounds, mm.
cv::Mat1b ring(const Photograph& photo, double from_mm, double to_mm)
{
    cv::Mat1f distance;
    cv::distanceTransform(~photo.mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    distance *= wound::synthetic_width_mm / photo.mask.cols;
    return (distance > from_mm) & (distance <= to_mm);
}

double share(const Photograph& photo, bool (*is_it)(const cv::Vec3b&))
{
    int hits = 0;
    for (int y = 0; y < photo.mask.rows; ++y)
        for (int x = 0; x < photo.mask.cols; ++x)
            hits += photo.mask(y, x) && is_it(photo.srgb(y, x));
    return double(hits) / cv::countNonZero(photo.mask);
}

bool is_clot(const cv::Vec3b& c)
{
    return c[0] < 105 && c[1] < 60;
}
bool is_fibrin(const cv::Vec3b& c)
{
    return c[1] > 100 && c[1] - c[2] > 18;
}

SyntheticWound small(const std::string& kind = "abrasion", std::uint32_t seed = 1)
{
    SyntheticWound wound;
    wound.kind = kind;
    wound.seed = seed;
    wound.size = 256;
    return wound;
}

class EveryKind : public testing::TestWithParam<std::string>
{
};
INSTANTIATE_TEST_SUITE_P(SyntheticWound, EveryKind, testing::ValuesIn(wound::kind_names()),
                         [](const auto& kind) { return kind.param; });

TEST_P(EveryKind, IsTheSameBitByBitForTheSameSeed)
{
    const Photograph a = synthesize(small(GetParam())), b = synthesize(small(GetParam()));
    EXPECT_TRUE(same(a.srgb, b.srgb));
    EXPECT_TRUE(same(a.mask, b.mask));
}

TEST_P(EveryKind, DiffersInOutlineAndTissueForAnotherSeed)
{
    const Photograph a = synthesize(small(GetParam(), 1)), b = synthesize(small(GetParam(), 2));
    const double overlap = double(cv::countNonZero(a.mask & b.mask)) / cv::countNonZero(a.mask | b.mask);
    EXPECT_LT(overlap, .93);
    EXPECT_GT(cv::norm(a.srgb, b.srgb, cv::NORM_L1, a.mask & b.mask) / cv::countNonZero(a.mask & b.mask) / 3,
              8);
}

TEST_P(EveryKind, HasOneRegionWithoutHolesAwayFromTheFrame)
{
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        const Photograph photo = synthesize(small(GetParam(), seed));
        cv::Mat1i labels;
        EXPECT_EQ(cv::connectedComponents(photo.mask, labels, 4), 2) << "seed " << seed;
        EXPECT_EQ(cv::connectedComponents(~photo.mask, labels, 8), 2) << "seed " << seed;
        const cv::Rect box = cv::boundingRect(photo.mask);
        EXPECT_GT(std::min({box.x, box.y, 256 - box.br().x, 256 - box.br().y}), 20) << "seed " << seed;
        const double share_of_picture = double(cv::countNonZero(photo.mask)) / photo.mask.total();
        EXPECT_GT(share_of_picture, .02) << "seed " << seed;
        EXPECT_LT(share_of_picture, .25) << "seed " << seed;
    }
}

TEST_P(EveryKind, HasTheSameWoundAtEverySize)
{
    SyntheticWound large = small(GetParam());
    large.size = 512;
    cv::Mat1b reduced;
    cv::resize(synthesize(large).mask, reduced, {256, 256}, 0, 0, cv::INTER_AREA);
    const cv::Mat1b mask = synthesize(small(GetParam())).mask;
    reduced = reduced > 127;
    EXPECT_GT(double(cv::countNonZero(mask & reduced)) / cv::countNonZero(mask | reduced), .93);
}

TEST(SyntheticWound, HasARaggedBorder)
{
    const Photograph photo = synthesize(small());
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(photo.mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
    std::vector<cv::Point> hull;
    cv::convexHull(contours[0], hull);
    EXPECT_GT(cv::arcLength(contours[0], true) / cv::arcLength(hull, true), 1.10); // an ellipse has 1.00
}

TEST(SyntheticWound, HasARedBedOfManyTints)
{
    const Photograph photo = synthesize(small());
    const cv::Vec3d bed = mean_linear(photo, photo.mask);
    EXPECT_GT(bed[0], 2.5 * bed[1]);
    EXPECT_GT(bed[0], 2.5 * bed[2]);
    cv::Scalar mean, deviation;
    cv::meanStdDev(photo.srgb, mean, deviation, photo.mask);
    EXPECT_GT(deviation[0], 20); // of 255
    EXPECT_GT(deviation[1], 20);
}

TEST(SyntheticWound, ReddensTheSkinAroundItAndLeavesFarSkinAlone)
{
    SyntheticWound wound = small();
    wound.skin = {150, 104, 80};
    const Photograph photo = synthesize(wound);
    const cv::Vec3d near = mean_linear(photo, ring(photo, .5, 2.5)),
                    far = mean_linear(photo, ring(photo, 12, 40));
    EXPECT_LT(near[1] / near[0], .75 * far[1] / far[0]);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(far[k] / base::srgb_to_linear(float(wound.skin[k]) / 255), 1, .06);
}

TEST(SyntheticWound, GivesClotAndFibrinTheirShares)
{
    SyntheticWound none = small(), much_clot = small(), much_fibrin = small();
    none.clot = none.fibrin = 0;
    much_clot.clot = .6f, much_clot.fibrin = 0;
    much_fibrin.fibrin = .6f, much_fibrin.clot = 0;
    const Photograph plain = synthesize(none);
    EXPECT_LT(share(plain, is_clot), .12); // shadows and crust at the wall
    EXPECT_LT(share(plain, is_fibrin), .01);
    EXPECT_NEAR(share(synthesize(much_clot), is_clot), .6, .15);
    EXPECT_NEAR(share(synthesize(much_fibrin), is_fibrin), .5, .2);
}

TEST(SyntheticWound, WorksAtItsSmallestSize)
{
    SyntheticWound wound = small();
    wound.size = 64;
    const Photograph photo = synthesize(wound);
    EXPECT_EQ(photo.srgb.size(), cv::Size(64, 64));
    EXPECT_GT(cv::countNonZero(photo.mask), 200);
}

} // namespace
