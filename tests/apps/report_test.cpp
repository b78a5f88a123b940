// Reports: what runs in each case, numbers that must add up, JSON, trace and page, comparisons, sweeps.
// No test depends on the speed of the machine.
#include <gmock/gmock.h>
#include <regex>

#include "apps/report/cases.hpp"
#include "apps/report/comparison.hpp"
#include "apps/report/json.hpp"
#include "apps/report/page.hpp"
#include "apps/report/sweep.hpp"
#include "base/input_error.hpp"
#include "scene/file.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr stage::Rounds few{.warm_up = 1, .counted = 1, .timed = 6};

json some_facts(bool software = true)
{
    return {{"program", {{"version", "1"}, {"build", "release"}, {"sanitizers", false}, {"compiler", "c"}}},
            {"device",
             {{"name", "Some <device> & more"},
              {"type", "CPU"},
              {"driver", "driver 1"},
              {"vulkan", "1.3.0"},
              {"software_rasteriser", software},
              {"timestamps", true},
              {"counts_invocations", true}}},
            {"machine",
             {{"cpu", nullptr},
              {"cores", 2},
              {"memory_gib", 1.5},
              {"memory_free_gib", 1},
              {"os", "os"},
              {"kernel", "k"}}},
            {"settings",
             {{"size", "64x64"},
              {"samples_per_pixel", 1},
              {"mode", "corrected"},
              {"validation", true},
              {"frames", few.timed},
              {"warm_up_frames", few.warm_up},
              {"counted_frames", few.counted}}},
            {"scene", {{"head", "</pre><script>x</script>"}}},
            {"head", {{"triangles", 12}}},
            {"load", {{"before", 0.5}, {"after", 0.75}}},
            {"alignment", {{"method", "calibrated"}, {"words", "calibrated timestamps"}, {"error_ms", 0.1}}}};
}

/// One measurement that all tests share.
struct Measured
{
    std::vector<stage::Measurement> measurements;
    std::vector<report_command::CaseSummary> summaries;
    json record;

    static const Measured& once()
    {
        static const Measured measured = [] {
            const scene::Scene scene = small::scene(small::head(), 64);
            stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
            Measured made;
            made.measurements = stage::measure(gpu_test::device(), gpu_test::shaders(),
                                               report_command::report_cases(stage, {}), few);
            for (const stage::Measurement& one : made.measurements)
                made.summaries.push_back(report_command::summarise(one));
            made.record = report_command::report_json(some_facts(), made.summaries, made.measurements);
            return made;
        }();
        return measured;
    }
};

/// The passes that ran, and in how many frames.
std::map<std::string, int> ran_counts(const report_command::CaseSummary& summary)
{
    std::map<std::string, int> counts;
    for (const report_command::PassSummary& pass : summary.passes) {
        EXPECT_EQ(pass.ran + pass.skipped + pass.culled, few.timed) << pass.name;
        if (pass.ran > 0)
            counts[pass.name] = pass.ran;
    }
    return counts;
}

using Report = gpu_test::Test;

} // namespace

TEST_F(Report, EachCaseRerunsOnlyThePassesItAffects)
{
    const auto& summaries = Measured::once().summaries;
    ASSERT_EQ(summaries.size(), report_command::case_names().size());
    using Counts = std::map<std::string, int>;
    const int all = few.timed;
    const Counts picture{{"forward", all}}; // which writes the picture itself: nobody reads radiance
    const auto with = [&](Counts more) {
        more.insert(picture.begin(), picture.end());
        return more;
    };
    const auto spread = [&](Counts more) {
        more.insert({{"coarse skin light", all}, {"skin gathered", all}, {"skin diffused", all}});
        return more;
    };
    const std::map<std::string, Counts> expected{
        {"still", {}},
        {"camera", picture},
        {"camera-lit", picture},
        {"day", with(spread({{"coarse skin", all}, {"wound_texture", all}, {"wound_relief", all}}))},
        {"day-camera", with(spread({{"coarse skin", all}, {"wound_texture", all}, {"wound_relief", all}}))},
        {"light-drag", with({{"shadow", all}})},
        {"light-rest", with(spread({{"skin shadow", all}, {"shadow", all}}))},
        {"light-keep", with(spread({{"skin shadow", all}, {"skin light", all}}))},
        {"tissue", with(spread({{"coarse skin", all}, {"reflectance_lut", all}}))},
        {"read-back", {}}};
    for (const report_command::CaseSummary& summary : summaries)
        EXPECT_EQ(ran_counts(summary), expected.at(summary.name)) << summary.name;
}

TEST_F(Report, ANewDayRefreshesOnlyTheWoundsRectangleOfThePicture)
{
    for (const report_command::CaseSummary& summary : Measured::once().summaries)
        for (const report_command::PassSummary& pass : summary.passes)
            if (pass.name == "forward" && pass.ran > 0) {
                EXPECT_LE(pass.refreshed, summary.name == "day" ? .5 : 1) << summary.name;
                EXPECT_GE(pass.refreshed, summary.name == "camera" ? 1 : .01) << summary.name;
            }
}

TEST_F(Report, ChosenCasesAreMeasuredAlone)
{
    const scene::Scene scene = small::scene(small::head(), 64);
    stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    const auto cases = report_command::report_cases(stage, {"tissue", "camera"});
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0].name, "camera");
    EXPECT_EQ(cases[1].name, "tissue");
}

TEST_F(Report, TheCasesChangeThePictureAndRestoreTheStage)
{
    const scene::Scene scene = small::scene(small::head(), 64);
    stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    const std::vector<stage::MeasuredCase> cases = report_command::report_cases(
        stage, {"still", "camera", "day", "day-camera", "light-drag", "light-rest", "light-keep", "tissue"});
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const auto picture = [&](const stage::MeasuredCase& one, double position) {
        graph::Graph graph;
        one.declare(graph, position);
        graph.readback("picture", graph.presented.at(0));
        const gpu::FrameResult frame = executor.run(graph);
        one.afterwards();
        return frame.readbacks.at(0).bytes;
    };
    const auto still = picture(cases[0], 0);
    for (std::size_t i = 1; i < cases.size(); ++i) {
        const bool moved = picture(cases[i], 0.7) != picture(cases[i], 0);
        EXPECT_TRUE(moved) << cases[i].name;
        const bool as_before = picture(cases[0], 0.7) == still;
        EXPECT_TRUE(as_before) << "after " << cases[i].name;
    }
}

TEST_F(Report, SharesAndTimesAddUp)
{
    for (const report_command::CaseSummary& summary : Measured::once().summaries) {
        SCOPED_TRACE(summary.name);
        double parts = 0, passes = 0;
        for (const report_command::FramePart& part : summary.parts) {
            EXPECT_GE(part.share, -1e-9) << part.name;
            parts += part.share;
        }
        for (const report_command::PassSummary& pass : summary.passes) {
            passes += pass.share;
            EXPECT_EQ(pass.gpu_ms.has_value(), pass.ran > 0) << pass.name;
            EXPECT_EQ(pass.share > 0, pass.ran > 0) << pass.name;
            EXPECT_EQ(pass.bytes_written > 0, pass.ran > 0) << pass.name;
            if (gpu_test::device().info().statistics) {
                EXPECT_EQ(pass.invocations.has_value(), pass.ran > 0) << pass.name;
            }
            if (pass.gpu_ms) {
                EXPECT_LE(pass.gpu_ms->p5, pass.gpu_ms->median);
                EXPECT_LE(pass.gpu_ms->median, pass.gpu_ms->p95);
            }
        }
        EXPECT_NEAR(parts, 1, 1e-9);
        EXPECT_NEAR(summary.coverage, passes, 1e-9);
        EXPECT_LE(summary.coverage, 1);
        EXPECT_GT(summary.process_cpu_ms.median, 0);
        EXPECT_EQ(summary.sum_ms.has_value(), passes > 0 || summary.name == "read-back") << "a GPU had work";
        if (summary.sum_ms) {
            EXPECT_LE(summary.sum_ms->median, summary.envelope_ms.value().median + 1e-9);
            EXPECT_LE(summary.envelope_ms->median, summary.wall_ms.median);
        }
        EXPECT_THAT(report_command::to_text(summary),
                    testing::AllOf(HasSubstr("forward"), HasSubstr("the passes explain")));
    }
}

TEST_F(Report, TheRecordHoldsEveryFrame)
{
    const json& record = Measured::once().record;
    EXPECT_EQ(record.at("format"), "cicatrix report");
    for (const json& one : record.at("cases")) {
        EXPECT_EQ(one.at("samples").at("wall_ms").size(), std::size_t(few.timed));
        for (const json& pass : one.at("passes")) {
            const json& gpu = one.at("samples").at("gpu_ms").at(pass.at("name"));
            ASSERT_EQ(gpu.size(), std::size_t(few.timed));
            EXPECT_EQ(std::ranges::count_if(gpu, [](const json& ms) { return ms.is_number(); }),
                      pass.at("ran"));
        }
    }
    EXPECT_EQ(json::parse(record.dump()), record) << "no NaN, no infinity";
}

TEST_F(Report, TheTraceIsInOrderOnBothTracks)
{
    const json trace = report_command::trace_json(some_facts(), Measured::once().measurements);
    std::map<std::pair<int, int>, std::string> names;
    std::map<int, json> frame; // of each process, the last seen
    std::map<std::string, int> gpu_events;
    for (const json& event : trace.at("traceEvents")) {
        if (event.at("ph") == "M") {
            names[{event.at("pid"), event.at("tid")}] = event.at("args").at("name");
            continue;
        }
        ASSERT_EQ(event.at("ph"), "X");
        ASSERT_TRUE(event.at("ts").is_number() && event.at("dur").is_number()) << event;
        EXPECT_GE(event.at("ts"), 0) << event;
        EXPECT_GE(event.at("dur"), 0) << event;
        const int process = event.at("pid");
        if (event.at("name") == "frame") {
            if (frame.contains(process)) {
                EXPECT_GE(event.at("ts").get<double>(),
                          frame[process].at("ts").get<double>() + frame[process].at("dur").get<double>());
            }
            frame[process] = event;
            continue;
        }
        const json& around = frame.at(process);
        const double slack = around.at("args").at("alignment_error_us").get<double>() + 1;
        const double begin = event.at("ts"), end = begin + event.at("dur").get<double>();
        EXPECT_GE(begin, around.at("ts").get<double>() - slack) << event;
        EXPECT_LE(end, around.at("ts").get<double>() + around.at("dur").get<double>() + slack) << event;
        if (event.at("tid") == 2)
            ++gpu_events[event.at("name")];
    }
    EXPECT_EQ(names.at({1, 0}), "still");
    EXPECT_EQ(names.at({10, 0}), "read-back");
    EXPECT_EQ(names.at({1, 1}), "CPU");
    EXPECT_THAT(names.at({1, 2}), HasSubstr("software rasteriser"));
    EXPECT_EQ(gpu_events["forward"], 8 * few.timed) << "camera twice, day, both, light three times, tissue";
    EXPECT_EQ(gpu_events["wound_texture"], 2 * few.timed);
    EXPECT_EQ(gpu_events["shadow"], 2 * few.timed)
        << "only when the light is dragged or rests at another place";
    EXPECT_EQ(gpu_events["skin shadow"], 2 * few.timed) << "only when the light rests at another place";
}

TEST_F(Report, ThePageIsSelfContained)
{
    const Measured& measured = Measured::once();
    const report_command::Comparison self =
        report_command::compare_reports(measured.record, measured.record, "old/report.json");
    const std::string page =
        report_command::report_page(some_facts(), measured.summaries, measured.measurements, self);
    EXPECT_THAT(page, Not(testing::AnyOf(HasSubstr("<script"), HasSubstr("http"), HasSubstr("url("),
                                         HasSubstr("@import"), HasSubstr("src="))));
    EXPECT_THAT(page, HasSubstr("Some &lt;device&gt; &amp; more"));
    EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
    EXPECT_THAT(page, HasSubstr("software rasteriser"));
    EXPECT_THAT(report_command::report_page(some_facts(false), measured.summaries, measured.measurements, {}),
                Not(HasSubstr("software rasteriser")));
    EXPECT_THAT(page, Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("inf\""))));
    // Elements must be properly nested.
    std::vector<std::string> open;
    const std::regex tag("<(/?)([a-z0-9]+)[^>]*?(/?)>");
    for (auto at = std::sregex_iterator(page.begin(), page.end(), tag); at != std::sregex_iterator(); ++at) {
        const std::string name = (*at)[2];
        if (name == "meta" || name == "th" || (*at)[3] == "/")
            continue;
        if ((*at)[1] != "/")
            open.push_back(name);
        else {
            ASSERT_FALSE(open.empty());
            ASSERT_EQ(open.back(), name);
            open.pop_back();
        }
    }
    EXPECT_THAT(open, testing::IsEmpty());
}

TEST_F(Report, ComparesWithAnEarlierOne)
{
    const json& now = Measured::once().record;
    const report_command::Comparison self = report_command::compare_reports(now, now, "a.json");
    EXPECT_THAT(self.warnings, testing::IsEmpty());
    EXPECT_GE(self.times.size(), 4u * 3);
    for (const report_command::ComparedTime& time : self.times) {
        EXPECT_EQ(time.ratio.ratio, 1) << time.what;
        EXPECT_FALSE(time.exceeds_noise) << time.where << time.what;
    }

    // Synthetic samples, so that the load of the machine does not matter.
    json before = now, slower = now;
    for (json* report : {&before, &slower})
        for (json& one : report->at("cases")) {
            const double ms = report == &before ? 10 : 15;
            for (json& samples : one.at("samples").at("gpu_ms"))
                samples = {ms, ms * 1.01, ms * .99, ms, ms * 1.02, ms};
            one.at("samples").at("wall_ms") = {ms, ms * 1.01, ms * .99, ms, ms * 1.02, ms};
        }
    slower["device"]["name"] = "another";
    slower["settings"]["size"] = "128x128";
    const report_command::Comparison comparison = report_command::compare_reports(before, slower, "b.json");
    EXPECT_THAT(
        comparison.warnings,
        testing::UnorderedElementsAre(HasSubstr("device"), HasSubstr("\"64x64\" before, \"128x128\" now")));
    for (const report_command::ComparedTime& time : comparison.times) {
        EXPECT_NEAR(time.ratio.ratio, 1.5, 1e-9);
        EXPECT_TRUE(time.exceeds_noise) << time.what;
    }
    EXPECT_THAT(report_command::to_text(comparison),
                testing::AllOf(HasSubstr("slower"), HasSubstr("warning: the device")));

    // A difference no larger than the drift within one run is not significant.
    for (json& one : before.at("cases"))
        one.at("samples").at("wall_ms") = {10, 10, 10, 16, 16, 16};
    for (const report_command::ComparedTime& time :
         report_command::compare_reports(before, slower, "c.json").times)
        if (time.what == "frame") {
            EXPECT_FALSE(time.exceeds_noise);
        }
}

TEST_F(Report, RefusesInvalidReports)
{
    const TemporaryFolder folder;
    json damaged = Measured::once().record, newer = damaged;
    damaged["cases"][0]["samples"].erase("wall_ms");
    newer["version"] = 2;
    for (const auto& [name, text, word] :
         {std::tuple("a.json", std::string("{"), "JSON"),
          {"b.json", std::string("[1]"), "not a report"},
          {"c.json", std::string(R"({"format": "cicatrix sweep"})"), "not a report"},
          {"d.json", damaged.dump(), "damaged"},
          {"e.json", newer.dump(), "version"}})
    {
        try {
            report_command::read_report(folder.with(name, text));
            FAIL() << name;
        } catch (const base::InputError& error) {
            EXPECT_THAT(error.what(), testing::AllOf(HasSubstr(name), HasSubstr(word)));
        }
    }
    EXPECT_EQ(report_command::read_report(folder.with("good.json", Measured::once().record.dump())),
              Measured::once().record);
}

// ---- Sweeps

TEST_F(Report, SweepsEveryKind)
{
    scene::Scene scene = small::scene(small::head(), 64);
    scene.days = {0, 10};
    for (const std::string& kind : report_command::sweep_names()) {
        SCOPED_TRACE(kind);
        const report_command::Sweep sweep =
            report_command::measure_sweep(kind, scene, gpu_test::device(), gpu_test::shaders(),
                                          {.warm_up = 0, .counted = 0, .timed = 1}, [](int) {});
        EXPECT_EQ(sweep.kind, kind);
        EXPECT_NE(sweep.fixed, "");
        ASSERT_GE(sweep.series.size(), 2u);
        for (const report_command::SweepSeries& series : sweep.series) {
            ASSERT_EQ(series.x.size(), series.ms.size()) << series.name;
            EXPECT_TRUE(std::ranges::is_sorted(series.x)) << series.name;
            EXPECT_TRUE(series.law) << series.name;
            if (kind == "wounds" && series.name.starts_with("wound_")) {
                EXPECT_EQ(series.x.front(), 1) << "a head without a wound has no such pass";
            }
        }
        if (kind == "triangles") {
            const std::vector<double>& x = sweep.series.front().x;
            EXPECT_NEAR(x[4] / x[3], 4, 1e-9);
            EXPECT_NEAR(x[5] / x[3], 16, 1e-9);
            EXPECT_LT(x[0], 0.3 * x[3]);
        }
        EXPECT_THAT(report_command::to_text(sweep), testing::AllOf(HasSubstr("x^("), HasSubstr("fixed: ")));
        EXPECT_EQ(report_command::to_json(sweep).at("series").size(), sweep.series.size());
        const base::Chart chart = report_command::sweep_chart(sweep, gpu_test::device().info().name);
        EXPECT_TRUE(chart.x.logarithmic && chart.y.logarithmic);
        const cv::Mat3b picture = base::chart_picture(chart, {800, 400});
        int colored = 0;
        for (const cv::Vec3b& pixel : picture)
            colored += std::abs(pixel[0] - pixel[1]) > 40 || std::abs(pixel[1] - pixel[2]) > 40;
        EXPECT_GT(colored, 500);
    }
}
