// Heads from glTF files: what is read, computed and written.
#include "head/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/gltf_document.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using head::Model;

class ModelFile : public testing::Test
{
  protected:
    Model load(const GltfDocument& document)
    {
        return head::load_model(folder_.with("head.glb", document.glb()));
    }
    TemporaryFolder folder_;
};

bool near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-5f)
{
    return glm::distance(a, b) <= tolerance;
}

bool has_note(const Model& model, std::string_view words)
{
    for (const std::string& note : model.notes)
        if (note.find(words) != std::string::npos)
            return true;
    return false;
}

glm::vec3 face_normal(const Model& model, std::size_t triangle)
{
    const auto at = [&](int c) { return model.vertices[model.indices[3 * triangle + c]].position; };
    return glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
}

TEST_F(ModelFile, RoundTripKeepsEverything)
{
    Model model;
    for (int i = 0; i < 6; ++i) {
        const float x = static_cast<float>(i % 3), y = static_cast<float>(i / 3);
        model.vertices.push_back({{x, y, 0.1f * x},
                                  glm::normalize(glm::vec3(-0.1f, 0, 1)),
                                  glm::vec4(glm::normalize(glm::vec3(1, 0, 0.1f)), i % 2 ? 1.0f : -1.0f),
                                  {x / 2, 1 - y}});
    }
    model.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    model.primitives = {{0, 6, 0}, {6, 6, 1}};
    model.min = {0, 0, 0};
    model.max = {2, 1, 0.2f};
    head::Material skin, lash;
    skin.name = "skin";
    skin.base_color = cv::Mat4b(8, 4, cv::Vec4b(200, 150, 100, 255));
    skin.base_color(3, 2) = {1, 2, 3, 255};
    skin.normal = cv::Mat3b(4, 4, cv::Vec3b(128, 120, 255));
    skin.normal_scale = 0.75f;
    skin.occlusion = cv::Mat1b(2, 2, uchar(77));
    skin.roughness = 0.375f;
    lash.name = "eyelash";
    lash.base_color = cv::Mat4b(2, 2, cv::Vec4b(9, 8, 7, 60));
    lash.base_color_factor = {0.5f, 0.25f, 1.0f, 0.75f};
    lash.alpha = head::AlphaMode::Mask;
    lash.alpha_cutoff = 0.25f;
    lash.double_sided = true;
    model.materials = {skin, lash};

    head::save_model(folder_ / "copy.glb", model);
    const Model copy = head::load_model(folder_ / "copy.glb");

    // Vertices are renumbered by first use; corners must be equal.
    ASSERT_EQ(copy.indices.size(), model.indices.size());
    for (std::size_t i = 0; i < model.indices.size(); ++i) {
        const head::Vertex &a = model.vertices[model.indices[i]], &b = copy.vertices[copy.indices[i]];
        EXPECT_EQ(a.position, b.position);
        EXPECT_TRUE(near(a.normal, b.normal));
        EXPECT_TRUE(near(glm::vec3(a.tangent), glm::vec3(b.tangent)));
        EXPECT_EQ(a.tangent.w, b.tangent.w);
        EXPECT_EQ(a.uv, b.uv);
    }
    ASSERT_EQ(copy.primitives.size(), 2u);
    EXPECT_EQ(copy.primitives[1].first_index, 6u);
    EXPECT_EQ(copy.min, model.min);
    EXPECT_EQ(copy.max, model.max);
    EXPECT_TRUE(copy.notes.empty());
    ASSERT_EQ(copy.materials.size(), 2u);
    EXPECT_EQ(copy.materials[0].name, "skin");
    EXPECT_EQ(copy.materials[0].base_color(3, 2), cv::Vec4b(1, 2, 3, 255));
    EXPECT_EQ(copy.materials[0].normal(1, 1), cv::Vec3b(128, 120, 255));
    EXPECT_EQ(copy.materials[0].normal_scale, 0.75f);
    EXPECT_EQ(copy.materials[0].occlusion(1, 1), 77);
    EXPECT_EQ(copy.materials[0].roughness, 0.375f);
    EXPECT_EQ(copy.materials[1].base_color(0, 0), cv::Vec4b(9, 8, 7, 60));
    EXPECT_EQ(copy.materials[1].base_color_factor, glm::vec4(0.5f, 0.25f, 1.0f, 0.75f));
    EXPECT_EQ(copy.materials[1].alpha, head::AlphaMode::Mask);
    EXPECT_EQ(copy.materials[1].alpha_cutoff, 0.25f);
    EXPECT_TRUE(copy.materials[1].double_sided);
}

TEST_F(ModelFile, LargeOpaqueColourMapsAreCompressedWithSmallErrors)
{
    Model model = load(GltfDocument::square());
    cv::Mat4b picture(1024, 1280);
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x)
            picture(y, x) = {cv::saturate_cast<uchar>(160 + 60 * std::sin(x * 0.05)),
                             cv::saturate_cast<uchar>(120 + 50 * std::sin(y * 0.07)), 100, 255};
    model.materials[0].base_color = picture;
    head::save_model(folder_ / "copy.glb", model);
    EXPECT_LT(std::filesystem::file_size(folder_ / "copy.glb"), 500'000u);
    const Model copy = head::load_model(folder_ / "copy.glb");
    EXPECT_LE(cv::norm(copy.materials[0].base_color, picture, cv::NORM_INF), 6);
}

TEST_F(ModelFile, MissingNormalsTangentsAndCoordinatesAreComputedAndNoted)
{
    const Model model = load(GltfDocument::square());
    EXPECT_TRUE(has_note(model, "normals"));
    EXPECT_TRUE(has_note(model, "tangents"));
    EXPECT_TRUE(has_note(model, "texture coordinates"));
    ASSERT_EQ(model.materials.size(), 1u);
    EXPECT_TRUE(model.materials[0].base_color.empty());
    for (const head::Vertex& vertex : model.vertices) {
        EXPECT_TRUE(near(vertex.normal, {0, 0, 1}));
        EXPECT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(vertex.normal, glm::vec3(vertex.tangent)), 0.0f, 1e-5f);
    }
}

TEST_F(ModelFile, NormalsAreWeightedByAngleNotByTheNumberOfTriangles)
{
    // A corner of the unit cube; one of its three faces is cut into two triangles at that corner.
    GltfDocument document;
    document.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0});
    document.indices({0, 1, 4, 0, 4, 2, 0, 2, 3, 0, 3, 1});
    const Model model = load(document);
    EXPECT_TRUE(near(model.vertices[model.indices[0]].normal, glm::vec3(1, 1, 1) / std::sqrt(3.0f)));
}

TEST_F(ModelFile, NormalsAreSmoothAcrossATextureSeam)
{
    // A roof: the two vertices of the ridge are doubled, with different texture coordinates.
    GltfDocument document;
    document.attribute("POSITION", "VEC3", {-1, 0, 0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1});
    document.attribute("TEXCOORD_0", "VEC2", {0, 0, .4f, 0, .4f, 1, .6f, 0, 1, 0, .6f, 1});
    document.indices({0, 1, 2, 3, 4, 5});
    const Model model = load(document);
    EXPECT_TRUE(near(model.vertices[model.indices[1]].normal, {0, 0, 1}));
    EXPECT_TRUE(near(model.vertices[model.indices[3]].normal, {0, 0, 1}));
}

TEST_F(ModelFile, TangentsFollowU)
{
    GltfDocument document = GltfDocument::square();
    document.attribute("TEXCOORD_0", "VEC2", {0, 1, 1, 1, 1, 0, 0, 0}); // u right, v down
    const Model model = load(document);
    for (const head::Vertex& vertex : model.vertices)
        EXPECT_TRUE(near(glm::vec3(vertex.tangent), {1, 0, 0}) && vertex.tangent.w == 1.0f);
}

TEST_F(ModelFile, TangentsTurnWithTheTextureChart)
{
    GltfDocument document = GltfDocument::square();
    document.attribute("TEXCOORD_0", "VEC2", {1, 1, 1, 0, 0, 0, 0, 1}); // u down, v left: a quarter turn
    const Model model = load(document);
    for (const head::Vertex& vertex : model.vertices)
        EXPECT_TRUE(near(glm::vec3(vertex.tangent), {0, -1, 0}) && vertex.tangent.w == 1.0f);
}

TEST_F(ModelFile, MirroredChartsHaveNegativeHandednessAndShareNoVertex)
{
    // Two squares side by side; the right one mirrors the left one's texture, as on symmetric heads.
    GltfDocument document;
    document.attribute("POSITION", "VEC3", {-1, 0, 0, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1, 0, 0, 1, 1, 0});
    document.attribute("TEXCOORD_0", "VEC2", {0, 1, 1, 1, 1, 0, 0, 0, 0, 1, 0, 0});
    document.indices({0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2});
    const Model model = load(document);
    EXPECT_EQ(model.vertices.size(), 8u);
    for (std::size_t i = 0; i < model.indices.size(); ++i) {
        const glm::vec4 tangent = model.vertices[model.indices[i]].tangent;
        EXPECT_EQ(tangent, i < 6 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1)) << i;
    }
}

TEST_F(ModelFile, CylinderCoordinatesDoNotWrapBackWithinATriangle)
{
    GltfDocument document;
    std::vector<float> positions;
    std::vector<std::uint16_t> indices;
    constexpr int columns = 24;
    for (int i = 0; i < columns; ++i)
        for (float y : {-1.0f, 1.0f}) {
            const float angle = glm::two_pi<float>() * (static_cast<float>(i) + 0.5f) / columns;
            positions.insert(positions.end(), {std::sin(angle), y, std::cos(angle)});
        }
    for (int i = 0; i < columns; ++i) {
        const int a = 2 * i, b = 2 * ((i + 1) % columns);
        for (int v : {a, b, b + 1, a, b + 1, a + 1})
            indices.push_back(static_cast<std::uint16_t>(v));
    }
    document.attribute("POSITION", "VEC3", positions);
    document.indices(indices);
    const Model model = load(document);
    EXPECT_EQ(model.vertices.size(), 2u * columns + 2);
    for (std::size_t i = 0; i < model.indices.size(); i += 3)
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(
                std::abs(model.vertices[model.indices[i + c]].uv.x - model.vertices[model.indices[i]].uv.x),
                0.1f);
    for (const head::Vertex& vertex : model.vertices)
        EXPECT_EQ(vertex.tangent.w, 1.0f);
}

TEST_F(ModelFile, UnusableNormalsAreReplaced)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    GltfDocument document = GltfDocument::square();
    document.attribute("NORMAL", "VEC3", {0, 0, 1, nan, 0, 0, 0, 0, 0, 0, 0, 3});
    const Model model = load(document);
    EXPECT_TRUE(has_note(model, "normals"));
    for (const head::Vertex& vertex : model.vertices)
        EXPECT_TRUE(near(vertex.normal, {0, 0, 1}));
}

TEST_F(ModelFile, NestedNodeTransformsAreApplied)
{
    GltfDocument document = GltfDocument::square();
    const float half = std::sqrt(0.5f);
    document.json["nodes"] = {
        {{"children", {1}},
         {"translation", {10, 0, 0}},
         {"rotation", {0, 0, half, half}}}, // a quarter turn about z
        {{"mesh", 0},
         {"matrix", {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}}}; // twice as wide, 5 forward
    const Model model = load(document);
    EXPECT_TRUE(near(model.min, {9, 0, 5}));
    EXPECT_TRUE(near(model.max, {10, 2, 5}));
}

TEST_F(ModelFile, MirroringNodesKeepFacesOutward)
{
    GltfDocument document = GltfDocument::square();
    document.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    document.attribute("TANGENT", "VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    document.json["nodes"][0]["scale"] = {-1, 2, 1};
    const Model model = load(document);
    for (std::size_t t = 0; t < 2; ++t)
        EXPECT_TRUE(near(face_normal(model, t), {0, 0, 1}));
    for (const head::Vertex& vertex : model.vertices) {
        EXPECT_TRUE(near(vertex.normal, {0, 0, 1}));
        EXPECT_EQ(vertex.tangent, glm::vec4(-1, 0, 0, -1));
    }
}

TEST_F(ModelFile, AMeshUsedTwiceIsLoadedTwice)
{
    GltfDocument document = GltfDocument::square();
    document.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {2, 0, 0}}}};
    document.json["scenes"][0]["nodes"] = {0, 1};
    const Model model = load(document);
    EXPECT_EQ(model.indices.size(), 12u);
    EXPECT_TRUE(near(model.max, {3, 1, 0}));
}

TEST_F(ModelFile, StripsAndFansBecomeTriangles)
{
    for (const auto& [mode, order] :
         {std::pair{5, std::vector<std::uint16_t>{0, 1, 3, 2}}, {6, {0, 1, 2, 3}}}) {
        GltfDocument document = GltfDocument::square();
        document.primitive()["mode"] = mode;
        document.indices(order);
        const Model model = load(document);
        ASSERT_EQ(model.indices.size(), 6u);
        for (std::size_t t = 0; t < 2; ++t)
            EXPECT_TRUE(near(face_normal(model, t), {0, 0, 1})) << mode;
    }
}

TEST_F(ModelFile, SparseAccessorsReplaceElements)
{
    GltfDocument document = GltfDocument::square();
    const std::size_t places = document.add(std::vector<std::uint16_t>{2}, "SCALAR", 5123, 1);
    const std::size_t values = document.add(std::vector<float>{7, 8, 9}, "VEC3", 5126, 1);
    document.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", document.json["accessors"][places]["bufferView"]}, {"componentType", 5123}}},
        {"values", {{"bufferView", document.json["accessors"][values]["bufferView"]}}}};
    EXPECT_TRUE(near(load(document).max, {7, 8, 9}));
}

TEST_F(ModelFile, InterleavedAndNormalisedNumbersAreRead)
{
    GltfDocument document;
    // Per vertex: three float coordinates, then two unsigned shorts of texture coordinates.
    std::vector<std::uint16_t> words;
    const float corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    for (int v = 0; v < 3; ++v) {
        std::uint16_t position[6];
        std::memcpy(position, corners + 3 * v, 12);
        words.insert(words.end(), position, position + 6);
        words.insert(words.end(), {static_cast<std::uint16_t>(v == 0 ? 0 : 65535), 13107});
    }
    const std::size_t accessor = document.add(words, "VEC3", 5126, 3);
    document.json["bufferViews"][0]["byteStride"] = 16;
    document.json["accessors"].push_back({{"bufferView", 0},
                                          {"byteOffset", 12},
                                          {"componentType", 5123},
                                          {"normalized", true},
                                          {"count", 3},
                                          {"type", "VEC2"}});
    document.primitive()["attributes"] = {{"POSITION", accessor}, {"TEXCOORD_0", accessor + 1}};
    const Model model = load(document); // no indices: vertices in order
    ASSERT_EQ(model.vertices.size(), 3u);
    EXPECT_EQ(model.vertices[2].position, glm::vec3(1, 1, 0));
    EXPECT_TRUE(near(glm::vec3(model.vertices[1].uv, 0), {1, 0.2f, 0}));
}

TEST_F(ModelFile, TextureTransformsMoveTheCoordinates)
{
    GltfDocument document = GltfDocument::square();
    document.attribute("TEXCOORD_0", "VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
    document.json["extensionsUsed"] = document.json["extensionsRequired"] = {"KHR_texture_transform"};
    document.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {0.5, 0.5}}}}}}}}}}}};
    document.json["textures"] = {nlohmann::json::object()};
    document.primitive()["material"] = 0;
    const Model model = load(document);
    EXPECT_TRUE(near(glm::vec3(model.vertices[1].uv, 0), {1, 0.75f, 0}));
    EXPECT_TRUE(has_note(model, "picture"));
}

TEST_F(ModelFile, DegenerateTrianglesAndUnusedVerticesAreDropped)
{
    GltfDocument document;
    document.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 50, 50, 50});
    document.indices({0, 1, 2, 0, 1, 3, 0, 0, 1});
    const Model model = load(document);
    EXPECT_EQ(model.indices.size(), 3u);
    EXPECT_EQ(model.vertices.size(), 3u);
    EXPECT_TRUE(near(model.max, {1, 1, 0}));
    EXPECT_TRUE(has_note(model, "2 triangles without area"));
}

TEST_F(ModelFile, ImplausibleSizesAreScaledAndNoted)
{
    GltfDocument document = GltfDocument::square();
    Model metres = load(document);
    metres.max.y = 0.3f;
    head::normalise_size(metres);
    EXPECT_EQ(metres.max.y, 0.3f);
    EXPECT_FALSE(has_note(metres, "scaled"));
    for (double scale : {7.0, 1e-4}) {
        document.json["nodes"][0]["scale"] = {scale, scale, scale};
        Model model = load(document);
        head::normalise_size(model);
        EXPECT_NEAR(model.max.y - model.min.y, 0.25f, 1e-6f);
        EXPECT_NEAR(model.vertices[model.indices[1]].position.x, 0.25f, 1e-6f);
        EXPECT_TRUE(has_note(model, "scaled to 0.25 m"));
    }
}

} // namespace
