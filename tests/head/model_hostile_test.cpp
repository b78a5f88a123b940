// Broken and malicious glTF files: one InputError each, never a crash.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "base/input_error.hpp"
#include "head/model.hpp"
#include "tests/support/gltf_document.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using nlohmann::json;

/// A square with everything a head has: normals, tangents, coordinates, two pictures, a sparse accessor,
/// nested nodes.
GltfDocument rich_document()
{
    GltfDocument document = GltfDocument::square();
    document.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    document.attribute("TANGENT", "VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    document.attribute("TEXCOORD_0", "VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
    const std::size_t places = document.add(std::vector<std::uint16_t>{2}, "SCALAR", 5123, 1);
    const std::size_t values = document.add(std::vector<float>{2, 2, 0}, "VEC3", 5126, 1);
    document.json["accessors"][0]["sparse"] = {{"count", 1},
                                               {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                                               {"values", {{"bufferView", values}}}};
    std::vector<std::uint8_t> png, jpeg;
    cv::imencode(".png", cv::Mat3b(5, 6, cv::Vec3b(90, 120, 200)), png);
    cv::imencode(".jpg", cv::Mat3b(9, 8, cv::Vec3b(255, 128, 128)), jpeg);
    document.json["images"] = json::array();
    for (const auto& [bytes, type] : {std::pair{png, "image/png"}, {jpeg, "image/jpeg"}}) {
        document.add(bytes, "SCALAR", 5121, bytes.size());
        document.json["images"].push_back(
            {{"bufferView", document.json["bufferViews"].size() - 1}, {"mimeType", type}});
    }
    document.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    document.json["materials"] = {
        {{"name", "skin"},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.5}}},
         {"normalTexture", {{"index", 1}, {"scale", 1.0}}},
         {"occlusionTexture", {{"index", 0}, {"strength", 0.5}}}}};
    document.primitive()["material"] = 0;
    document.json["nodes"] = {{{"children", {1}}, {"translation", {1, 2, 3}}, {"scale", {1, 1, 1}}},
                              {{"mesh", 0}, {"rotation", {0, 0, 0, 1}}}};
    return document;
}

class HostileModel : public testing::Test
{
  protected:
    /// The message of the InputError, "" if the file was accepted. Any other exception fails the test.
    std::string refusal(std::string_view bytes, std::string_view name = "head.glb")
    {
        const auto path = folder_.with(name, bytes);
        try {
            const head::Model model = head::load_model(path);
            for (const head::Vertex& vertex : model.vertices)
                for (float value : {vertex.position.x, vertex.normal.x, vertex.tangent.x, vertex.uv.x})
                    EXPECT_TRUE(std::isfinite(value));
            for (std::uint32_t index : model.indices)
                EXPECT_LT(index, model.vertices.size());
            return "";
        } catch (const base::InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind(path.string(), 0), 0u) << "does not begin with the file: " << message;
            EXPECT_NE(message.find("; "), std::string::npos) << "names no remedy: " << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
            return message;
        } catch (const std::exception& error) {
            ADD_FAILURE() << "not an InputError: " << error.what();
            return error.what();
        }
    }
    std::string refusal(const GltfDocument& document) { return refusal(document.glb()); }
    std::string refusal_after(const std::function<void(GltfDocument&)>& damage)
    {
        GltfDocument document = rich_document();
        damage(document);
        return refusal(document);
    }
    TemporaryFolder folder_;
};

#define EXPECT_REFUSED(message, words)                                                                       \
    EXPECT_NE((message).find(words), std::string::npos) << "message: " << (message)

TEST_F(HostileModel, TheSoundFileIsAccepted)
{
    EXPECT_EQ(refusal(rich_document()), "");
}

TEST_F(HostileModel, MissingEmptyAndForeignFilesAreRefused)
{
    EXPECT_THROW(head::load_model(folder_ / "absent.glb"), base::InputError);
    EXPECT_THROW(head::load_model(folder_.path()), base::InputError);
    EXPECT_REFUSED(refusal(""), "empty");
    EXPECT_REFUSED(refusal("solid cube\nfacet normal"), "not a glTF file");
    EXPECT_REFUSED(refusal("{\"asset\":", "head.gltf"), "not a valid glTF file");
    EXPECT_REFUSED(refusal("[{}]", "head.gltf"), "not a valid glTF file");
    EXPECT_REFUSED(refusal(R"({"asset":{"version":"1.0"}})", "head.gltf"), "version");
    EXPECT_REFUSED(refusal(R"({"asset":{"version":"2.0"}})", "head.gltf"), "no triangles");
}

TEST_F(HostileModel, EveryTruncationIsRefused)
{
    const std::string bytes = rich_document().glb();
    for (std::size_t length = 1; length < bytes.size(); length += 7)
        EXPECT_NE(refusal(std::string_view(bytes).substr(0, length)), "") << length;
}

TEST_F(HostileModel, FlippedBytesNeverCrash)
{
    const std::string sound = rich_document().glb();
    std::mt19937 random(20141);
    for (int round = 0; round < 1500; ++round) {
        std::string bytes = sound;
        for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
            bytes[random() % bytes.size()] = static_cast<char>(random());
        refusal(bytes);
    }
}

/// Replaces every value in the document, one at a time, by each hostile value.
TEST_F(HostileModel, HostileValuesInEveryFieldNeverCrash)
{
    const GltfDocument sound = rich_document();
    const std::vector<json> hostile = {-1,    3,   2147483647, 18446744073709551615u,
                                       1e308, "x", nullptr,    json::array()};
    const json flat = sound.json.flatten();
    for (const auto& [pointer, value] : flat.items())
        for (const json& bad : hostile) {
            GltfDocument document = sound;
            document.json[json::json_pointer(pointer)] = bad;
            refusal(document);
        }
}

TEST_F(HostileModel, BadReferencesNameTheirField)
{
    EXPECT_REFUSED(refusal_after([](auto& d) { d.primitive()["attributes"]["POSITION"] = 99; }),
                   "/attributes/POSITION");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.primitive()["attributes"].erase("POSITION"); }),
                   "/attributes/POSITION");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.primitive()["material"] = 7; }), "/primitives/0/material");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["textures"][1]["source"] = 7; }), "/textures/1/source");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["nodes"][1]["mesh"] = 7; }), "/meshes/7");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["scene"] = 7; }), "/scene");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["nodes"][0]["children"] = {5}; }), "/nodes/5");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["bufferViews"][0]["byteLength"] = 4000000000u; }),
                   "/bufferViews/0");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["bufferViews"][0]["buffer"] = 3; }),
                   "/bufferViews/0/buffer");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["accessors"][0]["count"] = 5; }), "/attributes/");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["accessors"][0]["count"] = 4000000000u; }), "limit");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["accessors"][0]["byteOffset"] = 44; }), "reach beyond");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["bufferViews"][0]["byteStride"] = 252; }),
                   "reach beyond");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["accessors"][0]["componentType"] = 5130; }),
                   "component type");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["accessors"][0]["type"] = "VEC2"; }), "components");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["accessors"][0]["sparse"]["count"] = 5; }), "sparse");
}

TEST_F(HostileModel, IndicesOutOfRangeAreRefused)
{
    EXPECT_REFUSED(refusal_after([](auto& d) { d.indices({0, 1, 4}); }), "names vertex 4 of 4");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.indices({0, 1, 65535}); }), "names vertex 65535 of 4");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.indices({0, 1, 2, 0}); }), "no whole triangles");
}

TEST_F(HostileModel, PositionsMustBeFinite)
{
    for (float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e38f, -1e9f})
        EXPECT_REFUSED(refusal_after([&](auto& d) {
                           d.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 1, bad, 0, 0, 1, 0});
                       }),
                       "vertex 2");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["nodes"][0]["scale"] = {1e300, 1, 1}; }), "vertex");
    EXPECT_REFUSED(refusal_after([](auto& d) {
                       d.attribute("TEXCOORD_0", "VEC2", {0, 0, 1, std::nanf(""), 1, 1, 0, 1});
                   }),
                   "/attributes/TEXCOORD_0");
}

TEST_F(HostileModel, MeshesWithoutAreaAreRefused)
{
    EXPECT_REFUSED(refusal_after([](auto& d) {
                       d.indices({0, 0, 1, 2, 2, 2});
                   }),
                   "no triangles with an area");
    EXPECT_REFUSED(refusal_after([](auto& d) {
                       d.json["nodes"][0]["scale"] = {0, 0, 0};
                   }),
                   "no triangles with an area");
}

TEST_F(HostileModel, CyclesAndDoubleParentsAreRefused)
{
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["nodes"][1]["children"] = {0}; }), "cycle");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["nodes"][0]["children"] = {1, 1}; }), "two parents");
}

TEST_F(HostileModel, CompressionAndUnknownRequirementsAreRefused)
{
    EXPECT_REFUSED(
        refusal_after([](auto& d) { d.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
        "without compression");
    EXPECT_REFUSED(refusal_after([](auto& d) {
                       d.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
                   }),
                   "without compression");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["extensionsRequired"] = {"EXT_secret"}; }),
                   "EXT_secret");
}

TEST_F(HostileModel, OtherFilesAreReadOnlyFromTheModelsFolder)
{
    GltfDocument document = GltfDocument::square();
    std::filesystem::create_directory(folder_ / "sub");
    folder_.with("sub/mesh.bin", document.binary);
    folder_.with("outside.bin", document.binary);
    const auto with_uri = [&](const std::string& uri) {
        document.json["buffers"] = {{{"byteLength", document.binary.size()}, {"uri", uri}}};
        return refusal(document.json.dump(), "sub/head.gltf");
    };
    EXPECT_EQ(with_uri("mesh.bin"), "");
    EXPECT_REFUSED(with_uri("../outside.bin"), "outside its own folder");
    EXPECT_REFUSED(with_uri("%2e%2e/outside.bin"), "outside its own folder");
    EXPECT_NE(with_uri((folder_ / "outside.bin").string()), "");
    EXPECT_NE(with_uri("/etc/passwd"), "");
    EXPECT_NE(with_uri("absent.bin"), "");
    EXPECT_NE(with_uri(""), "");
    EXPECT_NE(with_uri("data:application/octet-stream;base64,AAAA"), "");
}

TEST_F(HostileModel, BrokenPicturesNameTheirImage)
{
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["bufferViews"][7]["byteLength"] = 40; }),
                   "/images/0: the PNG picture is cut");
    EXPECT_REFUSED(refusal_after([](auto& d) { d.json["images"][1]["bufferView"] = 0; }),
                   "/images/1: is not a picture");
    EXPECT_REFUSED(refusal_after([](auto& d) {
                       d.json["images"][0] = {{"uri", "absent.png"}};
                   }),
                   "/images/0: picture");
}

TEST_F(HostileModel, JsonBombsAreRefusedQuickly)
{
    const std::string head = R"({"asset":{"version":"2.0"},"extras":)";
    EXPECT_REFUSED(refusal(head + std::string(300'000, '[') + std::string(300'000, ']') + "}", "head.gltf"),
                   "too deeply");
    std::string many = head + "[{}";
    for (int i = 0; i < 400'000; ++i)
        many += ",{}";
    EXPECT_REFUSED(refusal(many + "]}", "head.gltf"), "too deeply");
}

} // namespace
