// Charts: what is drawn, and where.
#include "base/chart.hpp"

#include <gmock/gmock.h>
#include <limits>
#include <random>

#include "base/chart_layout.hpp"
#include "base/label_placement.hpp"

namespace {

using base::Chart;
using testing::HasSubstr;
using testing::Not;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
const cv::Rect2d whole(30, 20, 500, 300);

/// Records the drawing calls.
class Recording : public base::Canvas
{
  public:
    struct Text
    {
        cv::Rect2d box; // from the baseline to the height of a capital
        std::string text;
    };
    std::vector<cv::Rect2d> rects;
    std::vector<cv::Point2d> centers;
    std::vector<std::vector<cv::Point2d>> polylines, polygons;
    std::vector<Text> texts;

    void rect(const cv::Rect2d& area, const base::Fill&, std::string_view) override { rects.push_back(area); }
    void circle(cv::Point2d center, double, const base::Fill&, std::string_view) override
    {
        centers.push_back(center);
    }
    void polyline(const std::vector<cv::Point2d>& points, const base::Stroke&) override
    {
        polylines.push_back(points);
    }
    void polygon(const std::vector<cv::Point2d>& points, const base::Fill&) override
    {
        polygons.push_back(points);
    }
    void text(cv::Point2d at, const std::string& text, const base::TextStyle& style) override
    {
        const double width = base::text_width(text, style.height);
        at.x -= style.anchor == base::Anchor::Start    ? 0
                : style.anchor == base::Anchor::Middle ? width / 2
                                                       : width;
        texts.push_back({{at.x, at.y - style.height, width, style.height}, text});
    }

    const Text& find(const std::string& text) const
    {
        for (const Text& each : texts)
            if (each.text == text)
                return each;
        throw std::runtime_error("no text " + text);
    }
    bool has(const std::string& text) const
    {
        return std::ranges::any_of(texts, [&](const Text& each) { return each.text == text; });
    }
};

Recording drawn(const Chart& chart, const cv::Rect2d& area = whole)
{
    Recording canvas;
    base::draw_chart(canvas, area, chart);
    return canvas;
}

bool inside(const cv::Rect2d& outer, const cv::Rect2d& inner)
{
    constexpr double slack = 1e-6;
    return inner.x >= outer.x - slack && inner.y >= outer.y - slack &&
           inner.x + inner.width <= outer.x + outer.width + slack &&
           inner.y + inner.height <= outer.y + outer.height + slack;
}

bool inside(const cv::Rect2d& outer, const cv::Point2d& p)
{
    return inside(outer, {p.x, p.y, 0, 0});
}

TEST(Chart, ARangeOfNoWidthIsWidened)
{
    for (const bool logarithmic : {false, true}) {
        Chart chart{.x = {.logarithmic = logarithmic}, .y = {.logarithmic = logarithmic}};
        chart.series = {{.points = {{7, 7}}, .radius = 3}};
        const cv::Rect2d plot = base::lay_out(chart, whole).plot;
        const Recording canvas = drawn(chart);
        ASSERT_EQ(canvas.centers.size(), 1u);
        EXPECT_NEAR(canvas.centers[0].x, plot.x + plot.width / 2, 1);
        EXPECT_NEAR(canvas.centers[0].y, plot.y + plot.height / 2, 1);
    }
}

TEST(Chart, NothingIsDrawnOutside)
{
    std::mt19937 random(3);
    std::normal_distribution<double> wide(0, 3);
    for (int round = 0; round < 20; ++round) {
        Chart chart{
            .title = "a title that is far too long for one line and for two, and so it goes on and on",
            .x = {.title = "x", .unit = "mm", .low = -1, .high = 1},
            .y = {.title = "y", .low = -1, .high = 1},
            .references = {{.at = .5, .name = "inside"}, {.at = 5, .name = "outside"}},
            .footnote = "a footnote that is longer than the chart is wide, which is to say more than five "
                        "hundred pixels at nine pixels a capital letter"};
        base::Series series{.legend = "with a long legend", .line_width = 2, .radius = 3};
        for (int i = 0; i < 40; ++i) {
            series.points.emplace_back(wide(random), wide(random));
            series.names.push_back("p" + std::to_string(i));
            series.y_spread.push_back({series.points.back().y - 1, series.points.back().y + 1});
            series.x_spread.push_back({series.points.back().x - 1, series.points.back().x + 1});
        }
        chart.series = {series, series};
        chart.series[1].band = true;
        chart.series[1].path = base::Path::Staircase;
        const Recording canvas = drawn(chart);
        const cv::Rect2d plot = base::lay_out(chart, whole).plot;
        ASSERT_TRUE(inside(whole, plot));
        for (const auto& polyline : canvas.polylines)
            for (const cv::Point2d& p : polyline)
                EXPECT_TRUE(inside(whole, p)) << p;
        for (const auto& polygon : canvas.polygons)
            for (const cv::Point2d& p : polygon)
                EXPECT_TRUE(inside(plot, p)) << p;
        for (const Recording::Text& text : canvas.texts)
            EXPECT_TRUE(inside(whole, text.box)) << text.text << text.box;
        std::size_t visible = 0;
        for (const cv::Point2d& p : series.points)
            visible += std::abs(p.x) <= 1 && std::abs(p.y) <= 1;
        EXPECT_EQ(canvas.centers.size(), 2 * visible + 2); // one more per series in the legend
        EXPECT_TRUE(canvas.has("inside"));
        EXPECT_FALSE(canvas.has("outside"));
    }
}

TEST(Chart, LongNamesOfRowsAndOfTheLegendAreCut)
{
    const std::string long_name(200, 'w');
    for (const auto place : {base::LegendPlace::Above, base::LegendPlace::Right}) {
        const Chart chart{.title = long_name,
                          .x = {.title = long_name},
                          .y = {.title = long_name, .rows = {long_name}},
                          .bars = {{.to = 1, .label = "behind the end"}},
                          .legend_place = place,
                          .legend = {{long_name}, {"short\n" + long_name}},
                          .footnote = long_name};
        const Recording canvas = drawn(chart);
        for (const Recording::Text& text : canvas.texts)
            EXPECT_TRUE(inside(whole, text.box)) << text.text << text.box;
    }
}

TEST(Chart, NamesDoNotOverlap)
{
    std::mt19937 random(4);
    std::normal_distribution<double> narrow(0, .3);
    for (int round = 0; round < 20; ++round) {
        Chart chart{.x = {.low = -1, .high = 1}, .y = {.low = -1, .high = 1}};
        base::Series series{.radius = 4};
        for (int i = 0; i < 25; ++i) {
            series.points.emplace_back(narrow(random), narrow(random));
            series.names.push_back("name of point " + std::to_string(i));
        }
        chart.series = {series};
        chart.references = {{.at = 0, .name = "a limit"},
                            {.along = base::ReferenceLine::Along::Y, .at = .1, .name = "today"}};
        const Recording canvas = drawn(chart);
        std::vector<Recording::Text> names;
        for (const Recording::Text& text : canvas.texts)
            if (text.text.starts_with("name") || text.text == "a limit" || text.text == "today")
                names.push_back(text);
        EXPECT_GT(names.size(), 18u);
        for (std::size_t i = 0; i < names.size(); ++i) {
            for (std::size_t j = i + 1; j < names.size(); ++j)
                EXPECT_EQ((names[i].box & names[j].box).area(), 0)
                    << names[i].text << " on " << names[j].text;
            for (const cv::Point2d& center : canvas.centers)
                EXPECT_EQ((names[i].box & cv::Rect2d(center.x - 4, center.y - 4, 8, 8)).area(), 0)
                    << names[i].text;
        }
    }
}

TEST(Chart, ANameAvoidsLinesWhereItCan)
{
    base::LabelPlacement placement({0, 0, 100, 100});
    placement.rather_not_cover({{0, 15}, {100, 15}});
    const std::vector<cv::Rect2d> candidates{{10, 10, 30, 10}, {10, 40, 30, 10}};
    EXPECT_EQ(placement.place(candidates), candidates[1]);
    EXPECT_EQ(placement.place(candidates), candidates[0]) << "when there is no other place";
    EXPECT_EQ(placement.place(candidates), std::nullopt);
    EXPECT_EQ(placement.place({{90, 80, 30, 10}}), std::nullopt) << "it would lie outside";
}

TEST(Chart, TheLegendHidesNoData)
{
    Chart chart{.title = "title", .y = {.title = "y"}};
    for (int i = 0; i < 9; ++i)
        chart.series.push_back(
            {.legend = "series number " + std::to_string(i), .points = {{0, 0}, {1, 1}}, .line_width = 2});
    for (const auto place : {base::LegendPlace::Above, base::LegendPlace::Right}) {
        chart.legend_place = place;
        const cv::Rect2d plot = base::lay_out(chart, whole).plot;
        const Recording canvas = drawn(chart);
        for (int i = 0; i < 9; ++i) {
            const Recording::Text& text = canvas.find("series number " + std::to_string(i));
            EXPECT_EQ((text.box & plot).area(), 0);
            for (const Recording::Text& other : canvas.texts)
                EXPECT_TRUE(&other == &text || (other.box & text.box).area() == 0) << other.text;
        }
    }
}

TEST(Chart, PointsWithoutAPositionAreLeftOut)
{
    Chart chart{.x = {.logarithmic = true}, .y = {.logarithmic = true}};
    chart.series = {
        {},
        {.legend = "empty", .line_width = 2, .radius = 2, .band = true},
        {.points = {{1, 1}, {not_a_number, 2}, {2, infinity}, {0, 3}, {3, -1}, {10, 10}, {20, 10}},
         .line_width = 1,
         .radius = 3,
         .y_spread = {{.5, 2}, {1, 2}, {not_a_number, 1}, {1, 2}, {1, 2}, {0, 20}, {5, 20}}}};
    chart.references = {{.at = not_a_number, .name = "nowhere"}, {.at = -1}};
    const Recording canvas = drawn(chart);
    EXPECT_EQ(canvas.centers.size(), 3u + 1); // + 1 in the legend
    EXPECT_FALSE(canvas.has("nowhere"));
    const std::string svg = base::chart_svg(chart, {400, 300}, base::SvgUse::StandAlone);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    EXPECT_FALSE(base::chart_picture(chart, {400, 300}).empty());
    EXPECT_FALSE(base::chart_picture({}, {400, 300}).empty()) << "an empty chart";
    EXPECT_FALSE(base::chart_picture(chart, {20, 10}).empty()) << "a picture with no room for a plot";
}

TEST(Chart, ANonFinitePointInterruptsTheLine)
{
    Chart chart;
    chart.series = {
        {.points = {{0, 0}, {1, 1}, {not_a_number, 1}, {2, 2}, {3, 3}, {4, 2.5}}, .line_width = 2}};
    std::vector<std::size_t> lengths;
    for (const auto& polyline : drawn(chart).polylines)
        if (polyline.front().x != polyline.back().x &&
            polyline.front().y != polyline.back().y) // not a grid line
            lengths.push_back(polyline.size());
    EXPECT_THAT(lengths, testing::ElementsAre(2, 3));
}

TEST(Chart, AStaircaseGoesLevelThenDown)
{
    Chart chart{.x = {.low = 0, .high = 4}, .y = {.low = 0, .high = 4}};
    chart.series = {{.points = {{1, 3}, {2, 1}}, .line_width = 2, .path = base::Path::Staircase}};
    const base::ChartLayout layout = base::lay_out(chart, whole);
    const auto at = [&](double x, double y) { return cv::Point2d(*layout.x.at(x), *layout.y.at(y)); };
    EXPECT_THAT(drawn(chart).polylines,
                testing::Contains(testing::ElementsAre(at(1, 3), at(2, 3), at(2, 1))));
}

TEST(Chart, BarsLieInTheirRowsTheFirstOnTop)
{
    const Chart chart{
        .x = {.low = 0, .high = 10},
        .y = {.rows = {"first", "second"}},
        .bars = {{.row = 0, .from = 0, .to = 5}, {.row = 1, .from = 5, .to = 50, .label = "50"}}};
    const Recording canvas = drawn(chart);
    const cv::Rect2d plot = base::lay_out(chart, whole).plot;
    ASSERT_EQ(canvas.rects.size(), 2u);
    EXPECT_LT(canvas.rects[0].br().y, canvas.rects[1].y);
    EXPECT_NEAR(canvas.rects[0].width, plot.width / 2, 1e-6);
    EXPECT_NEAR(canvas.rects[1].br().x, plot.x + plot.width, 1e-6) << "cut at the end of the axis";
    EXPECT_LT(std::abs(canvas.find("first").box.y - canvas.rects[0].y), canvas.rects[0].height);
    EXPECT_TRUE(inside(whole, canvas.find("50").box));
}

TEST(Chart, APlotHasTheHeightThatWasAskedFor)
{
    Chart chart{.title = "title",
                .x = {.title = "x"},
                .y = {.title = "y", .rows = {"a", "b", "c"}},
                .footnote = "note"};
    chart.legend = {{"one"}, {"two"}};
    const double height = base::chart_height(chart, 700, 78);
    EXPECT_NEAR(base::lay_out(chart, {0, 0, 700, height}).plot.height, 78, 1);
}

TEST(Chart, SegmentsAreClipped)
{
    const cv::Rect2d rect(0, 0, 10, 10);
    const auto cut = base::clipped({{-10, 5}, {20, 5}}, rect);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->from, cv::Point2d(0, 5));
    EXPECT_EQ(cut->to, cv::Point2d(10, 5));
    EXPECT_FALSE(base::clipped({{-5, 6}, {6, 17}}, rect));
    EXPECT_FALSE(base::clipped({{11, 0}, {11, 10}}, rect));
    EXPECT_TRUE(base::clipped({{10, 10}, {10, 10}}, rect)) << "a point on the border";
    EXPECT_FALSE(base::clipped({{10.1, 10}, {10.1, 10}}, rect));
}

} // namespace
