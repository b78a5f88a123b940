// Border, centroid and control points of shapes whose geometry is known.
#include "wound/contour.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace {

using wound::Polyline;

/// An antialiased disk: coverage falls linearly over one texel.
cv::Mat1f disk(int size, cv::Point2d center, double radius)
{
    cv::Mat1f mask(size, size);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const cv::Point2d p((i + .5) * 2 / size - 1, (j + .5) * 2 / size - 1);
            mask(j, i) =
                static_cast<float>(std::clamp((radius - cv::norm(p - center)) * size / 2 + .5, 0., 1.));
        }
    return mask;
}

TEST(Contour, CentroidAndAreaOfADiskAreSubpixel)
{
    const auto moments = wound::moments_of(disk(256, {.1234, -.0567}, .4));
    EXPECT_NEAR(moments.centroid.x, .1234, 1e-4); // a texel is .0078
    EXPECT_NEAR(moments.centroid.y, -.0567, 1e-4);
    EXPECT_NEAR(moments.area, std::numbers::pi * .16, 2e-4);
}

TEST(Contour, BorderOfADiskLiesOnItsCircle)
{
    const Polyline border = wound::border_of(disk(256, {.1, -.2}, .45));
    for (cv::Point2d p : border)
        EXPECT_NEAR(cv::norm(p - cv::Point2d(.1, -.2)), .45, 8e-4); // a tenth of a texel
    EXPECT_GT(wound::signed_area(border), 0);                       // counter-clockwise on screen
    EXPECT_NEAR(wound::signed_area(border), std::numbers::pi * .45 * .45, 1e-3);
}

TEST(Contour, BorderIsOfTheLargestComponentAndClosesAtThePicturesEdge)
{
    cv::Mat1f mask = disk(128, {-.5, -.5}, .1);
    mask = cv::max(mask, disk(128, {.9, .5}, .3)); // cut off by the edge
    const Polyline border = wound::border_of(mask);
    for (cv::Point2d p : border) {
        EXPECT_GT(p.x, .5);
        EXPECT_LE(p.x, 1.01);
    }
    EXPECT_EQ(wound::level_curves(mask).size(), 2U);
}

TEST(Contour, ASingleTexelHasABorder)
{
    cv::Mat1f mask = cv::Mat1f::zeros(64, 64);
    mask(20, 30) = 1;
    const Polyline border = wound::border_of(mask);
    EXPECT_EQ(border.size(), 4U);
    const auto centroid = wound::moments_of(mask).centroid;
    const double spacing = wound::spacing_from_curvature(border, centroid);
    EXPECT_GE(wound::control_points(border, centroid, spacing).size(), 8U);
}

TEST(Contour, EmptyMaskIsRefused)
{
    const cv::Mat1f empty = cv::Mat1f::zeros(16, 16);
    EXPECT_THROW(wound::border_of(empty), std::invalid_argument);
    EXPECT_THROW(wound::moments_of(empty), std::invalid_argument);
}

TEST(Contour, ControlPointsLieOnTheBorderAndOnAGridLine)
{
    const cv::Point2d center(.03, -.05);
    const Polyline border = wound::border_of(disk(512, center, .45));
    const double spacing = .1;
    const Polyline points = wound::control_points(border, center, spacing);
    EXPECT_GE(points.size(), 24U);
    EXPECT_LE(points.size(), 40U);
    int on_a_line = 0;
    for (cv::Point2d p : points) {
        EXPECT_NEAR(cv::norm(p - center), .45, 1e-3);
        const cv::Point2d cell = (p - center) / spacing;
        on_a_line +=
            std::min(std::abs(cell.x - std::round(cell.x)), std::abs(cell.y - std::round(cell.y))) < 1e-6;
    }
    EXPECT_GE(on_a_line,
              static_cast<int>(points.size()) - 16); // the others are midpoints of near-coincident crossings
}

TEST(Contour, NearCoincidentCrossingsAreMerged)
{
    // A square turned by 45 degrees: every x-line meets the border where a y-line does.
    const Polyline diamond{{.4, 0}, {0, -.4}, {-.4, 0}, {0, .4}};
    const double spacing = .1000001;
    const Polyline points = wound::control_points(diamond, {0, 0}, spacing);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(cv::norm(points[i] - points[j]), .2 * spacing);
    EXPECT_NEAR(static_cast<double>(points.size()), 16, 2);
}

TEST(Contour, CountStaysWithinItsBounds)
{
    const Polyline border = wound::border_of(disk(256, {0, 0}, .4));
    EXPECT_LE(wound::control_points(border, {0, 0}, 1e-4).size(), 512U);
    EXPECT_LE(wound::control_points(border, {0, 0}, 1e-300).size(), 512U);
    EXPECT_GE(wound::control_points(border, {0, 0}, 10).size(), 8U);
}

TEST(Contour, SpacingFollowsCurvature)
{
    const Polyline round = wound::border_of(disk(512, {0, 0}, .45));
    cv::Mat1f flower(512, 512);
    for (int j = 0; j < 512; ++j)
        for (int i = 0; i < 512; ++i) {
            const cv::Point2d p((i + .5) / 256 - 1, (j + .5) / 256 - 1);
            const double radius = .36 + .09 * std::cos(11 * std::atan2(p.y, p.x));
            flower(j, i) = static_cast<float>(std::clamp((radius - cv::norm(p)) * 256 + .5, 0., 1.));
        }
    const Polyline lobed = wound::border_of(flower);
    EXPECT_LT(wound::spacing_from_curvature(lobed, {0, 0}),
              .6 * wound::spacing_from_curvature(round, {0, 0}));
}

TEST(Contour, MirroringTheMaskMirrorsTheControlPoints)
{
    cv::Mat1f mask = cv::max(disk(256, {.1, -.1}, .3), disk(256, {-.15, .2}, .25));
    cv::Mat1f mirrored;
    cv::flip(mask, mirrored, 1);
    const auto points_of = [](const cv::Mat1f& m) {
        return wound::control_points(wound::border_of(m), wound::moments_of(m).centroid, .08);
    };
    const Polyline a = points_of(mask), b = points_of(mirrored);
    ASSERT_EQ(a.size(), b.size());
    for (cv::Point2d p : a) {
        double nearest = 1;
        for (cv::Point2d q : b)
            nearest = std::min(nearest, cv::norm(cv::Point2d(-q.x, q.y) - p));
        EXPECT_LT(nearest, 1e-6);
    }
}

} // namespace
