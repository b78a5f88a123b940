// glTF files made by hand for tests: a document as JSON and one binary buffer.
#pragma once
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

class GltfDocument
{
  public:
    GltfDocument()
    {
        json = {{"asset", {{"version", "2.0"}}},
                {"scene", 0},
                {"scenes", {{{"nodes", {0}}}}},
                {"nodes", {{{"mesh", 0}}}},
                {"meshes", {{{"primitives", {nlohmann::json::object()}}}}},
                {"accessors", nlohmann::json::array()},
                {"bufferViews", nlohmann::json::array()}};
    }

    /// A square in the plane z = 0 that faces +z: corners (0,0), (1,0), (1,1), (0,1); two triangles.
    static GltfDocument square()
    {
        GltfDocument document;
        document.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        document.indices({0, 1, 2, 0, 2, 3});
        return document;
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    void attribute(const std::string& name, const std::string& type, const std::vector<float>& values)
    {
        const std::size_t components = static_cast<std::size_t>(type.back() - '0');
        primitive()["attributes"][name] = add(values, type, 5126, values.size() / components);
    }
    void indices(const std::vector<std::uint16_t>& values)
    {
        primitive()["indices"] = add(values, "SCALAR", 5123, values.size());
    }
    /// Adds a buffer view and an accessor; returns the accessor.
    template <typename T>
    std::size_t add(const std::vector<T>& values, const std::string& type, int component_type,
                    std::size_t count)
    {
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}});
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", component_type},
                                     {"count", count},
                                     {"type", type}});
        binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        binary.resize((binary.size() + 3) / 4 * 4);
        return json["accessors"].size() - 1;
    }

    std::string glb() const
    {
        nlohmann::json whole = json;
        if (!whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", binary.size()}}};
        return glb(whole.dump(), binary);
    }
    static std::string glb(std::string text, const std::string& binary)
    {
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto word = [](std::size_t value) {
            const auto narrow = static_cast<std::uint32_t>(value);
            std::string bytes(4, '\0');
            std::memcpy(bytes.data(), &narrow, 4);
            return bytes;
        };
        return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
               word(binary.size()) + std::string("BIN\0", 4) + binary;
    }

    nlohmann::json json;
    std::string binary;
};
