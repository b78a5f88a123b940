// The counted work of a frame of each case of the report: a change that makes a frame do more fails here, on
// any machine and without a clock.
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/report/cases.hpp"
#include "base/file.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

using nlohmann::json;

constexpr const char* remake =
    "if it is meant, remake the file: CICATRIX_WRITE_WORK=1 build/apps_tests --gtest_filter='Work.*'";

json measured_work()
{
    stage::Stage stage(gpu_test::device(), stage::Stage::prepare(small::scene(small::head(), 96)));
    json cases;
    for (const stage::Measurement& one :
         stage::measure(gpu_test::device(), gpu_test::shaders(), report_command::report_cases(stage, {}),
                        {.warm_up = 1, .counted = 4, .timed = 0}))
        cases[one.name] = stage::to_json(stage::mean_work(one));
    const gpu::DeviceInfo& device = gpu_test::device().info();
    return {{"driver", fmt::format("{}, {}", device.name, device.driver)}, {"cases", cases}};
}

/// A line for each number that differs by more than 5 %, or that one of the two lacks. Invocations are the
/// driver's own: on another one they are not compared.
std::vector<std::string> changes(json before, json after)
{
    if (before.at("driver") != after.at("driver"))
        for (json* work : {&before, &after})
            for (json& one : work->at("cases"))
                one.erase("invocations");
    const json was = before.at("cases").flatten(), is = after.at("cases").flatten();
    std::vector<std::string> lines;
    for (const auto& [name, value] : was.items())
        if (!is.contains(name))
            lines.push_back(name + ": is gone");
    for (const auto& [name, value] : is.items()) {
        if (!was.contains(name) || value.is_number() != was[name].is_number()) {
            lines.push_back(name + ": is new");
            continue;
        }
        if (!value.is_number())
            continue;
        const double now = value, then = was[name];
        if (std::abs(now - then) > .05 * then)
            lines.push_back(fmt::format("{}: {:.10g} instead of {:.10g}", name, now, then));
    }
    return lines;
}

using Work = gpu_test::Test;

} // namespace

TEST_F(Work, OfEachCaseIsThatOfTheFile)
{
    const json now = measured_work();
    if (std::getenv("CICATRIX_WRITE_WORK"))
        base::write_json(CICATRIX_WORK, now);
    for (const std::string& change : changes(base::read_json(CICATRIX_WORK), now))
        ADD_FAILURE() << change << "; " << remake;
}

TEST(WorkChanges, AreToldFromFivePercentOn)
{
    const auto work = [](const char* driver, json passes, json fragment) {
        return json{{"driver", driver},
                    {"cases", {{"day", {{"passes", passes}, {"invocations", {{"fragment", fragment}}}}}}}};
    };
    const json before = work("a", 100, 1000);
    EXPECT_THAT(changes(before, before), testing::IsEmpty());
    EXPECT_THAT(changes(before, work("a", 104, 960)), testing::IsEmpty());
    EXPECT_THAT(changes(before, work("a", 106, 1000)),
                testing::ElementsAre("/day/passes: 106 instead of 100"));
    EXPECT_THAT(changes(before, work("a", 94, 1060)), testing::SizeIs(2));
    EXPECT_THAT(changes(before, work("b", 100, 5000)), testing::IsEmpty())
        << "another driver counts otherwise";
    EXPECT_THAT(changes(before, work("b", 200, 5000)), testing::SizeIs(1));
    EXPECT_THAT(changes(work("a", 0, 0), work("a", 1, 0)), testing::SizeIs(1))
        << "a still frame does nothing";
    EXPECT_THAT(changes(before, work("a", 100, nullptr)), testing::SizeIs(1)) << "no longer counted";
}
