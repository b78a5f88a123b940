// `cicatrix reference`, and `cicatrix compare --reference`.
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

class ReferenceCommand : public testing::Test
{
  protected:
    std::string scene(const std::string& rest)
    {
        return folder_.with("scene.json", fmt::format(R"({{"head": "{}", {}}})", head_.string(), rest))
            .string();
    }
    Outcome run(std::vector<std::string> arguments, std::vector<std::string> environment = {})
    {
        arguments.insert(arguments.end(), {"--out", (folder_ / "out").string()});
        environment.push_back("XDG_CACHE_HOME=" + (folder_ / "cache").string());
        return run_program(arguments, environment);
    }
    json read(const char* file) const { return base::read_json(folder_ / "out" / file); }

    const TemporaryFolder folder_;
    const std::filesystem::path head_ = small::saved(small::head());
};

TEST_F(ReferenceCommand, NeedsNoVulkanAndGoesOnFromTheCache)
{
    const std::string file = scene(R"("size": "32x32", "days": [0, 9])");
    const std::vector<std::string> no_vulkan{"VK_ICD_FILENAMES=/nowhere.json"};
    Outcome outcome = run({"reference", file, "--samples", "8"}, no_vulkan);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, testing::Not(HasSubstr("cicatrix:")));
    const json first = read("reference.json");
    EXPECT_EQ(first["samples"], 8);
    EXPECT_EQ(first["day"], 0);
    EXPECT_GT(first["noise_de"], 0);
    EXPECT_EQ(first["scene"]["wounds"].size(), 1u);
    for (const char* written : {"reference.exr", "reference.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / written)) << written;

    outcome = run({"reference", file, "--samples", "12"}, no_vulkan);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(read("reference.json")["samples"], 12);
    const json second = read("reference.json");
    EXPECT_GT(second["cpu_seconds"], first["cpu_seconds"]);
    // Good enough already: nothing is traced.
    outcome = run({"reference", file, "--samples", "8"}, no_vulkan);
    EXPECT_EQ(read("reference.json")["cpu_seconds"], second["cpu_seconds"]);
    EXPECT_EQ(read("reference.json")["samples"], 12);
}

TEST_F(ReferenceCommand, RefusesBadInputInOneLine)
{
    const std::string file = scene(R"("size": "32x32")"), huge = scene(R"("size": "16384x16384")");
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"reference", file, "--noise", "0"}, "--noise"},
        {{"reference", file, "--noise", "nan"}, "--noise"},
        {{"reference", file, "--samples", "0"}, "--samples"},
        {{"reference", file, "--seconds", "-1"}, "--seconds"},
        {{"reference", file, "--bounces", "1000"}, "--bounces"},
        {{"reference", file, "--anisotropy", "1"}, "--anisotropy"},
        {{"reference", file, "--view", "nowhere"}, "nowhere"},
        {{"reference", huge, "--samples", "8"}, "/size"},
        {{"reference", "missing.json"}, "missing.json"},
        {{"compare", file, file, "--reference"}, "--reference"},
        {{"compare", file, "--reference", "--noise", "0"}, "--noise"},
        {{"compare", file}, "--reference"},
        {{"compare", file, file, "--noise", "1"}, "--reference"},
    };
    for (const auto& [arguments, says] : cases) {
        const Outcome outcome = run(arguments);
        EXPECT_NE(outcome.code, 0) << says;
        EXPECT_THAT(outcome.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "reference.json")) << says;
    }
}

// Without shadows, ambient light, highlights and light under the skin both draw the same thing.
TEST_F(ReferenceCommand, LambertPictureIsThatOfTheRasteriser)
{
    const std::string file = scene(R"("size": "128x128", "days": [0], "wounds": [], "shading": {
        "transport": "lambert", "ward": false, "shadow": false, "ambient": [0, 0, 0]})");
    const Outcome outcome = run({"compare", file, "--reference", "--samples", "64", "--no-subsurface",
                                 "--bounces", "0", "--no-ambient", "--validation"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json regions = read("compare.json")["regions"];
    EXPECT_GT(regions["skin"]["pixels"], 2000);
    EXPECT_LT(regions["skin"]["mean"], .3);
    EXPECT_LT(regions["skin"]["noise"], .3);
    EXPECT_TRUE(regions["wound"].is_null());
}

TEST_F(ReferenceCommand, ComparisonReportsEachRegionApart)
{
    const std::string file = scene(R"("size": "96x96", "days": [0, 40], "wounds": [{"width_mm": 40}],
        "lights": [{"azimuth_deg": -60, "elevation_deg": 20}])");
    const Outcome outcome = run({"compare", file, "--reference", "--samples", "16", "--validation"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json record = read("compare.json");
    ASSERT_EQ(record["days"].size(), 2u);
    const json open = record["days"][0]["regions"], closed = record["days"][1]["regions"];
    EXPECT_GT(open["wound"]["pixels"], 50);
    EXPECT_TRUE(open["ring"].is_null());
    EXPECT_TRUE(closed["wound"].is_null());
    EXPECT_GT(closed["ring"]["pixels"], 50);
    EXPECT_EQ(record["regions"]["skin"]["pixels"],
              open["skin"]["pixels"].get<int>() + closed["skin"]["pixels"].get<int>());
    for (const char* number : {"mean", "p95", "p999", "max", "noise"})
        EXPECT_GT(record["regions"]["shadow_edges"][number], 0) << number;
    EXPECT_GT(record["days"][0]["flip"]["mean_on_head"], 0);
    for (const char* picture :
         {"compare.png", "day_000_ours.png", "day_000_reference.png", "day_000_difference.png",
          "day_000_lightness.png", "day_000_flip.png", "day_040_regions.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / picture)) << picture;
}

} // namespace
