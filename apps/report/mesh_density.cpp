#include "apps/report/mesh_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace report_command {
namespace {

using head::Model;
using head::Primitive;
using head::Vertex;

Vertex middle(const Vertex& a, const Vertex& b)
{
    const auto direction = [](const glm::vec3& p, const glm::vec3& q) {
        const glm::vec3 sum = p + q;
        return glm::length(sum) > 1e-6f ? glm::normalize(sum) : p;
    };
    Vertex vertex;
    vertex.position = (a.position + b.position) / 2.0f;
    vertex.normal = direction(a.normal, b.normal);
    vertex.tangent = glm::vec4(direction(glm::vec3(a.tangent), glm::vec3(b.tangent)), a.tangent.w);
    vertex.uv = (a.uv + b.uv) / 2.0f;
    return vertex;
}

/// Replaces every triangle by the triangles that `split(a, b, c)` appends for its corners.
template <typename Split>
void replace_triangles(Model& model, Split split)
{
    const std::vector<std::uint32_t> old = std::move(model.indices);
    model.indices.clear();
    std::vector<Primitive> kept;
    for (Primitive primitive : model.primitives) {
        const auto first = std::uint32_t(model.indices.size());
        for (std::uint32_t i = primitive.first_index; i + 2 < primitive.first_index + primitive.index_count;
             i += 3)
            split(old[i], old[i + 1], old[i + 2]);
        primitive.first_index = first;
        primitive.index_count = std::uint32_t(model.indices.size()) - first;
        if (primitive.index_count > 0)
            kept.push_back(primitive);
    }
    model.primitives = std::move(kept);
}

/// For each vertex, the index of the vertex that represents all in its cube.
std::vector<std::uint32_t> representatives(const Model& model, float cube)
{
    std::map<std::array<int, 3>, std::uint32_t> first;
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < model.vertices.size(); ++i) {
        const glm::ivec3 cell(glm::floor((model.vertices[i].position - model.min) / cube));
        result.push_back(first.try_emplace({cell.x, cell.y, cell.z}, i).first->second);
    }
    return result;
}

Model clustered_by(Model model, float cube)
{
    const std::vector<std::uint32_t> representative = representatives(model, cube);
    replace_triangles(model, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::array corners{representative[a], representative[b], representative[c]};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            model.indices.insert(model.indices.end(), corners.begin(), corners.end());
    });
    return model;
}

} // namespace

std::size_t triangle_count(const Model& model)
{
    return model.indices.size() / 3;
}

Model subdivided(const Model& model)
{
    Model result = model;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, fresh] =
            middles.try_emplace(std::minmax(a, b), std::uint32_t(result.vertices.size()));
        if (fresh)
            result.vertices.push_back(middle(model.vertices[a], model.vertices[b]));
        return found->second;
    };
    replace_triangles(result, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
        for (const std::uint32_t corner : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca})
            result.indices.push_back(corner);
    });
    return result;
}

Model clustered(const Model& model, double share)
{
    const double wanted = share * double(triangle_count(model));
    float fine = 1e-5f, coarse = glm::length(model.max - model.min) / 4; // metres; bisection on a log scale
    for (int i = 0; i < 24; ++i) {
        const float cube = std::sqrt(fine * coarse);
        (double(triangle_count(clustered_by(model, cube))) > wanted ? fine : coarse) = cube;
    }
    return clustered_by(model, coarse);
}

Model with_small_pictures(Model model, int side)
{
    const auto shrink = [side](auto& picture) {
        if (std::max(picture.cols, picture.rows) <= side)
            return;
        const double scale = double(side) / std::max(picture.cols, picture.rows);
        cv::Mat small;
        cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
        picture = small;
    };
    for (head::Material& material : model.materials) {
        shrink(material.base_color);
        shrink(material.normal);
        shrink(material.occlusion);
    }
    return model;
}

} // namespace report_command
