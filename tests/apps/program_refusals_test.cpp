// The program as a process: every kind of bad input is refused with one line.
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

TEST_F(Program, ReportsAMissingVulkanDevice)
{
    expect_refusal(
        capture({"--head", head_}, {"VK_ICD_FILENAMES=/nonexistent", "VK_DRIVER_FILES=/nonexistent"}),
        {"Vulkan"});
}
