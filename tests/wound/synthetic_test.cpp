#include "wound/synthetic/synthetic.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "wound/depth.hpp"

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

bool is_fat(const cv::Vec3b& c)
{
    return c[0] > 185 && c[1] > 125 && c[1] - c[2] > 25;
}

SyntheticWound small(const std::string& kind = "avulsion", std::uint32_t seed = 1)
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
    EXPECT_TRUE(same(a.layer, b.layer));
}

TEST_P(EveryKind, DiffersInOutlineAndTissueForEachOfEightSeeds)
{
    std::vector<Photograph> photos;
    for (std::uint32_t seed = 1; seed <= 8; ++seed)
        photos.push_back(synthesize(small(GetParam(), seed)));
    for (std::size_t i = 0; i < photos.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const Photograph &a = photos[i], &b = photos[k];
            const cv::Mat1b both = a.mask & b.mask;
            const double overlap = double(cv::countNonZero(both)) / cv::countNonZero(a.mask | b.mask);
            EXPECT_LT(overlap, .95) << i + 1 << ", " << k + 1;
            EXPECT_GT(cv::norm(a.srgb, b.srgb, cv::NORM_L1, both) / cv::countNonZero(both) / 3, 8)
                << i + 1 << ", " << k + 1;
        }
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
    const Photograph photo = synthesize(small("ulcer"));
    const cv::Vec3d bed = mean_linear(photo, photo.mask);
    EXPECT_GT(bed[0], 2.5 * bed[1]);
    EXPECT_GT(bed[0], 2.5 * bed[2]);
    cv::Scalar mean, deviation;
    cv::meanStdDev(photo.srgb, mean, deviation, photo.mask);
    EXPECT_GT(deviation[0], 10); // of 255
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

// What each kind is made of: shares of the bed by colour, mean over four seeds.
TEST(SyntheticWound, HasTheTissueOfItsKind)
{
    const auto mean_share = [](const char* kind, bool (*is_it)(const cv::Vec3b&)) {
        double sum = 0;
        for (std::uint32_t seed = 1; seed <= 4; ++seed)
            sum += share(synthesize(small(kind, seed)), is_it) / 4;
        return sum;
    };
    EXPECT_NEAR(mean_share("ulcer", is_fibrin), .35, .17) << "slough";
    EXPECT_GT(mean_share("excision", is_fat), .25);
    EXPECT_GT(mean_share("avulsion", is_fat), .08);
    EXPECT_GT(mean_share("punch", is_clot), .2) << "blood in the hole";
    EXPECT_GT(mean_share("laceration", is_clot), .1);
    for (const char* kind : {"abrasion", "burn"})
        EXPECT_LT(mean_share(kind, is_clot), .05) << kind;
    EXPECT_LT(mean_share("ulcer", is_fat), .05);
}

/// Depth in mm on a cheek at the pixels of the bed, sorted.
std::vector<float> bed_depths(const Photograph& photo)
{
    const cv::Mat1f depth = wound::depth_of_layers(photo.layer, {});
    std::vector<float> values;
    for (int y = 0; y < depth.rows; ++y)
        for (int x = 0; x < depth.cols; ++x)
            if (photo.mask(y, x))
                values.push_back(depth(y, x));
    std::ranges::sort(values);
    return values;
}

TEST(SyntheticWound, IsAsDeepAsItsKind)
{
    struct Range
    {
        const char* kind;
        double shallowest, deepest; // of the depth that a tenth of the bed exceeds, mm
    };
    for (const Range& range : {Range{"abrasion", .1, .4},
                               {"burn", .15, .4},
                               {"laceration", 1.5, 3.2},
                               {"avulsion", 1.8, 3.2},
                               {"excision", 1.8, 3},
                               {"punch", 2.2, 3.5},
                               {"ulcer", 1, 2}})
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            const std::vector<float> depths = bed_depths(synthesize(small(range.kind, seed)));
            const float deep = depths[depths.size() * 9 / 10];
            EXPECT_GT(deep, range.shallowest) << range.kind << " " << seed;
            EXPECT_LT(deep, range.deepest) << range.kind << " " << seed;
        }
}

/// Mean depth in mm at a distance of .5 to 1 mm inside the border.
double depth_of_wall(const Photograph& photo)
{
    cv::Mat1f inward;
    cv::distanceTransform(photo.mask, inward, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    inward *= wound::synthetic_width_mm / photo.mask.cols;
    return cv::mean(wound::depth_of_layers(photo.layer, {}), (inward > .5) & (inward < 1))[0];
}

TEST(SyntheticWound, HasNoWallWhereSkinIsScrapedAndAnUprightOneWhereItIsCut)
{
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        EXPECT_LT(depth_of_wall(synthesize(small("abrasion", seed))), .12);
        EXPECT_GT(depth_of_wall(synthesize(small("punch", seed))),
                  2 * depth_of_wall(synthesize(small("ulcer", seed))));
    }
}

TEST(SyntheticWound, AnAvulsionHasARaisedFlapOnOneSide)
{
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const Photograph photo = synthesize(small("avulsion", seed));
        const cv::Mat1b raised = wound::depth_of_layers(photo.layer, {}) < -.75;
        const double share_of_ring =
            double(cv::countNonZero(raised & ring(photo, .4, 2))) / cv::countNonZero(ring(photo, .4, 2));
        EXPECT_GT(share_of_ring, .08) << seed;
        EXPECT_LT(share_of_ring, .5) << seed;
    }
}

// Closing days at the usual width on soft tissue; the sources stand beside the kinds.
TEST(SyntheticWound, ClosesInTheTimeOfItsKind)
{
    struct Days
    {
        const char* kind;
        double width_mm, first, last;
    };
    for (const Days& days : {Days{"abrasion", 30, 8, 12},
                             {"laceration", 34, 10, 14},
                             {"burn", 30, 10, 21},
                             {"avulsion", 30, 21, 40},
                             {"excision", 30, 21, 35},
                             {"punch", 6, 10, 21},
                             {"ulcer", 30, 60, 120}})
    {
        const double closed =
            wound::closure_day(wound::usual_healing(wound::kind_named(days.kind), days.width_mm, {}).curve);
        EXPECT_GT(closed, days.first) << days.kind;
        EXPECT_LT(closed, days.last) << days.kind;
    }
}

TEST(SyntheticWound, ClosesLaterWhereItIsLargerOrOverBone)
{
    const auto half = [](const char* kind, double width_mm, double subcutis) {
        wound::TissueThickness tissue;
        tissue.subcutis = subcutis;
        return wound::half_time(wound::usual_healing(wound::kind_named(kind), width_mm, tissue).curve);
    };
    EXPECT_NEAR(half("avulsion", 60, 9) / half("avulsion", 30, 9), std::sqrt(2), 1e-6);
    EXPECT_LT(half("abrasion", 60, 9) / half("abrasion", 30, 9), 1.2) << "closes from the hair follicles";
    EXPECT_GT(half("ulcer", 30, 3), 1.1 * half("ulcer", 30, 9));
    EXPECT_EQ(half("abrasion", 30, 3), half("abrasion", 30, 9));
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
