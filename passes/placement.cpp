#include "passes/placement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "wound/color.hpp"
#include "wound/input_error.hpp"

namespace passes {
namespace {

constexpr double reach = Anchor::reach;

std::array<glm::vec3, 3> corners_of(const engine::Model& head, std::size_t first)
{
    return {head.vertices[head.indices[first]].position, head.vertices[head.indices[first + 1]].position,
            head.vertices[head.indices[first + 2]].position};
}

/// Moeller & Trumbore 1997; distance along the unit direction, front faces only.
std::optional<double> hit(const std::array<glm::vec3, 3>& t, const glm::dvec3& origin,
                          const glm::dvec3& direction)
{
    const glm::dvec3 a(t[0]), ab = glm::dvec3(t[1]) - a, ac = glm::dvec3(t[2]) - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double det = glm::dot(ab, p);
    if (det <= 1e-18)
        return std::nullopt;
    const glm::dvec3 s = origin - a;
    const double u = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(direction, q) / det;
    if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9)
        return std::nullopt;
    return glm::dot(ac, q) / det;
}

/// The first skin that a ray meets.
std::optional<glm::dvec3> first_skin(const engine::Model& head, const glm::dvec3& origin,
                                     const glm::dvec3& direction)
{
    std::optional<double> nearest;
    for (std::size_t i = 0; i + 2 < head.indices.size(); i += 3)
        if (const auto distance = hit(corners_of(head, i), origin, direction); distance && *distance >= 0)
            nearest = std::min(nearest.value_or(*distance), *distance);
    if (!nearest)
        return std::nullopt;
    return origin + *nearest * direction;
}

/// The first skin that a viewer in front of the face sees at (x, y).
std::optional<glm::dvec3> seen_from_the_front(const engine::Model& head, double x, double y)
{
    return first_skin(head, {x, y, double(head.max.z) + 1.0}, {0, 0, -1});
}

glm::dvec3 nearest_vertex(const engine::Model& head, const glm::dvec3& point)
{
    glm::dvec3 best(head.vertices.front().position);
    for (const engine::Vertex& vertex : head.vertices)
        if (glm::distance(glm::dvec3(vertex.position), point) < glm::distance(best, point))
            best = glm::dvec3(vertex.position);
    return best;
}

/// Mean of the vertex normals within `radius`, weighted by a smooth bump; those that face away from the
/// nearest are left out.
glm::dvec3 mean_normal(const engine::Model& head, const glm::dvec3& centre, double radius)
{
    double nearest = std::numeric_limits<double>::max();
    glm::dvec3 direction(0, 0, 1), sum(0.0);
    for (const engine::Vertex& vertex : head.vertices)
        if (const double distance = glm::distance(glm::dvec3(vertex.position), centre); distance < nearest) {
            nearest = distance;
            direction = glm::dvec3(vertex.normal);
        }
    for (const engine::Vertex& vertex : head.vertices) {
        const double t = glm::distance(glm::dvec3(vertex.position), centre) / radius;
        if (t < 1 && glm::dot(glm::dvec3(vertex.normal), direction) > 0.3)
            sum += (1 - t * t) * (1 - t * t) * glm::dvec3(vertex.normal);
    }
    return glm::length(sum) > 1e-9 ? glm::normalize(sum) : direction;
}

glm::dvec3 in_frame(const Anchor& anchor, const glm::dvec3& point)
{
    const glm::dvec3 d = (point - anchor.centre) / anchor.half_width_m;
    return {glm::dot(d, anchor.right), glm::dot(d, anchor.down), glm::dot(d, anchor.normal)};
}

cv::Vec3f linear_albedo(const engine::Material& material, const glm::dvec2& uv)
{
    const glm::vec4 factor = material.base_color_factor;
    if (material.base_color.empty())
        return {factor.x, factor.y, factor.z};
    const auto wrap = [](double t, int n) {
        return std::clamp(int(std::floor((t - std::floor(t)) * n)), 0, n - 1);
    };
    const cv::Vec4b texel =
        material.base_color(wrap(uv.y, material.base_color.rows), wrap(uv.x, material.base_color.cols));
    const auto linear = [&](int channel) { return wound::srgb_to_linear(texel[channel] / 255.0f); };
    return {linear(0) * factor.x, linear(1) * factor.y, linear(2) * factor.z};
}

/// The face coordinates and the normal of an anchor whose centre and size are known.
void lay_on_skin(Anchor& anchor, const engine::Model& head, const FaceFrame& face)
{
    anchor.face = {(anchor.centre.x - face.nose_tip.x) / face.unit_m,
                   (anchor.centre.y - face.nose_tip.y) / face.unit_m};
    anchor.normal = mean_normal(head, anchor.centre, std::max(0.7 * anchor.half_width_m, 0.006));
}

} // namespace

FaceFrame find_face(const engine::Model& head)
{
    // The tip of the nose is what reaches furthest forward in the upper two thirds; below may be a chest.
    const float lowest = head.min.y + 0.35f * (head.max.y - head.min.y);
    FaceFrame face;
    face.nose_tip = glm::dvec3(0, 0, std::numeric_limits<double>::lowest());
    for (const engine::Vertex& vertex : head.vertices)
        if (vertex.position.y >= lowest && vertex.position.z > face.nose_tip.z)
            face.nose_tip = glm::dvec3(vertex.position);
    face.unit_m = std::max(double(head.max.y) - face.nose_tip.y, 1e-3);
    return face;
}

std::vector<NamedPlace> named_places()
{
    return {{"cheek", {0.32, -0.06}},
            {"eyebrow", {0.21, 0.44}},
            {"chin", {0.08, -0.36}},
            {"forehead", {0.05, 0.60}},
            {"nose", {0.03, 0.10}}};
}

std::optional<FacePoint> known_face_point(const Place& place)
{
    if (const auto* face = std::get_if<FacePoint>(&place))
        return *face;
    if (const auto* name = std::get_if<std::string>(&place))
        for (const NamedPlace& known : named_places())
            if (*name == known.name)
                return known.at;
    return std::nullopt;
}

Anchor anchor_wound(const engine::Model& head, const FaceFrame& face, const Place& place,
                    double patch_width_mm, double roll_deg, const std::string& where)
{
    Anchor anchor;
    anchor.half_width_m = patch_width_mm * 0.5e-3;
    if (const auto* point = std::get_if<glm::dvec3>(&place)) {
        anchor.centre = nearest_vertex(head, *point);
        if (const double off = glm::distance(anchor.centre, *point); off > 0.05)
            throw cicatrix::InputError(where, fmt::format("lies {:.0f} mm away from the head", off * 1e3),
                                       "give a point on the head in metres, or face coordinates [x, y]");
    } else {
        const std::optional<FacePoint> known = known_face_point(place);
        if (!known)
            throw cicatrix::InputError(where, "\"" + std::get<std::string>(place) + "\" is no known place",
                                       "use cheek, eyebrow, chin, forehead, nose, or coordinates");
        const FacePoint at = *known;
        const auto seen = seen_from_the_front(head, face.nose_tip.x + at.x * face.unit_m,
                                              face.nose_tip.y + at.y * face.unit_m);
        if (!seen)
            throw cicatrix::InputError(where,
                                       fmt::format("face coordinates [{:g}, {:g}] miss the head", at.x, at.y),
                                       "stay within about -0.5 to 0.5 across and -0.7 to 0.9 up");
        anchor.centre = *seen;
    }
    lay_on_skin(anchor, head, face);
    const glm::dvec3 up = std::abs(anchor.normal.y) > 0.95 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 level = glm::normalize(glm::cross(up, anchor.normal)); // towards the viewer's right
    const glm::dvec3 below = glm::cross(level, anchor.normal);              // and down the face
    const double roll = glm::radians(roll_deg);
    anchor.right = std::cos(roll) * level - std::sin(roll) * below;
    anchor.down = std::sin(roll) * level + std::cos(roll) * below;
    return anchor;
}

Anchor anchor_beside(const engine::Model& head, const FaceFrame& face, const Anchor& first,
                     const glm::dvec2& offset_m, double patch_width_mm, const std::string& where)
{
    // From a little above the first one's plane: from further away another part of the head may come between.
    const double distance = glm::length(offset_m), above = std::max(distance, first.half_width_m);
    const glm::dvec3 origin =
        first.centre + offset_m.x * first.right + offset_m.y * first.down + above * first.normal;
    const auto found = first_skin(head, origin, -first.normal);
    if (!found || glm::distance(*found, origin) > 2.5 * above)
        throw cicatrix::InputError(
            where,
            fmt::format("lies {:.0f} mm beside the largest one, where there is no skin", distance * 1e3),
            "give a smaller width_mm, another roll_deg or a place further from the head's edge");
    Anchor anchor;
    anchor.half_width_m = patch_width_mm * 0.5e-3;
    anchor.centre = *found;
    lay_on_skin(anchor, head, face);
    anchor.down = glm::normalize(glm::cross(first.right, anchor.normal));
    anchor.right = glm::cross(anchor.normal, anchor.down);
    return anchor;
}

bool receives(const Anchor& anchor, const std::array<glm::vec3, 3>& corners)
{
    glm::dvec3 low(1e30), high(-1e30);
    for (const glm::vec3& corner : corners) {
        const glm::dvec3 q = in_frame(anchor, glm::dvec3(corner));
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    return low.x <= 1 && high.x >= -1 && low.y <= 1 && high.y >= -1 && low.z <= reach && high.z >= -reach;
}

cv::Mat3f skin_under(const engine::Model& head, std::uint32_t material, const Anchor& anchor, int size)
{
    cv::Mat3f skin(size, size, cv::Vec3f::all(std::numeric_limits<float>::quiet_NaN()));
    cv::Mat1d nearest(size, size, -reach);
    for (const engine::Primitive& primitive : head.primitives) {
        if (primitive.material != material)
            continue;
        for (std::size_t i = primitive.first_index;
             i + 2 < std::size_t(primitive.first_index) + primitive.index_count; i += 3)
        {
            const auto corners = corners_of(head, i);
            if (!receives(anchor, corners))
                continue;
            std::array<glm::dvec3, 3> q;
            std::array<glm::dvec2, 3> uv;
            for (int k = 0; k < 3; ++k) {
                q[k] = in_frame(anchor, glm::dvec3(corners[k]));
                uv[k] = glm::dvec2(head.vertices[head.indices[i + k]].uv);
            }
            const auto cross = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - a.y * b.x; };
            const double area = cross(q[1] - q[0], q[2] - q[0]);
            if (area >= -1e-12) // v points down: what faces the patch turns clockwise in (u, v)
                continue;
            const auto texel = [&](double t) { return (t + 1) * 0.5 * size - 0.5; };
            const int x0 = std::max(0, int(std::ceil(texel(std::min({q[0].x, q[1].x, q[2].x})))));
            const int x1 = std::min(size - 1, int(std::floor(texel(std::max({q[0].x, q[1].x, q[2].x})))));
            const int y0 = std::max(0, int(std::ceil(texel(std::min({q[0].y, q[1].y, q[2].y})))));
            const int y1 = std::min(size - 1, int(std::floor(texel(std::max({q[0].y, q[1].y, q[2].y})))));
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x) {
                    const glm::dvec3 p((x + 0.5) * 2 / size - 1, (y + 0.5) * 2 / size - 1, 0);
                    const double b = cross(p - q[0], q[2] - q[0]) / area,
                                 c = cross(q[1] - q[0], p - q[0]) / area;
                    const double height = q[0].z + b * (q[1].z - q[0].z) + c * (q[2].z - q[0].z);
                    if (b < 0 || c < 0 || b + c > 1 || height <= nearest(y, x) || height > reach)
                        continue;
                    nearest(y, x) = height;
                    skin(y, x) = linear_albedo(head.materials[material],
                                               uv[0] + b * (uv[1] - uv[0]) + c * (uv[2] - uv[0]));
                }
        }
    }
    return skin;
}

} // namespace passes
