// `cicatrix report` as a program, and the heads of its sweep over triangles.
#include <algorithm>
#include <gmock/gmock.h>

#include "apps/report/comparison.hpp"
#include "apps/report/mesh_density.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(MeshDensity, KeepsTheSurfaceAndReachesTheShare)
{
    const head::Model head = small::head();
    const auto area = [](const head::Model& model) {
        double sum = 0;
        for (std::size_t i = 0; i + 2 < model.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) { return model.vertices[model.indices[i + k]].position; };
            sum += glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
        }
        return sum;
    };
    const head::Model fine = report_command::subdivided(head);
    EXPECT_EQ(report_command::triangle_count(fine), 4 * report_command::triangle_count(head));
    EXPECT_NEAR(area(fine), area(head), 1e-4 * area(head));
    for (const head::Vertex& vertex : fine.vertices)
        ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4);
    for (const double share : {0.5, 0.125}) {
        const double reached =
            double(report_command::triangle_count(report_command::clustered(head, share))) /
            double(report_command::triangle_count(head));
        EXPECT_LE(reached, share);
        EXPECT_GT(reached, 0.4 * share);
        EXPECT_NEAR(area(report_command::clustered(head, share)), area(head), 0.15 * area(head));
    }
    for (const head::Material& material : report_command::with_small_pictures(head, 16).materials)
        EXPECT_LE(std::max({material.base_color.cols, material.normal.cols, material.occlusion.rows}), 16);
}

TEST(ReportCommand, WritesEverythingAndComparesWithItself)
{
    const TemporaryFolder folder;
    const std::string head = small::saved(small::head()).string(), out = (folder / "out").string();
    const Outcome first = run_program(
        {"report", "--head", head, "--size", "64x48", "--frames", "5", "--validation", "--out", out});
    ASSERT_EQ(first.code, 0) << first.err;
    for (const char* word : {"still: ", "camera: ", "day: ", "day-camera: ", "camera-lit: ", "light-drag: ",
                             "light-rest: ", "light-keep: ", "tissue: ", "read-back: ", "CPU ms", "forward",
                             "the passes explain", "report.html"})
        EXPECT_THAT(first.out, HasSubstr(word));
    const json record = report_command::read_report(folder / "out/report.json");
    EXPECT_EQ(record.at("settings").at("size"), "64x48");
    EXPECT_THAT(record.at("scene").dump(), Not(HasSubstr(std::filesystem::path(head).parent_path().string())))
        << "a report must not contain the paths of files";
    EXPECT_TRUE(std::filesystem::exists(folder / "out/trace.json"));
    const Outcome second = run_program({"report", "--head", head, "--size", "48x48", "--frames", "5", "--out",
                                        (folder / "again").string(), "--against", out + "/report.json"});
    ASSERT_EQ(second.code, 0) << second.err;
    EXPECT_THAT(second.out, testing::AllOf(HasSubstr("the size differs"), HasSubstr("ratio")));
    for (const auto& arguments : {std::vector<std::string>{"--against", (folder / "none.json").string()},
                                  {"--frames", "0"},
                                  {"--sweep", "days"}})
    {
        std::vector<std::string> all{"report", "--head", head, "--out", (folder / "refused").string()};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome refused = run_program(all);
        EXPECT_GE(refused.code, 1);
        EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "refused"));
    }
}
