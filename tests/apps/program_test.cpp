// The program as a process: a capture end to end, the other commands, and every kind of bad input.
#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>

#include "base/image_io.hpp"
#include "scene/file.hpp"
#include "scene/scene.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> files_in(const std::filesystem::path& folder)
{
    std::set<std::string> names;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            names.insert(entry.path().filename().string());
    return names;
}

/// Plain skin with a round wound of `radius` pixels.
cv::Mat3b photo(int side = 128, int radius = 24)
{
    cv::Mat3b picture(side, side, cv::Vec3b(208, 162, 140));
    cv::circle(picture, {side / 2, side / 2}, radius, {140, 40, 36}, cv::FILLED);
    return picture;
}

cv::Mat1b disc(int side, cv::Point middle, int radius)
{
    cv::Mat1b mask = cv::Mat1b::zeros(side, side);
    cv::circle(mask, middle, radius, 255, cv::FILLED);
    return mask;
}

class Program : public testing::Test
{
  protected:
    std::string file(std::string_view name) const { return (folder_ / name).string(); }
    std::string with(std::string_view name, std::string_view bytes) const
    {
        return folder_.with(name, bytes).string();
    }
    template <typename Picture>
    std::string with_png(std::string_view name, const Picture& picture) const
    {
        base::write_png(folder_ / name, picture);
        return file(name);
    }

    /// A capture with the arguments `more`.
    Outcome capture(const std::vector<std::string>& more,
                    const std::vector<std::string>& environment = {}) const
    {
        std::vector<std::string> arguments{"capture", "--out", file("out"), "--no-cost"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments, environment);
    }
    /// The same on the small head.
    Outcome on_the_head(std::vector<std::string> more) const
    {
        more.insert(more.end(), {"--head", head_});
        return capture(more);
    }

    /// One line on stderr that holds all of `words`, a failing exit code, and nothing in the output folder.
    void expect_refusal(const Outcome& outcome, const std::vector<std::string>& words) const
    {
        EXPECT_GE(outcome.code, 1) << outcome.err;
        EXPECT_LT(outcome.code, 126) << "ended by a signal or not started: " << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("cicatrix")) << outcome.err;
        for (const std::string& word : words)
            EXPECT_THAT(outcome.err, HasSubstr(word));
        EXPECT_THAT(files_in(file("out")), testing::IsEmpty()) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }

    TemporaryFolder folder_;
    const std::string head_ = small::saved(small::head()).string();
};

} // namespace

TEST_F(Program, CapturesAHealingWound)
{
    const Outcome outcome = on_the_head({"--size", "160x120", "--days", "0,5,5"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(files_in(file("out")), UnorderedElementsAre("day_000.png", "day_005.png", "day_005_2.png",
                                                            "healing.png", "capture.json"));
    EXPECT_EQ(base::read_rgb(file("out/day_000.png")).size(), cv::Size(160, 120));
    EXPECT_EQ(bytes_of(file("out/day_005.png")), bytes_of(file("out/day_005_2.png")));
    EXPECT_NE(bytes_of(file("out/day_000.png")), bytes_of(file("out/day_005.png")));
    EXPECT_GT(base::read_rgb(file("out/healing.png")).total(), 3u * 160 * 120);

    const json record = json::parse(bytes_of(file("out/capture.json")));
    EXPECT_NE(record.at("device"), "");
    EXPECT_NE(record.at("driver"), "");
    EXPECT_EQ(record.at("size"), json({160, 120}));
    ASSERT_EQ(record.at("days").size(), 3u);
    for (const json& day : record.at("days")) {
        EXPECT_TRUE(std::filesystem::exists(folder_ / ("out/" + day.at("file").get<std::string>())));
        EXPECT_GT(day.at("frame_ms"), 0);
        const double unhealed = day.at("unhealed_ratio");
        EXPECT_NEAR(day.at("recovery_ratio"), 1 - unhealed, 1e-12);
        EXPECT_NEAR(day.at("mask_area_ratio"), unhealed, 0.005);
        for (const json& pass : day.at("passes")) {
            EXPECT_TRUE(pass.at("name").is_string());
            EXPECT_THAT(pass.at("state").get<std::string>(), testing::AnyOf("ran", "skipped", "culled"));
            EXPECT_TRUE(pass.at("gpu_ms").is_number() || pass.at("gpu_ms").is_null());
            EXPECT_GE(pass.at("cpu_ms"), 0);
        }
    }
    EXPECT_EQ(record["days"][0]["unhealed_ratio"], 1);
    EXPECT_LT(record["days"][1]["unhealed_ratio"], 0.9);
    std::set<std::string> skipped;
    for (const json& pass : record["days"][2]["passes"])
        if (pass["state"] == "skipped")
            skipped.insert(pass["name"]);
    // The picture and its shadow follow the camera, which goes between the picture and the strip's close-up.
    EXPECT_THAT(skipped, UnorderedElementsAre("wound_texture", "wound_relief", "reflectance_lut"));

    const std::filesystem::path scene = folder_.with("recorded.json", record.at("scene").dump());
    EXPECT_EQ(scene::to_json(scene::read_scene(scene)), record.at("scene"));
}

TEST_F(Program, CapturesInPublishedModeWithAPhotographAndItsMask)
{
    const Outcome outcome = on_the_head({"--size", "64x64", "--days", "9", "--mode", "published", "--msaa",
                                         "--wound", with_png("photo.png", photo()), "--mask",
                                         with_png("mask.png", disc(128, {64, 64}, 24))});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(files_in(file("out")), testing::Contains("day_009.png"));
}

TEST_F(Program, RecordsTheSceneWoundOfEachWound)
{
    const cv::Mat1b two = disc(128, {40, 64}, 24) | disc(128, {100, 64}, 12);
    cv::Mat3b picture(two.size(), cv::Vec3b(208, 162, 140));
    picture.setTo(cv::Vec3b(140, 40, 36), two);
    with_png("photo.png", picture);
    with_png("mask.png", two);
    const std::string scene =
        with("scene.json", R"({"wounds": [{"photo": "photo.png", "mask": "mask.png"}, {"at": "forehead"}]})");
    const Outcome outcome = on_the_head({scene, "--size", "64x64", "--days", "5"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json wounds = json::parse(bytes_of(file("out/capture.json"))).at("days").at(0).at("wounds");
    ASSERT_EQ(wounds.size(), 3u);
    for (int i : {0, 1, 2}) {
        EXPECT_EQ(wounds[i].at("scene_wound"), i == 2 ? 1 : 0);
        EXPECT_NEAR(wounds[i].at("mask_area_ratio"), wounds[i].at("unhealed_ratio").get<double>(), 0.005);
    }
}

TEST_F(Program, PrintsItsScheduleAsTextAndGraphviz)
{
    const Outcome outcome = run_program(
        {"graph", "--head", head_, "--size", "64x64", "--days", "3,3", "--dot", file("frame.dot")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* word : {"wound_texture", "wound_relief", "reflectance_lut", "shadow", "forward",
                             "tonemap", "64 x 64", "unchanged"})
        EXPECT_THAT(outcome.out, HasSubstr(word));
    EXPECT_THAT(bytes_of(file("frame.dot")),
                testing::AllOf(testing::StartsWith("digraph"), HasSubstr("tonemap"), HasSubstr("}")));
}

TEST_F(Program, ListsDevicesAndExplainsItsCommands)
{
    const Outcome info = run_program({"info"});
    EXPECT_EQ(info.code, 0) << info.err;
    EXPECT_NE(info.out, "");
    const Outcome all = run_program({"--help"});
    EXPECT_EQ(all.code, 0);
    int commands = 0;
    std::istringstream lines(all.out.substr(std::min(all.out.find("Subcommands:"), all.out.size())));
    for (std::string line; std::getline(lines, line);) {
        std::string command;
        if (!line.starts_with("  ") || line.starts_with("   ") || !(std::istringstream(line) >> command))
            continue;
        ++commands;
        const Outcome help = run_program({command, "--help"});
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_THAT(help.out, HasSubstr("Usage")) << command;
        EXPECT_EQ(help.err, "") << command;
    }
    EXPECT_GE(commands, 4) << all.out;
}

TEST_F(Program, RefusesBrokenHeads)
{
    const std::string glb = bytes_of(head_);
    expect_refusal(capture({"--head", file("none.glb")}), {"none.glb"});
    expect_refusal(capture({"--head", with("half.glb", glb.substr(0, glb.size() / 2))}), {"half.glb"});
    expect_refusal(capture({"--head", with("text.glb", "not a head at all")}), {"text.glb"});
    expect_refusal(capture({"--head", with("broken.gltf", R"({"asset": {"version": "2.0"}, "meshes": [)")}),
                   {"broken.gltf"});
    expect_refusal(capture({"--head", with("empty.gltf", R"({"asset": {"version": "2.0"}})")}),
                   {"empty.gltf"});
}

TEST_F(Program, RefusesBrokenPhotographs)
{
    const std::string png = bytes_of(with_png("photo.png", photo()));
    std::vector<uchar> encoded;
    cv::imencode(".jpg", photo(), encoded);
    const std::string jpeg(encoded.begin(), encoded.end());
    expect_refusal(on_the_head({"--wound", file("none.png")}), {"none.png"});
    expect_refusal(on_the_head({"--wound", with("half.png", png.substr(0, png.size() / 2))}), {"half.png"});
    expect_refusal(on_the_head({"--wound", with("half.jpg", jpeg.substr(0, jpeg.size() / 2))}), {"half.jpg"});
    expect_refusal(on_the_head({"--wound", with("text.jpg", "not a photograph")}), {"text.jpg"});
    expect_refusal(on_the_head({"--wound", with_png("plain.png", photo(128, 0))}),
                   {"plain.png", "no wound", "mask"});
}

TEST_F(Program, RefusesBrokenMasks)
{
    const std::string wound = with_png("photo.png", photo());
    const auto refused = [&](const std::string& mask, const std::vector<std::string>& words) {
        expect_refusal(on_the_head({"--wound", wound, "--mask", mask}), words);
    };
    refused(file("none.png"), {"none.png"});
    refused(with("text.png", "not a mask"), {"text.png"});
    refused(with_png("empty.png", disc(128, {-99, -99}, 1)), {"empty.png", "empty"});
    refused(with_png("other.png", disc(64, {32, 32}, 12)), {"other.png", "64x64", "128x128"});
    expect_refusal(on_the_head({"--mask", with_png("mask.png", disc(128, {64, 64}, 24))}),
                   {"--mask", "--wound"});
    expect_refusal(run_program({"warps", file("empty.png"), "--out", file("out")}, {}, "cicatrix-lab"),
                   {"empty.png", "empty"});
}

TEST_F(Program, AcceptsAPhotographWithoutSkinAndNotesItsAssumption)
{
    const std::string wound = with_png("photo.png", cv::Mat3b(photo()(cv::Rect(48, 48, 32, 32)))),
                      mask = with_png("full.png", cv::Mat1b(32, 32, 255));
    const auto expect_note = [&](const Outcome& outcome, const std::string& picture) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const std::string note = "note: " + wound + ": shows no healthy skin";
        EXPECT_THAT(outcome.err, HasSubstr(note));
        EXPECT_EQ(outcome.err.find(note), outcome.err.rfind(note)) << "the note must appear once";
        EXPECT_THAT(files_in(file("out")), testing::Contains(picture));
    };
    expect_note(run_program({"wound", wound, "--mask", mask, "--out", file("out")}), "wound.json");
    EXPECT_EQ(json::parse(bytes_of(folder_ / "out/wound.json"))["shows_skin"], false);
    expect_note(on_the_head({"--size", "64x64", "--days", "9", "--wound", wound, "--mask", mask}),
                "day_009.png");
}

TEST_F(Program, RefusesBrokenScenes)
{
    expect_refusal(capture({file("none.json")}), {"none.json"});
    const auto refused = [&](const std::string& text, const std::string& field) {
        expect_refusal(capture({with("scene.json", text)}), {"scene.json", field});
    };
    refused("{\n \"size\": \"64x64\",\n \"days\": [0,", "line 3");
    refused(R"({"wounds": [{"width": 3}]})", "/wounds/0/width");
    refused(R"({"wounds": [{"width_mm": -3}]})", "/wounds/0/width_mm");
    refused(R"({"exposure_stops": NaN})", "JSON");
    refused(R"({"views": [{"name": "a/b"}]})", "/views/0/name");
    refused(R"({"views": ["front", "front"]})", "/views/1");
    refused(R"({"camera": {"fov_deg": 1e999}})", "1e999");
    expect_refusal(capture({with("scene.json", R"({"tissue": "none.json"})"), "--head", head_}),
                   {"none.json"});
}

TEST_F(Program, RefusesSenselessOptions)
{
    expect_refusal(on_the_head({"--size", "0x0"}), {"--size", "0x0"});
    expect_refusal(on_the_head({"--size", "100000x100000"}), {"--size", "100000x100000"});
    expect_refusal(on_the_head({"--days", "0,nan"}), {"--days", "nan"});
    expect_refusal(on_the_head({"--days", "-1"}), {"--days", "-1"});
    expect_refusal(on_the_head({"--mode", "fancy"}), {"--mode", "fancy"});
    expect_refusal(on_the_head({"--device", "no such device"}), {"no such device"});
    expect_refusal(on_the_head({"--views", "front,lefft"}), {"--views", "lefft", "left"});
    expect_refusal(on_the_head({"--tile", "77"}), {"--tile", "77"});
    expect_refusal(on_the_head({"--no-such-option"}), {"--no-such-option", "--help"});
    expect_refusal(run_program({"paint"}), {"paint", "--help"});
    expect_refusal(run_program({}), {"--help"});
}

TEST_F(Program, RefusesInvalidAndOutOfRangeNumbers)
{
    const auto refused = [&](std::vector<std::string> arguments) {
        const std::vector<std::string> words(arguments.end() - 2, arguments.end());
        expect_refusal(run_program(arguments), words);
    };
    const std::string out = file("out");
    for (const std::string number : {"nan", "inf", "-1", "1e999", "3651", "7x", ""})
        refused({"bake", "--out", out, "--size", "2x2", "--last-day", number});
    refused({"capture", "--out", out, "--orbit-degrees", "nan"});
    refused({"capture", "--out", out, "--duration", "nan"});
    refused({"capture", "--out", out, "--fps", "nan"});
    refused({"capture", "--out", out, "--orbit", "1.5"});
    refused({"wound", "photo.png", "--out", out, "--width-mm", "nan"});
    refused({"wound", "photo.png", "--out", out, "--spacing", "nan"});
    refused({"demo", "--scale", "nan"});
    refused({"reflect", "light", "--seed", "-1"});
    refused({"reflect", "light", "--photons", "1"}); // one photon has no standard error
    refused({"reflect", "light", "--photons", "2.5"});
    refused({"batch", "--random", "3", "--seed", "-1"});
    expect_refusal(run_program({"reflect", "light", "--photons", "1e12"}), {"2 to 1e10"});
    const Outcome whole = run_program({"reflect", "table1", "--model", "monte-carlo", "--photons", "1e4"});
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_EQ(whole.out,
              run_program({"reflect", "table1", "--model", "monte-carlo", "--photons", "10000"}).out);
    EXPECT_GT(json::parse(whole.out).at("standard_error").at(0).get<double>(), 0);
}

TEST_F(Program, RefusesTissueItDoesNotKnow)
{
    const auto refused = [&](const std::string& tissue, std::vector<std::string> words) {
        words.push_back(tissue);
        expect_refusal(run_program({"reflect", tissue}), words);
        expect_refusal(run_program({"bake", "--out", file("out"), "--tissue", tissue}), words);
    };
    refused(folder_.path().string(), {"not a regular file"});
    refused("bruise", {"table1, light, medium, dark"});
    refused(with("huge.json", R"({"unit": "1/mm", "layers": [{"n": 1e999}]})"), {"out of range", "1e999"});
    refused(with("half.json", R"({"unit": "1/mm",)"), {"not valid JSON", "line 1"});
    refused(with("unknown.json", R"({"unit": "1/mm", "layers": [], "colour": 1})"), {"/colour"});
    expect_refusal(run_program({"reflect", "bruise"}), {"bruise-12"});
    expect_refusal(run_program({"bake", "--out", file("out"), "--tissue", "granulation"}),
                   {"granulation", "light"});
    expect_refusal(run_program({"fit", folder_.path().string(), "--out", file("out")}),
                   {folder_.path().string(), "not a regular file"});
}

TEST_F(Program, RefusesAnOutputFolderItCannotWrite)
{
    const std::string below_a_file = with("file", "in the way") + "/out";
    expect_refusal(run_program({"capture", "--head", head_, "--no-cost", "--out", below_a_file}),
                   {below_a_file, "--out"});
    EXPECT_EQ(bytes_of(file("file")), "in the way");
    Outcome graph =
        run_program({"graph", "--head", head_, "--days", "0", "--size", "64x64", "--dot", below_a_file});
    graph.out.clear(); // ignores the text printed before the error
    expect_refusal(graph, {below_a_file});
}

TEST_F(Program, RefusesFilmsItCannotMake)
{
    const std::string film = file("film.mp4");
    expect_refusal(on_the_head({"--video", file("film.avi")}), {"--video", "film.avi", ".mp4"});
    expect_refusal(on_the_head({"--video", film, "--days", "3"}), {"--video", "day 3", "--orbit"});
    expect_refusal(on_the_head({"--video", film, "--transparent"}), {"--transparent", "--video"});
    expect_refusal(on_the_head({"--video", film, "--fps", "0"}), {"--fps"});
    const std::vector<std::string> short_film{"--head", head_,    "--video", film,         "--size",
                                              "64x64",  "--days", "0,30",    "--duration", ".2"};
    expect_refusal(capture(short_film, {"PATH=/nonexistent"}), {"ffmpeg", "apt-get install ffmpeg"});

    // An ffmpeg that fails in the middle of a picture.
    const std::filesystem::path tools = folder_ / "tools", script = tools / "ffmpeg";
    std::filesystem::create_directory(tools);
    std::ofstream(script) << "#!/bin/sh\nhead -c 1000 >/dev/null\necho 'Unknown encoder' >&2\nexit 3\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const Outcome failed = capture(short_film, {"PATH=" + tools.string() + ":/usr/bin:/bin"});
    EXPECT_EQ(failed.code, 1);
    EXPECT_THAT(failed.err,
                testing::AllOf(HasSubstr("film.mp4"), HasSubstr("Unknown encoder"), HasSubstr("libx264")));
    for (const std::string& name : files_in(folder_.path()))
        EXPECT_THAT(name, testing::Not(testing::EndsWith(".mp4")));
}

// The ffmpeg of this test interrupts the program during the film, like Ctrl-C.
TEST_F(Program, LeavesNoPartialFilesWhenItIsStopped)
{
    const std::filesystem::path tools = folder_ / "tools", script = tools / "ffmpeg";
    std::filesystem::create_directory(tools);
    std::ofstream(script)
        << "#!/bin/sh\nfor film; do :; done\nhead -c 1000 >\"$film\"\nkill -INT $PPID\ncat >/dev/null\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const Outcome stopped = capture({"--head", head_, "--video", file("film.mp4"), "--size", "64x64",
                                     "--days", "0,30", "--duration", "60"},
                                    {"PATH=" + tools.string() + ":/usr/bin:/bin"});
    EXPECT_EQ(stopped.code, 130);
    EXPECT_THAT(stopped.err, testing::EndsWith("cicatrix: stopped\n"));
    for (const std::string& name : files_in(folder_.path()))
        EXPECT_THAT(name, testing::Not(HasSubstr("film")));
}

TEST_F(Program, ReportsAMissingVulkanDevice)
{
    expect_refusal(
        capture({"--head", head_}, {"VK_ICD_FILENAMES=/nonexistent", "VK_DRIVER_FILES=/nonexistent"}),
        {"Vulkan"});
}

TEST_F(Program, AcceptsAHeadWithoutNormalsUvsOrTexturesAndNotesIt)
{
    const head::Model model = small::head();
    std::string bytes;
    for (const head::Vertex& vertex : model.vertices)
        bytes.append(reinterpret_cast<const char*>(&vertex.position), sizeof vertex.position);
    const std::size_t positions = bytes.size(), indices = model.indices.size() * sizeof(std::uint32_t);
    bytes.append(reinterpret_cast<const char*>(model.indices.data()), indices);
    with("head.bin", bytes);
    const json gltf{
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", model.vertices.size()},
           {"type", "VEC3"},
           {"min", {-1, -1, -1}},
           {"max", {1, 1, 1}}},
          {{"bufferView", 1}, {"componentType", 5125}, {"count", model.indices.size()}, {"type", "SCALAR"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteLength", positions}},
          {{"buffer", 0}, {"byteOffset", positions}, {"byteLength", indices}}}},
        {"buffers", {{{"byteLength", bytes.size()}, {"uri", "head.bin"}}}}};
    const Outcome outcome =
        capture({"--head", with("bare.gltf", gltf.dump()), "--size", "64x64", "--days", "0"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("bare.gltf"), HasSubstr("normals")));
}
