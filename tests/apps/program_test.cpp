// The program as a process: a capture end to end, and the other commands.
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
#include "program_fixture.hpp"
#include "scene/file.hpp"
#include "scene/scene.hpp"

using namespace program_test;
using nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

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
    // The picture and its shadow follow the camera, which goes between the picture and the strip's close-up;
    // so does the light that spreads, on texels no finer than the pixels of either.
    EXPECT_THAT(skipped,
                UnorderedElementsAre("wound_texture", "wound_relief", "reflectance_lut", "skin shadow"));

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
