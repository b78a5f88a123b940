#include "head/placement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "base/input_error.hpp"
#include "head/surface.hpp"

namespace head {
namespace {

constexpr double reach = Anchor::reach;

/// Weighted mean of the vertex normals within `radius`, without those that face away from the normal of the
/// nearest vertex. The weight (1 - t^2)^2 falls to 0 at `radius`.
glm::dvec3 mean_normal(const Model& head, const glm::dvec3& centre, double radius)
{
    double nearest = std::numeric_limits<double>::max();
    glm::dvec3 direction(0, 0, 1), sum(0.0);
    for (const Vertex& vertex : head.vertices)
        if (const double distance = glm::distance(glm::dvec3(vertex.position), centre); distance < nearest) {
            nearest = distance;
            direction = glm::dvec3(vertex.normal);
        }
    for (const Vertex& vertex : head.vertices) {
        const double t = glm::distance(glm::dvec3(vertex.position), centre) / radius;
        if (t < 1 && glm::dot(glm::dvec3(vertex.normal), direction) > 0.3)
            sum += (1 - t * t) * (1 - t * t) * glm::dvec3(vertex.normal);
    }
    return glm::length(sum) > 1e-9 ? glm::normalize(sum) : direction;
}

/// Sets the face coordinates and the normal of an anchor from its centre and size.
void set_face_and_normal(Anchor& anchor, const Model& head, const FaceFrame& face)
{
    anchor.face = {(anchor.centre.x - face.nose_tip.x) / face.unit_m,
                   (anchor.centre.y - face.nose_tip.y) / face.unit_m};
    anchor.normal = mean_normal(head, anchor.centre, std::max(0.7 * anchor.half_width_m, 0.006));
}

} // namespace

FaceFrame find_face(const Model& head)
{
    // The tip of the nose is the frontmost vertex of the upper 65 %; a chest may be below.
    const float lowest = head.min.y + 0.35f * (head.max.y - head.min.y);
    FaceFrame face;
    face.nose_tip = glm::dvec3(0, 0, std::numeric_limits<double>::lowest());
    for (const Vertex& vertex : head.vertices)
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

Anchor anchor_wound(const Model& head, const Bvh& solid, const FaceFrame& face, const Place& place,
                    double patch_width_mm, double roll_deg, const std::string& where)
{
    Anchor anchor;
    anchor.half_width_m = patch_width_mm * 0.5e-3;
    if (const auto* point = std::get_if<glm::dvec3>(&place)) {
        anchor.centre = nearest_on_surface(head, *point).at;
        if (const double off = glm::distance(anchor.centre, *point); off > 0.05)
            throw base::InputError(where, fmt::format("lies {:.0f} mm away from the head", off * 1e3),
                                   "give a point on the head in metres, or face coordinates [x, y]");
    } else {
        const std::optional<FacePoint> known = known_face_point(place);
        if (!known)
            throw base::InputError(where, "\"" + std::get<std::string>(place) + "\" is not a known place",
                                   "use cheek, eyebrow, chin, forehead, nose, or coordinates");
        const FacePoint at = *known;
        const glm::dvec3 eye(face.nose_tip.x + at.x * face.unit_m, face.nose_tip.y + at.y * face.unit_m,
                             double(head.max.z) + 1.0);
        const auto seen = first_on_ray(solid, eye, {0, 0, -1}); // the skin that a viewer in front sees
        if (!seen)
            throw base::InputError(where,
                                   fmt::format("face coordinates [{:g}, {:g}] miss the head", at.x, at.y),
                                   "stay within about -0.5 to 0.5 across and -0.7 to 0.9 up");
        anchor.centre = seen->at;
    }
    set_face_and_normal(anchor, head, face);
    const glm::dvec3 up = std::abs(anchor.normal.y) > 0.95 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 level = glm::normalize(glm::cross(up, anchor.normal)); // towards the viewer's right
    const glm::dvec3 below = glm::cross(level, anchor.normal);              // and down the face
    const double roll = glm::radians(roll_deg);
    anchor.right = std::cos(roll) * level - std::sin(roll) * below;
    anchor.down = std::sin(roll) * level + std::cos(roll) * below;
    return anchor;
}

Anchor anchor_beside(const Model& head, const Bvh& solid, const FaceFrame& face, const Anchor& first,
                     const glm::dvec2& offset_m, double patch_width_mm, const std::string& where)
{
    // Starts close above the first patch's plane, so that no other part of the head blocks the ray.
    const double distance = glm::length(offset_m), above = std::max(distance, first.half_width_m);
    const glm::dvec3 origin =
        first.centre + offset_m.x * first.right + offset_m.y * first.down + above * first.normal;
    const auto found = first_on_ray(solid, origin, -first.normal);
    if (!found || glm::distance(found->at, origin) > 2.5 * above)
        throw base::InputError(
            where,
            fmt::format("lies {:.0f} mm from the largest wound, where there is no skin", distance * 1e3),
            "give a smaller width_mm, another roll_deg or a place further from the head's edge");
    Anchor anchor;
    anchor.half_width_m = patch_width_mm * 0.5e-3;
    anchor.centre = found->at;
    set_face_and_normal(anchor, head, face);
    anchor.down = glm::normalize(glm::cross(first.right, anchor.normal));
    anchor.right = glm::cross(anchor.normal, anchor.down);
    return anchor;
}

glm::dvec3 in_frame(const Anchor& anchor, const glm::dvec3& point)
{
    const glm::dvec3 d = (point - anchor.centre) / anchor.half_width_m;
    return {glm::dot(d, anchor.right), glm::dot(d, anchor.down), glm::dot(d, anchor.normal)};
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

} // namespace head
