// The canvases: SVG and pictures.
#include "base/canvas.hpp"

#include <gmock/gmock.h>
#include <regex>

#include "base/chart.hpp"

namespace {

using base::Chart;
using testing::HasSubstr;
using testing::Not;

/// The first XML error found; empty when elements are nested properly and attributes are quoted.
std::string xml_error(const std::string& xml)
{
    static const std::regex element(R"(<(/?)([a-z]+)((?: [a-zA-Z-]+="[^"<&]*(?:&[a-z]+;[^"<&]*)*")*)(/?)>)");
    std::vector<std::string> open;
    std::size_t end = 0;
    for (std::sregex_iterator at(xml.begin(), xml.end(), element), last; at != last; ++at) {
        const std::string between = xml.substr(end, std::size_t(at->position()) - end);
        if (between.find_first_of("<>") != std::string::npos)
            return between;
        if (std::regex_search(between, std::regex("&(?!(amp|lt|gt|quot);)")))
            return between;
        end = std::size_t(at->position() + at->length());
        if ((*at)[1] == "/") {
            if (open.empty() || open.back() != (*at)[2])
                return at->str();
            open.pop_back();
        } else if ((*at)[4] != "/")
            open.push_back((*at)[2]);
        if (open.empty() && end < xml.find_last_not_of('\n'))
            return "more than one element";
    }
    return open.empty() && end + 1 == xml.size() ? "" : "unfinished";
}

Chart everything()
{
    const std::string wicked = "<b a=\"1\">&'\x01\xff</b>";
    Chart chart{.title = wicked,
                .description = wicked,
                .x = {.title = wicked, .unit = "ms"},
                .y = {.title = wicked},
                .references = {{.at = 1, .name = wicked}},
                .footnote = wicked};
    chart.series = {{.legend = wicked,
                     .points = {{0, 0}, {1, 2}, {2, 1}},
                     .line_width = 1.5,
                     .path = base::Path::Staircase,
                     .radius = 4,
                     .opacity = .5,
                     .names = {wicked, "b", "c"},
                     .y_spread = {{-1, 1}, {1, 3}, {0, 2}},
                     .band = true}};
    chart.bars = {{.row = .5, .from = 0, .to = 1, .tooltip = wicked, .label = wicked, .opacity = .3}};
    return chart;
}

TEST(Canvas, SvgIsWellFormed)
{
    ASSERT_EQ(xml_error("<a b=\"c\"><d/>&amp;</a>\n"), "");
    for (const char* broken : {"<a>\n", "<a></b>\n", "<a b=c/>\n", "<a>&</a>\n", "<a><</a>\n", "<a/><a/>\n"})
        ASSERT_NE(xml_error(broken), "") << broken;
    const std::string file = base::chart_svg(everything(), {600, 400}, base::SvgUse::StandAlone);
    const std::string element = base::chart_svg(everything(), {600, 400}, base::SvgUse::InPage);
    EXPECT_EQ(xml_error(file), "");
    EXPECT_EQ(xml_error(element), "");
    EXPECT_THAT(file, testing::AllOf(testing::StartsWith("<svg xmlns="),
                                     HasSubstr("&lt;b a=&quot;1&quot;&gt;&amp;"), Not(HasSubstr("var("))));
}

TEST(Canvas, ColoursInAPageAreDefinedCssVariables)
{
    const std::string element = base::chart_svg(everything(), {600, 400}, base::SvgUse::InPage);
    const std::string style = base::css_variables();
    static const std::regex variable(R"(var\((--[a-z0-9]+)\))");
    std::size_t found = 0;
    for (std::sregex_iterator at(element.begin(), element.end(), variable), last; at != last; ++at, ++found)
        EXPECT_THAT(style, HasSubstr((*at)[1].str() + ": #"));
    EXPECT_GT(found, 10u);
}

TEST(Canvas, PngAndSvgPlaceAPointAtTheSamePixel)
{
    for (const bool logarithmic : {false, true})
        for (const double value : {3.3, 47., 130.}) {
            const Chart chart{
                .title = "title",
                .x = {.title = "x", .low = 1, .high = 200, .logarithmic = logarithmic},
                .y = {.low = 1, .high = 200, .logarithmic = logarithmic},
                .series = {{.paint = base::paint(0xff0000), .points = {{value, value}}, .radius = 5}}};
            const std::string svg = base::chart_svg(chart, {400, 300}, base::SvgUse::StandAlone);
            std::smatch circle;
            ASSERT_TRUE(std::regex_search(svg, circle, std::regex("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"")));
            cv::Point2d sum;
            double weight = 0;
            const cv::Mat3b picture = base::chart_picture(chart, {400, 300});
            for (int y = 0; y < picture.rows; ++y)
                for (int x = 0; x < picture.cols; ++x) {
                    const double red = picture(y, x)[0] - picture(y, x)[1];
                    sum += red * cv::Point2d(x + .5, y + .5);
                    weight += red;
                }
            ASSERT_GT(weight, 255 * 60);
            EXPECT_NEAR(sum.x / weight, std::stod(circle[1]), .1);
            EXPECT_NEAR(sum.y / weight, std::stod(circle[2]), .1);
        }
}

TEST(Canvas, TransparentPaintIsBlendedWithThePicture)
{
    cv::Mat3b picture(40, 40, cv::Vec3b(255, 255, 255));
    base::PictureCanvas canvas(picture);
    canvas.rect({10, 10, 20, 20}, {base::paint(0xff0000), .5});
    EXPECT_EQ(picture(5, 5), cv::Vec3b(255, 255, 255));
    EXPECT_NEAR(picture(20, 20)[1], 127, 1);
    EXPECT_EQ(picture(10, 10), picture(29, 29));
    EXPECT_EQ(picture(9, 9), picture(30, 30));
    canvas.circle({39, 39}, 8, {base::paint(0), .25}); // half outside
    EXPECT_NEAR(picture(38, 38)[0], 191, 1);
    canvas.polygon({{-50, -50}, {90, -50}, {90, 90}, {-50, 90}}, {base::paint(0), 1});
    EXPECT_EQ(picture(0, 0), cv::Vec3b(0, 0, 0));
}

} // namespace
