#include "tests/support/small_head.hpp"

#include <fmt/format.h>
#include <numbers>

#include "tests/support/temporary_folder.hpp"

namespace small {
namespace {

constexpr std::uint32_t rings = 64, sectors = 128;

/// v: 0 at the crown .. 1 at the neck; u: once around from the back, the face in the middle.
glm::dvec3 skin_at(double u, double v)
{
    const double around = 2 * std::numbers::pi * (u - 0.5), down = std::numbers::pi * v;
    glm::dvec3 p(0.075 * std::sin(down) * std::sin(around), 0.115 * std::cos(down),
                 0.095 * std::sin(down) * std::cos(around));
    if (p.z > 0)
        p.z += 0.02 * std::exp(-std::pow(p.x / 0.014, 2) - std::pow((p.y + 0.005) / 0.02, 2)); // the nose
    return p;
}

head::Vertex vertex_at(double u, double v)
{
    const double step = 1e-5, inside = std::clamp(v, 0.002, 0.998); // at the poles one derivative vanishes
    const glm::dvec3 across = skin_at(u + step, inside) - skin_at(u - step, inside);
    const glm::dvec3 down = skin_at(u, inside + step) - skin_at(u, inside - step);
    return {glm::vec3(skin_at(u, v)),
            glm::vec3(glm::normalize(glm::cross(down, across))),
            glm::vec4(glm::normalize(across), 1),
            {u, v}};
}

/// Triangles of a grid of (columns + 1) x (rows + 1) vertices, row by row from the top left as seen from
/// outside.
void add_grid_triangles(head::Model& model, std::uint32_t columns, std::uint32_t rows)
{
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * (columns + 1) + i, below = a + columns + 1;
            model.indices.insert(model.indices.end(), {a, below, a + 1, a + 1, below, below + 1});
        }
    model.primitives = {{0, std::uint32_t(model.indices.size()), 0}};
    head::update_bounds(model);
}

/// Skin with large soft blotches, so that a test can see whether the albedo map is used.
cv::Mat4b blotched_skin()
{
    cv::Mat4b color(64, 128);
    for (int y = 0; y < color.rows; ++y)
        for (int x = 0; x < color.cols; ++x) {
            const double blotch = 8 * std::sin(x * 0.49) * std::cos(y * 0.39);
            color(y, x) =
                cv::Vec4b(cv::saturate_cast<uchar>(205 + blotch), cv::saturate_cast<uchar>(158 + blotch),
                          cv::saturate_cast<uchar>(136 + blotch), 255);
        }
    return color;
}

cv::Mat3b rippled_normals()
{
    cv::Mat3b normal(64, 128);
    for (int y = 0; y < normal.rows; ++y)
        for (int x = 0; x < normal.cols; ++x)
            normal(y, x) = cv::Vec3b(cv::saturate_cast<uchar>(128 + 12 * std::sin(x * 0.8)),
                                     cv::saturate_cast<uchar>(128 + 12 * std::sin(y * 0.8)), 254);
    return normal;
}

} // namespace

head::Model head()
{
    head::Model model;
    for (std::uint32_t j = 0; j <= rings; ++j)
        for (std::uint32_t i = 0; i <= sectors; ++i)
            model.vertices.push_back(vertex_at(double(i) / sectors, double(j) / rings));
    head::Material skin;
    skin.name = "skin";
    skin.base_color = blotched_skin();
    skin.normal = rippled_normals();
    model.materials = {skin};
    add_grid_triangles(model, sectors, rings);
    return model;
}

head::Model wall(const glm::vec3& linear_color)
{
    constexpr std::uint32_t cells = 16;
    head::Model model;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const glm::vec2 uv(float(i) / cells, float(j) / cells);
            model.vertices.push_back(
                {{0.24f * (uv.x - 0.5f), 0.24f * (0.5f - uv.y), 0}, {0, 0, 1}, {1, 0, 0, 1}, uv});
        }
    head::Material skin;
    skin.name = "skin";
    skin.base_color_factor = glm::vec4(linear_color, 1);
    model.materials = {skin};
    add_grid_triangles(model, cells, cells);
    return model;
}

std::filesystem::path saved(const head::Model& model)
{
    static const TemporaryFolder folder;
    static int count = 0;
    const std::filesystem::path path = folder / fmt::format("head_{}.glb", ++count);
    head::save_model(path, model);
    return path;
}

scene::Scene scene(const head::Model& model, std::uint32_t side)
{
    scene::Scene scene;
    scene.head = saved(model);
    scene.size = {side, side};
    return scene;
}

} // namespace small
