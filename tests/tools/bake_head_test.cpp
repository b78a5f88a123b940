// The steps that bake the default head, on shapes with known answers; the package itself is not needed.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <set>

#include "base/input_error.hpp"
#include "head/default_head.hpp"
#include "head/occlusion.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/head/bake_atlas.hpp"
#include "tools/head/bake_bust.hpp"
#include "tools/head/bake_head.hpp"
#include "tools/head/bake_skin.hpp"
#include "tools/head/bake_texture.hpp"
#include "tools/head/quad_mesh.hpp"

namespace {

using head_tool::QuadMesh;

bool near(glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-12)
{
    return glm::distance(a, b) <= tolerance;
}

bool has_vertex(const QuadMesh& mesh, glm::dvec3 place)
{
    return std::any_of(mesh.positions.begin(), mesh.positions.end(), [&](auto p) { return near(p, place); });
}

/// Corners (+-1, +-1, +-1); each face has texture coordinates of its own: six charts.
QuadMesh cube()
{
    QuadMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const std::array<std::array<std::uint32_t, 4>, 6> faces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& vertices : faces) {
        const auto first = static_cast<std::uint32_t>(mesh.uvs.size());
        mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        mesh.faces.push_back({vertices, {first, first + 1, first + 2, first + 3}});
    }
    return mesh;
}

/// `columns` x `rows` squares from the lower left `corner` on, parallel to z = 0; one chart with x and y as
/// texture coordinates.
QuadMesh sheet(int columns, int rows, double size, glm::dvec3 corner)
{
    QuadMesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            mesh.positions.push_back(corner + size * glm::dvec3(x, y, 0));
            mesh.uvs.emplace_back(mesh.positions.back());
        }
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (columns + 1) + x),
                       b = a + static_cast<std::uint32_t>(columns) + 1;
            mesh.faces.push_back({{a, a + 1, b + 1, b}, {a, a + 1, b + 1, b}});
        }
    return mesh;
}

TEST(CatmullClark, RefinesACubeToTheKnownVertices)
{
    const QuadMesh fine = head_tool::subdivide(cube());
    EXPECT_EQ(fine.positions.size(), 8u + 12u + 6u);
    EXPECT_EQ(fine.faces.size(), 24u);
    EXPECT_TRUE(has_vertex(fine, glm::dvec3(5.0 / 9.0)));
    EXPECT_TRUE(has_vertex(fine, {0.75, 0.75, 0}));
    EXPECT_TRUE(has_vertex(fine, {0, 0, -1}));
}

TEST(CatmullClark, ConvergesToASmoothClosedSurfaceThatFacesOutwards)
{
    QuadMesh mesh = cube();
    for (int step = 0; step < 3; ++step)
        mesh = head_tool::subdivide(mesh);
    EXPECT_EQ(mesh.positions.size(), mesh.faces.size() + 2); // Euler: V - E + F = 2 with E = 2 F
    for (const QuadMesh::Face& face : mesh.faces) {
        const auto at = [&](int c) { return mesh.positions[face.vertex[c]]; };
        EXPECT_GT(glm::dot(glm::cross(at(2) - at(0), at(3) - at(1)), at(0)), 0);
    }
}

TEST(CatmullClark, KeepsAFlatSheetFlatWithItsOutlineAndCoordinates)
{
    const QuadMesh fine = head_tool::subdivide(sheet(3, 2, 1.0, {0, 0, 0}));
    EXPECT_EQ(fine.faces.size(), 24u);
    for (const glm::dvec3& p : fine.positions)
        EXPECT_TRUE(p.z == 0 && p.x >= 0 && p.x <= 3 && p.y >= 0 && p.y <= 2);
    EXPECT_TRUE(has_vertex(fine, {1.5, 0, 0}));
    EXPECT_TRUE(has_vertex(fine, {1, 1, 0})); // inner vertices of a regular sheet stay
    std::set<std::pair<double, double>> uvs;
    for (const glm::dvec2& uv : fine.uvs)
        uvs.emplace(uv.x, uv.y);
    EXPECT_EQ(uvs.size(), 7u * 5u);
    EXPECT_TRUE(uvs.contains({0.5, 1.5}));
}

TEST(TextureCharts, AreNumberedByConnection)
{
    EXPECT_EQ(head_tool::texture_charts(cube()), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(head_tool::texture_charts(sheet(2, 1, 1.0, {0, 0, 0})), (std::vector<std::uint32_t>{0, 0}));
}

TEST(Bust, IsCutAtItsBaseAndNeighboursShareTheCut)
{
    const head_tool::CutMesh bust = head_tool::cut_bust(sheet(2, 40, 0.1, {-0.1, 4.8, 0.3}));
    ASSERT_FALSE(bust.head.empty());
    double lowest = 1e9, area = 0;
    std::set<std::pair<double, double>> places;
    std::set<std::uint32_t> vertices;
    for (const head_tool::CutMesh::Triangle& t : bust.head) {
        const auto at = [&](int c) { return bust.positions[t[c].vertex]; };
        area += 0.5 * glm::cross(at(1) - at(0), at(2) - at(0)).z;
        for (const head_tool::CutMesh::Corner& corner : t) {
            const glm::dvec3 p = bust.positions[corner.vertex];
            lowest = std::min(lowest, p.y);
            places.emplace(p.x, p.y);
            vertices.insert(corner.vertex);
            if (p.y < 8.7)
            { // texture coordinates equal positions, except that refinement rounds the outer corners
                EXPECT_TRUE(near({bust.uvs[corner.uv], 0.3}, p, 1e-9));
            }
        }
    }
    EXPECT_NEAR(lowest, 5.62, 1e-4);
    EXPECT_NEAR(area, 0.2 * (8.8 - 5.62), 2e-3);
    EXPECT_EQ(places.size(), vertices.size());
}

TEST(SkinAtlas, KeepsBothChartsSeparateUndistortedAndUnmirrored)
{
    head_tool::CutMesh bust;
    bust.uvs = {{0.64, 0.15}, {0.99, 0.15}, {0.99, 0.82}, {0.1, 0.85}, {0.6, 0.85}, {0.6, 0.97}};
    bust.positions.resize(6);
    bust.head = {{{{0, 0}, {1, 1}, {2, 2}}}};
    bust.torso = {{{{3, 3}, {4, 4}, {5, 5}}}};
    const head_tool::SkinAtlas atlas = head_tool::lay_out_skin(bust, 1024);
    for (int i = 0; i < 6; ++i) {
        const glm::dvec2 uv = i < 3 ? atlas.head(bust.uvs[i]) : atlas.bust(bust.uvs[i]);
        EXPECT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
        EXPECT_EQ(uv.x < atlas.border, i < 3);
    }
    // v points up in the figure and down in the atlas: an unmirrored map has a negative determinant.
    const double head = glm::determinant(atlas.head.linear), torso = glm::determinant(atlas.bust.linear);
    EXPECT_LT(head, 0);
    EXPECT_NEAR(torso, head, 1e-9);
}

TEST(SkinAtlas, PaintsThroughThePlacementAndFillsBlankTexels)
{
    head_tool::SkinAtlas atlas;
    atlas.size = 64;
    atlas.head = head_tool::as_painted;
    atlas.bust = head_tool::as_painted;
    atlas.border = 0.5;
    cv::Mat3b painting(64, 64, cv::Vec3b(120, 100, 80)); // its corner is the blank colour
    cv::circle(painting, {32, 32}, 20, cv::Scalar(200, 150, 120), cv::FILLED);
    const cv::Mat3b picture = head_tool::paint_skin(atlas, painting);
    EXPECT_EQ(picture(32, 32), cv::Vec3b(200, 150, 120));
    for (const cv::Vec3b& texel : picture)
        EXPECT_GT(texel[0], 190);
}

TEST(Occlusion, OfAFloorUnderADiscHasTheClosedForm)
{
    // Form factor of a coaxial disc of radius r at height h: r^2 / (r^2 + h^2).
    constexpr float r = 0.03f, h = 0.04f;
    constexpr int sides = 128;
    std::vector<glm::vec3> positions = {{0, h, 0}};
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < sides; ++i) {
        const float angle = 2 * static_cast<float>(M_PI) * static_cast<float>(i) / sides;
        positions.emplace_back(r * std::cos(angle), h, r * std::sin(angle));
        for (int v : {0, 1 + i, 1 + (i + 1) % sides})
            indices.push_back(static_cast<std::uint32_t>(v));
    }
    const head::Bvh bvh(positions, indices);
    const std::vector<glm::vec3> floor = {{0, 0, 0}}, up = {{0, 1, 0}}, down = {{0, -1, 0}};
    EXPECT_NEAR(head::ambient_occlusion(bvh, floor, up, 4096, 1.0f)[0], 1 - r * r / (r * r + h * h), 0.01);
    EXPECT_EQ(head::ambient_occlusion(bvh, floor, down, 256, 1.0f)[0], 1.0f);
    EXPECT_EQ(head::ambient_occlusion(bvh, floor, up, 256, 0.9f * h)[0], 1.0f); // out of reach
}

TEST(Occlusion, InsideAClosedBoxIsComplete)
{
    const head_tool::CutMesh box = head_tool::as_triangles(cube());
    std::vector<glm::vec3> positions(box.positions.begin(), box.positions.end());
    std::vector<std::uint32_t> indices;
    for (const head_tool::CutMesh::Triangle& t : box.head)
        for (const head_tool::CutMesh::Corner& corner : t)
            indices.push_back(corner.vertex);
    const head::Bvh bvh(positions, indices);
    const std::vector<glm::vec3> points = {{0, 0, 0}, {0.9f, 0.3f, -0.8f}, {0, 2, 0}},
                                 normals(3, glm::vec3(0, 1, 0));
    EXPECT_THAT(head::ambient_occlusion(bvh, points, normals, 256, 10.0f),
                testing::ElementsAre(0.0f, 0.0f, 1.0f));
}

TEST(Rasterise, CoversEveryTexelOfASquareAndInterpolatesLinearly)
{
    const std::vector<glm::vec2> uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 3, 2}; // the second one is wound the other way
    const std::vector<glm::vec3> values = {{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    cv::Mat1b covered;
    const cv::Mat3f texture = head_tool::rasterise(uvs, indices, values, {32, 16}, covered);
    EXPECT_EQ(cv::countNonZero(covered), 32 * 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_LT(cv::norm(texture(y, x) - cv::Vec3f((x + 0.5f) / 32, (y + 0.5f) / 16, 5)), 1e-5);
}

TEST(FillUncovered, SpreadsValuesAndKeepsTheCoveredOnes)
{
    cv::Mat3f texture(33, 47, cv::Vec3f(0, 0, 0));
    cv::Mat1b covered(texture.size(), uchar(0));
    texture(3, 4) = {1, 2, 3};
    texture(30, 40) = {3, 2, 1};
    covered(3, 4) = covered(30, 40) = 255;
    head_tool::fill_uncovered(texture, covered);
    EXPECT_EQ(texture(3, 4), cv::Vec3f(1, 2, 3));
    for (const cv::Vec3f& value : texture) {
        EXPECT_GE(value[0], 1 - 1e-5f);
        EXPECT_LE(value[0], 3 + 1e-5f);
        EXPECT_NEAR(value[1], 2, 1e-5);
    }
    EXPECT_LT(texture(4, 4)[0], texture(29, 40)[0]);
}

/// A flat patch of cheek, 0.25 mm a texel.
head_tool::SkinPlaces flat_cheek()
{
    head_tool::SkinPlaces places;
    places.position.create(256, 256);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            places.position(y, x) = {0.25f * static_cast<float>(x), -0.25f * static_cast<float>(y), 0};
    places.nose_tip = {-5, -30, 20};
    places.mouth = {-5, -200, 6};
    return places;
}

TEST(SkinDetail, GivesCheeksTheMeasuredMeanColour)
{
    const head_tool::SkinPictures skin =
        head_tool::detail_skin(cv::Mat3b(256, 256, cv::Vec3b(150, 140, 130)), flat_cheek());
    cv::Mat lab;
    cv::cvtColor(skin.color, lab, cv::COLOR_RGBA2RGB);
    lab.convertTo(lab, CV_32F, 1.0 / 255);
    cv::cvtColor(lab, lab, cv::COLOR_RGB2Lab);
    const cv::Scalar mean = cv::mean(lab); // Xiao et al. 2017, Caucasians, cheek
    EXPECT_NEAR(mean[0], 59.6, 1.0);
    EXPECT_NEAR(mean[1], 11.8, 1.0);
    EXPECT_NEAR(mean[2], 14.6, 1.0);
}

TEST(SkinDetail, ModulatesTheColourByAFewPercentAndIsRepeatable)
{
    const cv::Mat3b painted(256, 256, cv::Vec3b(200, 150, 125));
    const head_tool::SkinPictures first = head_tool::detail_skin(painted, flat_cheek()),
                                  second = head_tool::detail_skin(painted, flat_cheek());
    EXPECT_EQ(cv::norm(first.color, second.color, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(first.normal, second.normal, cv::NORM_INF), 0);
    cv::Scalar mean, deviation;
    cv::meanStdDev(first.color, mean, deviation);
    EXPECT_GT(deviation[1] / mean[1], 0.01);
    EXPECT_LT(deviation[1] / mean[1], 0.05);
    EXPECT_EQ(mean[3], 255);
}

TEST(SkinDetail, ReliefNormalsHaveUnitLengthAndNoMeanTilt)
{
    const cv::Mat3b painted(256, 256, cv::Vec3b(200, 150, 125));
    const head_tool::SkinPictures skin = head_tool::detail_skin(painted, flat_cheek());
    cv::Scalar mean, deviation;
    cv::meanStdDev(skin.normal, mean, deviation);
    EXPECT_NEAR(mean[0], 127.5, 1.5);
    EXPECT_NEAR(mean[1], 127.5, 1.5);
    EXPECT_GT(deviation[0], 4);
    for (const cv::Vec3b& texel : skin.normal)
        EXPECT_NEAR(cv::norm(cv::Vec3d(texel) / 127.5 - cv::Vec3d(1, 1, 1)), 1.0, 0.02);
}

TEST(SkinDetail, ADarkSpotIsAPitWithNormalsTiltedInwards)
{
    // Right of the middle of a pit the ground rises to the right, so the normal tilts left; above the middle,
    // downwards.
    cv::Mat3b painted(256, 256, cv::Vec3b(200, 150, 125));
    cv::circle(painted, {128, 128}, 4, cv::Scalar(120, 80, 60), cv::FILLED);
    const cv::Mat3b plain(256, 256, cv::Vec3b(200, 150, 125));
    const cv::Mat3b with = head_tool::detail_skin(painted, flat_cheek()).normal,
                    without = head_tool::detail_skin(plain, flat_cheek()).normal;
    EXPECT_LT(with(128, 132)[0], without(128, 132)[0] - 5);
    EXPECT_GT(with(128, 124)[0], without(128, 124)[0] + 5);
    EXPECT_LT(with(124, 128)[1], without(124, 128)[1] - 5);
    EXPECT_GT(with(132, 128)[1], without(132, 128)[1] + 5);
}

TEST(BakeHead, NamesTheMissingFileOfAPackage)
{
    const TemporaryFolder folder;
    try {
        head_tool::bake_head({folder.path(), {}}, folder / "head.glb", [](std::string_view) {});
        FAIL() << "accepted an empty folder";
    } catch (const base::InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("human_full_size.json: there is no such file"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "head.glb"));
}

TEST(BakeHead, PutsTheDefaultHeadIntoTheCacheFolder)
{
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string saved = before ? before : "";
    setenv("XDG_CACHE_HOME", "/somewhere", 1);
    EXPECT_EQ(head::default_head_path().string(),
              fmt::format("/somewhere/cicatrix/head-v{}.glb", head::default_head_version));
    before ? setenv("XDG_CACHE_HOME", saved.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

} // namespace
