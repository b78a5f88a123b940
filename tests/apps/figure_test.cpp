// `cicatrix figure`: the numbers in the figures against the libraries, its files, its errors, its document.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/figure/figures.hpp"
#include "apps/figure/frame_rate.hpp"
#include "apps/figure/light_charts.hpp"
#include "apps/figure/wound_pictures.hpp"
#include "base/color.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/statistics.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"
#include "wound/optics/fresnel.hpp"
#include "wound/optics/reflectance.hpp"
#include "wound/pictures.hpp"

namespace {

using namespace figure_command;
using testing::HasSubstr;

/// The default wound on the small head, loaded once.
const scene::LoadedScene& loaded()
{
    static const scene::LoadedScene scene = [] {
        scene::Scene published = small::scene(small::head());
        scene::make_published(published);
        return scene::load(published);
    }();
    return scene;
}
const wound::PreparedWound& prepared()
{
    return loaded().wounds.front().prepared();
}

std::string text_of(const std::filesystem::path& file)
{
    const std::vector<std::uint8_t> bytes = base::read_file(file, 1 << 22);
    return {bytes.begin(), bytes.end()};
}

TEST(Figure2, HalvesAddUpToOneAndTheBackwardOneIsTheClosedForm)
{
    for (const double g : {-.5, 0., .2, .73, .76, .9}) {
        const Halves halves = integrated_halves(g);
        EXPECT_NEAR(halves.forward + halves.backward, 1, 1e-6) << g;
        EXPECT_NEAR(halves.backward, optics::backward_fraction(g), 1e-7) << g;
    }
    const base::Chart chart = halves_chart();
    ASSERT_EQ(chart.bars.size(), 6u);
    for (std::size_t row = 0; row < 3; ++row) {
        const double backward = optics::backward_fraction(optics::table1().layers[row].g);
        EXPECT_NEAR(chart.bars[2 * row].to, 1 - backward, 1e-6);
        EXPECT_NEAR(chart.bars[2 * row + 1].to - chart.bars[2 * row + 1].from, backward, 1e-6);
    }
}

TEST(Figure2, CurvesAreThePhaseFunction)
{
    const base::Chart chart = phase_function_chart();
    ASSERT_EQ(chart.series.size(), 3u);
    // At 90 degrees (1 - g^2) / (4 pi (1 + g^2)^(3/2)).
    for (std::size_t i = 0; i < 3; ++i) {
        const double g = optics::table1().layers[i].g;
        const cv::Point2d middle = chart.series[i].points[45];
        EXPECT_EQ(middle.x, 90);
        EXPECT_NEAR(middle.y, (1 - g * g) / (4 * CV_PI * std::pow(1 + g * g, 1.5)), 1e-12);
    }
}

TEST(Figure3, LayersAddUpToTheReflectanceOfTheStack)
{
    for (const double dermis_mm : {.5, 1., 4.}) {
        const optics::SkinLayers skin = optics::table1(.2, dermis_mm);
        const std::vector<LayerLight> layers = light_through(skin);
        ASSERT_EQ(layers.size(), 3u);
        const double top = optics::diffuse_fresnel(skin.layers[0].n, skin.n_above);
        const std::vector<double> total = optics::diffuse_color(skin, optics::ReflectanceModel::Published);
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (const LayerLight& layer : layers)
                sum += layer.arriving[c] * (layer.scattered[c] + layer.bottom[c]);
            EXPECT_NEAR((1 - top) * sum, total[c], 1e-12) << dermis_mm << " mm, channel " << c;
        }
    }
    // Eq. (3)'s integral by hand: epidermis, red.
    const double s = 10.5 * optics::backward_fraction(.2), a = .04, d = .2;
    EXPECT_NEAR(light_through(optics::table1())[0].scattered[0], s * (d - a * d * d + a * a * d * d * d / 3),
                1e-12);
    EXPECT_TRUE(light_through(optics::table1())[2].outside[0]) << "the subcutis is thicker than the domain";
    EXPECT_FALSE(light_through(optics::table1())[0].outside[0]);
}

TEST(Figure4, TheWarpedMaskHasTheContractedArea)
{
    for (const double ratio : {.4, .6})
        EXPECT_NEAR(
            warped_area_ratio(prepared(), wound::make_warp(prepared().flow, ratio, wound::WarpModel::Dense)),
            ratio, .02 * ratio);
}

TEST(Figure5, DepthFallsWithTheRootOfTheUnhealedRatio)
{
    const wound::Healing& healing = loaded().wounds.front().healing;
    const std::vector<double> days{0, 4, 8, 16};
    const base::Chart chart = deepest_chart(wound::depth_profiles(prepared(), healing, days), days, healing);
    const base::Series &expected = chart.series[0], &measured = chart.series[1];
    const double depth0 = measured.points[0].y;
    EXPECT_GT(depth0, .1);
    for (std::size_t i = 0; i < days.size(); ++i)
        EXPECT_NEAR(measured.points[i].y, depth0 * std::sqrt(wound::unhealed_ratio(healing.curve, days[i])),
                    .03 * depth0)
            << "day " << days[i];
    EXPECT_NEAR(expected.points[50].y, depth0 * std::sqrt(wound::unhealed_ratio(healing.curve, 8)), 1e-9);
}

TEST(Figure6, BeginsWithTheWoundAndOnlyOurFormEndsAtTheSkin)
{
    const std::vector<double> ends{0, 1};
    const auto published = recovering_colors(loaded(), Equations::Published, ends),
               corrected = recovering_colors(loaded(), Equations::Corrected, ends);
    const int middle = prepared().patch.color.cols / 2;
    for (const auto* colors : {&published, &corrected})
        EXPECT_LT(cv::norm((*colors)[0].color(middle, middle) - prepared().patch.color(middle, middle)),
                  1e-6);
    EXPECT_GT(published[1].to_skin, 2);
    EXPECT_LT(corrected[1].to_skin, 1e-3);
    EXPECT_GT(corrected[0].to_skin, 10);
}

TEST(FrameRates, AreMediansAndRatiosToTheFirstCase)
{
    std::vector<stage::Measurement> measured(2);
    for (int i = 0; i < 8; ++i) {
        stage::TimedFrame frame;
        frame.declare_ms = 1;
        frame.result.frame_ms = 19;
        frame.process_cpu_ms = 30;
        measured[0].frames.push_back(frame);
        frame.process_cpu_ms = 33;
        measured[1].frames.push_back(frame);
    }
    const nlohmann::json cases = frame_rates(measured);
    EXPECT_EQ(cases[0]["fps"], 50);
    EXPECT_EQ(cases[1]["process_cpu_ms"], 33);
    EXPECT_NEAR(cases[1]["over_first"]["ratio"].get<double>(), 1.1, 1e-12);
}

TEST(FigureCommand, DrawsChartsWithoutAHeadOrADevice)
{
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"figure", "3", "2", "--out", (folder / "out").string()},
                                        {"VK_ICD_FILENAMES=/nonexistent", "XDG_CACHE_HOME=/nonexistent"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* file : {"figure_2.svg", "figure_3.svg"})
        EXPECT_THAT(text_of(folder / "out" / file), testing::StartsWith("<svg"));
    EXPECT_EQ(base::read_rgb(folder / "out" / "figure_2.png").cols, 940);
    EXPECT_THAT(outcome.out, HasSubstr("backward 0.063355; P(g) in closed form 0.063355"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out" / "figures.html")) << "a page is of all figures";
}

TEST(FigureCommand, DrawsAllFiguresOnOnePage)
{
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"figure", "--out", (folder / "out").string(), "--head",
                                         small::saved(small::head()).string(), "--cell", "60", "--size",
                                         "64x64", "--frames", "5", "--validation"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string page = text_of(folder / "out" / "figures.html");
    for (const Figure& figure : all_figures()) {
        const cv::Mat3b picture = base::read_rgb(folder / "out" / (figure.stem() + ".png"));
        EXPECT_GT(picture.cols, 150) << figure.name;
        EXPECT_THAT(page, HasSubstr("src=\"" + figure.stem()));
        EXPECT_THAT(page, HasSubstr(figure.heading()));
    }
    const auto rates = nlohmann::json::parse(text_of(folder / "out" / "frame_rate.json"));
    EXPECT_EQ(rates["cases"].size(), 3u);
    EXPECT_EQ(rates["paper"].size(), paper_rates().size());
    for (const auto& one : rates["cases"])
        EXPECT_GT(one["process_cpu_ms"], 0);
}

TEST(FigureCommand, RefusesFiguresThatThePaperDoesNotHave)
{
    for (const char* name : {"10", "0", "seven"}) {
        const TemporaryFolder folder;
        const Outcome outcome = run_program({"figure", name, "--out", (folder / "out").string()});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_THAT(outcome.err, HasSubstr(fmt::format("figure {}: the paper has no such figure", name)));
        EXPECT_THAT(outcome.err, HasSubstr("choose from 1, 2, 3, 4, 5, 6, 7, 8, 9, frame-rate"));
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    }
}

TEST(FigureCommand, DocumentSaysWhatThePageSays)
{
    const std::string document = text_of(std::filesystem::path(CICATRIX_DOCS) / "figures.md");
    for (const Figure& figure : all_figures()) {
        EXPECT_THAT(document, HasSubstr(std::string(figure.heading()) + ": " + figure.title));
        EXPECT_THAT(document, HasSubstr(figure.paper));
        EXPECT_THAT(document, HasSubstr(figure.ours));
        EXPECT_THAT(document, HasSubstr(std::string("cicatrix figure ") + figure.name));
        EXPECT_THAT(document, HasSubstr("(images/figures/" + figure.stem()));
    }
}

} // namespace
