// The warp ladder: area, folds, fixed points, agreement between the models.
#include "wound/warp/warp.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tools/lab/warp_ladder.hpp"

namespace {

using testing::HasSubstr;
using wound::Polyline;
using wound::Warp;
using wound::WarpModel;

struct Shape
{
    std::string name;
    Polyline border;
    cv::Point2d centroid;
    wound::ContractionFlow flow;
};

const std::vector<Shape>& shapes()
{
    static const std::vector<Shape> all = [] {
        std::vector<Shape> result;
        for (const auto& [name, border, centroid] : lab::ladder_shapes()) {
            const auto points =
                wound::control_points(border, centroid, wound::spacing_from_curvature(border, centroid));
            result.push_back({name, border, centroid, wound::prepare_flow(border, points, centroid)});
        }
        return result;
    }();
    return all;
}

/// Area in which a backward warp shows the inside of `border`, from fine samples around the wound of today.
double warped_area(const Shape& shape, const Warp& warp)
{
    constexpr int mask_size = 4096, sample_count = 400, subpixel_bits = 6;
    cv::Mat1b inside = cv::Mat1b::zeros(mask_size, mask_size);
    std::vector<cv::Point> vertices;
    double reach = 0;
    for (cv::Point2d p : shape.border) {
        const cv::Point2d pixel = (p + cv::Point2d(1, 1)) * (mask_size / 2) - cv::Point2d(.5, .5);
        vertices.emplace_back(cvRound(pixel.x * (1 << subpixel_bits)), cvRound(pixel.y * (1 << subpixel_bits)));
        reach = std::max(reach, cv::norm(p - shape.centroid));
    }
    cv::fillPoly(inside, std::vector{vertices}, 1, cv::LINE_8, subpixel_bits);
    reach *= 1.1 * warp.scale;
    std::vector<int> count(sample_count, 0);
    cv::parallel_for_({0, sample_count}, [&](const cv::Range& rows) {
        for (int j = rows.start; j < rows.end; ++j)
            for (int i = 0; i < sample_count; ++i) {
                const cv::Point2d unit((i + .5) / sample_count * 2 - 1, (j + .5) / sample_count * 2 - 1);
                const cv::Point2d p =
                    (warp.apply(shape.centroid + reach * unit) + cv::Point2d(1, 1)) * (mask_size / 2);
                if (p.x >= 0 && p.y >= 0 && p.x < mask_size && p.y < mask_size)
                    count[j] += inside(static_cast<int>(p.y), static_cast<int>(p.x));
            }
    });
    return std::accumulate(count.begin(), count.end(), 0.) * 4 * reach * reach / sample_count / sample_count;
}

TEST(Warp, DefaultIsTheIdentity)
{
    EXPECT_EQ(Warp{}.apply({.3, -.7}), cv::Point2d(.3, -.7));
}

TEST(Warp, ControlPointsFollowEquationOne)
{
    for (const Shape& shape : shapes())
        for (double r : {1.2, .6, .05})
            for (WarpModel model : {WarpModel::Dense, WarpModel::Composed}) {
                const Warp warp = wound::make_warp(shape.flow, r, model);
                for (cv::Point2d control : shape.flow.control_points) {
                    const cv::Point2d offset = control - shape.centroid;
                    const cv::Point2d today = control - offset * (1 - std::sqrt(r)); // d_n = D_n (1 - sqrt r)
                    EXPECT_LT(cv::norm(warp.apply(today) - control), 1e-7) << shape.name << " " << r;
                }
            }
}

TEST(Warp, WarpedAreaIsTheRatioOnEveryFoldFreeModel)
{
    for (const Shape& shape : shapes())
        for (WarpModel model : {WarpModel::Radial, WarpModel::Grid})
        { // composed: within a quarter texel of grid, tested below
            const double day0 = warped_area(shape, Warp{});
            EXPECT_NEAR(day0 / wound::signed_area(shape.border), 1,
                        .025); // filling includes the pixels of the outline
            for (double r : {.9, .6, .4, .2, .1, .05}) {
                const double ratio = warped_area(shape, wound::make_warp(shape.flow, r, model)) / day0;
                EXPECT_NEAR(ratio / r, 1, .02)
                    << shape.name << " " << r << " model " << static_cast<int>(model);
                EXPECT_NEAR(ratio, r, .005) << shape.name;
            }
        }
}

TEST(Warp, NeverFoldsDownToOnePercent)
{
    for (const Shape& shape : shapes())
        for (double r : {1.4, .4, .05, .01})
            for (WarpModel model : {WarpModel::Radial, WarpModel::Grid}) {
                if (r > 1 && shape.name == "near the frame")
                    continue; // it would grow out of the patch
                const auto check = wound::check_folds(wound::make_warp(shape.flow, r, model), 512);
                EXPECT_EQ(check.folded_texels, 0)
                    << shape.name << " " << r << " model " << static_cast<int>(model);
                EXPECT_GT(check.least_jacobian, 0);
            }
    for (const Shape& shape : shapes())
        EXPECT_EQ(
            wound::check_folds(wound::make_warp(shape.flow, .01, WarpModel::Composed), 100).folded_texels, 0)
            << shape.name;
}

TEST(Warp, OneThinPlateStepFoldsWhichIsWhyStepsAreComposed)
{
    const auto check =
        wound::check_folds(wound::make_warp(shapes().front().flow, .01, WarpModel::Dense), 128);
    EXPECT_GT(check.folded_texels, 1000);
}

TEST(Warp, GridIsWithinAQuarterTexelOfTheComposedMap)
{
    for (const Shape& shape : shapes())
        for (double r : {1.2, .4, .05, .01}) {
            const cv::Mat2d exact =
                wound::backward_map(wound::make_warp(shape.flow, r, WarpModel::Composed), 80);
            const cv::Mat2d grid = wound::backward_map(wound::make_warp(shape.flow, r, WarpModel::Grid), 80);
            double worst = 0;
            for (int j = 0; j < 80; ++j)
                for (int i = 0; i < 80; ++i)
                    worst = std::max(worst, cv::norm(exact(j, i) - grid(j, i)));
            EXPECT_LE(worst * 256, .25) << shape.name << " " << r; // texels of 512
        }
}

TEST(Warp, FrameAndCentroidDoNotMove)
{
    for (const Shape& shape : shapes())
        for (double r : {1.2, .6, .05})
            for (WarpModel model : {WarpModel::Radial, WarpModel::Grid, WarpModel::Composed}) {
                const Warp warp = wound::make_warp(shape.flow, r, model);
                EXPECT_LT(cv::norm(warp.apply(shape.centroid) - shape.centroid), .03 * .45) << shape.name;
                for (double t = -1; t <= 1; t += .01)
                    for (cv::Point2d p : {cv::Point2d(t, -1), {t, 1}, {-1, t}, {1, t}})
                        EXPECT_LT(cv::norm(warp.apply(p) - p) * 256, .75)
                            << shape.name << " " << r; // texels of 512
            }
}

TEST(Warp, ACrescentStaysWithinTheHullOfItsDayZero)
{
    const Shape& crescent = shapes()[3];
    ASSERT_EQ(crescent.name, "crescent");
    std::vector<cv::Point2f> border, hull;
    for (cv::Point2d p : crescent.border)
        border.emplace_back(p);
    cv::convexHull(border, hull);
    for (double r : {.6, .2, .05}) {
        const Warp warp = wound::make_warp(crescent.flow, r);
        int covered = 0;
        for (int i = 0; i < 200 * 200; ++i) {
            const cv::Point2d p((i % 200 + .5) / 100 - 1, (i / 200 + .5) / 100 - 1);
            if (cv::pointPolygonTest(border, cv::Point2f(warp.apply(p)), false) < 0)
                continue;
            ++covered;
            EXPECT_GT(cv::pointPolygonTest(hull, cv::Point2f(p), true), -.003) << r; // under a texel of 512
        }
        EXPECT_GT(covered, 20);
    }
}

TEST(Warp, IsContinuousInTheRatio)
{
    // Across a whole number of steps, r = .62^2, the partial step vanishes or a new one appears.
    const auto& flow = shapes()[1].flow;
    const double r = wound::step_scale * wound::step_scale;
    const cv::Mat2d a = wound::backward_map(wound::make_warp(flow, r * (1 - 1e-6), WarpModel::Composed), 32);
    const cv::Mat2d b = wound::backward_map(wound::make_warp(flow, r * (1 + 1e-6), WarpModel::Composed), 32);
    EXPECT_LT(cv::norm(a - b, cv::NORM_INF), 1e-5);
}

TEST(Warp, RatioOneIsTheIdentityAndZeroIsDrawnAsTheSmallest)
{
    for (WarpModel model : {WarpModel::Radial, WarpModel::Grid, WarpModel::Dense, WarpModel::Composed}) {
        const Warp same = wound::make_warp(shapes()[2].flow, 1, model);
        for (cv::Point2d p : {cv::Point2d(.2, .1), {-.8, .7}, {0, 0}})
            EXPECT_LT(cv::norm(same.apply(p) - p), 1e-7);
        EXPECT_EQ(wound::make_warp(shapes()[2].flow, 0, model).scale, wound::smallest_scale);
    }
}

TEST(Warp, CoincidentAndCollinearControlPointsAreSolved)
{
    const Polyline border = shapes().front().border;
    Polyline points = wound::control_points(border, {0, 0}, .1);
    points.push_back(points.front());
    points.push_back(points[1] * (1 - 1e-6));
    const Warp warp = wound::make_warp(wound::prepare_flow(border, points, {0, 0}), .1, WarpModel::Composed);
    for (cv::Point2d p : points)
        EXPECT_LT(cv::norm(warp.apply(p * std::sqrt(.1)) - p), 1e-6);

    const Polyline line{{-.4, 0}, {-.2, 0}, {.2, 0}, {.4, 0}};
    const Warp flat = wound::make_warp(wound::prepare_flow(border, line, {0, 0}), .1, WarpModel::Composed);
    EXPECT_LT(cv::norm(flat.apply(line[3] * std::sqrt(.1)) - line[3]), 1e-6);
}

TEST(Warp, LadderMeasurementsAreConsistent)
{
    const auto rows = lab::measure_ladder(lab::ladder_shapes().front());
    ASSERT_EQ(rows.size(), std::size(lab::warp_models) * std::size(lab::ladder_ratios));
    for (const lab::LadderRow& row : rows) {
        if (row.model == WarpModel::Composed) {
            EXPECT_EQ(row.error_texels, 0);
        }
        if (row.model != WarpModel::Dense) {
            EXPECT_LT(std::abs(row.area_error), .02) << row.ratio;
        } else if (row.ratio < .02) {
            EXPECT_GT(row.folded_texels, 0);
        }
    }
    EXPECT_EQ(lab::cheapest_exact(rows), WarpModel::Grid);
}

/// Rows with numbers that encode their ratio and model.
std::vector<lab::LadderRow> numbered_rows()
{
    std::vector<lab::LadderRow> rows;
    for (const char* shape : {"circle", "a \"mask\", mine"})
        for (const double ratio : lab::ladder_ratios)
            for (const WarpModel model : lab::warp_models) {
                lab::LadderRow row{shape, model, ratio};
                row.error_texels = model == WarpModel::Composed ? 0 : 10 * ratio + int(model);
                row.least_jacobian = ratio;
                row.ms_per_megatexel = 10 * (1 + int(model));
                rows.push_back(row);
            }
    rows[2].folded_texels = 26214; // dense, at 1.2, of the circle
    rows[2].least_jacobian = -2;
    return rows;
}

TEST(Warp, LadderIsWrittenCompletely)
{
    const std::vector<lab::LadderRow> rows = numbered_rows();
    const std::string csv = lab::ladder_csv(rows), tables = lab::ladder_tables(rows);
    EXPECT_EQ(std::ranges::count(csv, '\n'), std::ssize(rows) + 1);
    EXPECT_THAT(csv, HasSubstr("\n\"circle\",dense,1.2,14,0,0,26214,-2,0,30\n"));
    EXPECT_THAT(csv, HasSubstr("\n\"a \"\"mask\"\", mine\",grid,0.01,1.1,0,0,0,0.01,0,20\n"));
    EXPECT_THAT(tables, HasSubstr("| grid | 0.4 | 5.000 | 5.000 |\n"));         // error
    EXPECT_THAT(tables, HasSubstr("| dense | 1.2 | -2.000, 10 % | 1.200 |\n")); // Jacobian
    EXPECT_THAT(tables, HasSubstr("| composed | 0.01 | 2.00 | 2.00 |\n"));      // cost
    EXPECT_THAT(lab::ladder_summary(rows),
                HasSubstr("| dense | 14.000 | 0.000 | 0.00 | 26214 | -2.000 | 0.0 .. 0.0 | 30 .. 30 |\n"));
}

TEST(Warp, CheapestExactModelNeitherErrsNorFolds)
{
    std::vector<lab::LadderRow> rows = numbered_rows();
    EXPECT_EQ(lab::cheapest_exact(rows), WarpModel::Composed);
    for (lab::LadderRow& row : rows)
        row.error_texels = lab::error_limit;
    EXPECT_EQ(lab::cheapest_exact(rows), WarpModel::Radial);
    rows[0].error_texels = .26; // one row of radial
    rows[1].folded_texels = 1;  // one of grid, one of dense above
    EXPECT_EQ(lab::cheapest_exact(rows), WarpModel::Composed);
    rows[3].folded_texels = 1;
    EXPECT_EQ(lab::cheapest_exact(rows), std::nullopt);
}

TEST(Warp, PictureOfTheLadderShowsTheFold)
{
    const cv::Mat3b picture = lab::draw_ladder(numbered_rows());
    EXPECT_EQ(picture.size(), cv::Size(1200, 240)); // two panels and the legend
    cv::Mat1b red;
    cv::inRange(picture, cv::Scalar(225, 40, 40), cv::Scalar(225, 40, 40), red);
    EXPECT_GT(cv::countNonZero(red(cv::Rect(0, 0, 300, 240))), 40);
    EXPECT_EQ(cv::countNonZero(red(cv::Rect(300, 0, 300, 240))), 0);
}

TEST(Warp, PackedLayoutHoldsEveryNumberInOrder)
{
    std::vector<shared::vec2> values{{9, 9}};
    const Warp composed = wound::make_warp(shapes()[0].flow, .3, WarpModel::Composed);
    const auto header = wound::pack(composed, values);
    EXPECT_EQ(header.first, 1U);
    EXPECT_EQ(header.steps, composed.steps.size());
    ASSERT_EQ(values.size(), 1 + composed.steps.size() * (3 + 2 * header.count));
    EXPECT_FLOAT_EQ(values[1 + 3 + 2 * header.count].x, static_cast<float>(composed.steps[1].affine[0].x));

    const Warp grid = wound::make_warp(shapes()[0].flow, .3, WarpModel::Grid);
    const auto second = wound::pack(grid, values);
    EXPECT_EQ(second.first + second.count + second.count * second.count, values.size());
    EXPECT_FLOAT_EQ(values[second.first].x, -1);
    EXPECT_FLOAT_EQ(values[second.first + second.count + 1].x, static_cast<float>(grid.grid(0, 1)[0]));
}

} // namespace
