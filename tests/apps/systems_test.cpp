// `cicatrix compare --systems`: which systems, what the page claims of them, and one small run.
#include "apps/compare/systems.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;

json system_of(const char* name, double ms, double error)
{
    json one{{"name", name}, {"runs_on", "gpu"}, {"source", "s"}, {"paper_fps", "1"}, {"cannot", "nothing"}};
    for (const char* moved : {"still", "camera", "light", "day"}) {
        one["cpu_ms"][moved] = ms;
        one["ratio_to_ward"][moved] = ms / 10; // Ward's: 10 ms
    }
    for (const char* region : {"skin", "wound", "shadow_edges", "thin"})
        one["error"][region] = {{"mean", error}, {"p95", 2 * error}};
    return one;
}

std::optional<bool> holds(const json& claims, const std::string& what)
{
    for (const json& claim : claims)
        if (claim["claim"].get<std::string>().find(what) != std::string::npos)
            return claim["holds"].get<bool>();
    return {};
}

TEST(Systems, AreWardsTheTableOfTransportsAndTheRivals)
{
    const optics::Shading own = optics::skin_shading();
    const std::vector<compare_command::System> systems = compare_command::all_systems(own);
    EXPECT_EQ(systems.size(), 1 + optics::transport_names.size() + reference::rival_names.size());
    EXPECT_EQ(systems.front().name, "ward");
    EXPECT_EQ(systems.front().shading->transport, optics::Transport::Lambert);
    EXPECT_EQ(systems.front().shading->specular_model, optics::SpecularModel::Ward);
    EXPECT_EQ(systems.front().shading->ambient, own.ambient) << "in the scene's light";
    for (const compare_command::System& system : systems) {
        EXPECT_NE(system.shading.has_value(), system.method.has_value()) << system.name;
        EXPECT_EQ(system.name.find('_'), std::string::npos);
        EXPECT_FALSE(compare_command::facts_of(system.name).source.empty());
    }
    const auto diffused = std::ranges::find(systems, "diffused", &compare_command::System::name);
    ASSERT_NE(diffused, systems.end());
    EXPECT_EQ(diffused->shading->specular_model, own.specular_model);
}

TEST(Systems, ClaimsFollowFromTheNumbers)
{
    const json systems{system_of("ward", 10, 3), system_of("published", 10.1, 3),
                       system_of("diffused", 12, .6), system_of("chang", 60, .9), system_of("li", 600, .5)};
    const json claims = compare_command::claims_of(systems);
    EXPECT_EQ(holds(claims, "less than 2 % more than `ward` while the camera"), true);
    EXPECT_EQ(holds(claims, "`published` is 5.7 times as fast as `chang`"), true);
    EXPECT_EQ(holds(claims, "`published` is nearer to the truth than `chang`"), false);
    EXPECT_EQ(holds(claims, "`diffused` is 5.7 times as fast as `chang` while the light"), false)
        << "5 times";
    EXPECT_EQ(holds(claims, "`diffused` is nearer to the truth than `chang`"), true);
    EXPECT_EQ(holds(claims, "`diffused` is 11.4 times as fast as `li`"), true);
    EXPECT_EQ(holds(claims, "`diffused` is nearer to the truth than `li`"), false);
    EXPECT_EQ(holds(claims, "`shah`"), std::nullopt) << "not measured";

    const json record{{"device", "d"},      {"software_rasteriser", true},
                      {"size", "1x1"},      {"day", 0},
                      {"rounds", 9},        {"noise_de", .5},
                      {"load", 1.},         {"interrupted", false},
                      {"systems", systems}, {"claims", claims}};
    const std::string page = compare_command::systems_page(record, "images/rivals.jpg");
    EXPECT_THAT(page, HasSubstr("| `chang` | gpu | 60.0 | 60.0 | 60.0 | 60.0 | 6.00 | 6.00 |"));
    EXPECT_THAT(page, HasSubstr("**does not hold** | `diffused` is 5.7 times as fast as `chang`"));
    EXPECT_THAT(page, HasSubstr("nothing is said of them: `oren-nayar`, `shah`"));
}

/// Skin through which light goes so far that the rivals' samples are few, and no wound, whose tissue takes
/// photon walks.
TEST(Systems, OneSmallRunMeasuresThemAll)
{
    const TemporaryFolder folder;
    folder.with("tissue.json", R"({"unit": "1/mm", "layers": [{"sigma_a": [0.002, 0.006, 0.01],
        "sigma_s_reduced": [0.1, 0.1, 0.1], "n": 1.4, "thickness_mm": "inf"}]})");
    const std::string scene =
        folder
            .with("scene.json",
                  fmt::format(R"({{"head": "{}", "tissue": "{}", "wounds": [], "days": [0]}})",
                              small::saved(small::head()).string(), (folder / "tissue.json").string()))
            .string();
    const Outcome outcome = run_program({"compare", scene, "--systems", "--size", "48x48", "--samples", "8",
                                         "--rounds", "1", "--out", (folder / "out").string(), "--document",
                                         (folder / "page" / "rivals.md").string()},
                                        {"XDG_CACHE_HOME=" + (folder / "cache").string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json record = base::read_json(folder / "out" / "systems.json");
    EXPECT_FALSE(record["interrupted"].get<bool>());
    EXPECT_GT(record["claims"].size(), 4u);
    for (const json& one : record["systems"]) {
        const std::string name = one["name"];
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / (name + ".png"))) << name;
        EXPECT_GT(one["memory_mb"], 0) << name;
        EXPECT_GT(one["error"]["skin"]["mean"], 0) << name;
        EXPECT_LT(one["error"]["skin"]["mean"], 20) << name;
        for (const char* moved : {"camera", "light", "day"})
            EXPECT_GT(one["cpu_ms"][moved], 0) << name;
    }
    EXPECT_EQ(record["systems"][0]["ratio_to_ward"]["camera"], 1);
    EXPECT_EQ(record["systems"].back()["name"], "reference");
    EXPECT_TRUE(std::filesystem::exists(folder / "page" / "rivals.md"));
    EXPECT_TRUE(std::filesystem::exists(folder / "page" / "images" / "rivals.jpg"));
}

TEST(Systems, RefuseASecondSceneAndOptionsWithoutATruth)
{
    Outcome outcome = run_program({"compare", "a.json", "b.json", "--systems"});
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("takes one scene"));
    outcome = run_program({"compare", "a.json", "b.json", "--noise", "1"});
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("--reference or --systems"));
    outcome = run_program({"compare"});
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("scene"));
}

} // namespace
