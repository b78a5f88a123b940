#include "apps/around_face.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace app {
namespace {

/// Crown to chin, about; the object of the paper's set-up.
double head_height(const passes::FaceFrame& face)
{
    return 1.65 * face.unit_m;
}

cv::Vec3d to_cv(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

wound::Light make_light(const LightScene& scene, const passes::FaceFrame& face)
{
    const glm::dvec3 towards = unit_towards(scene.from), middle = face_middle(face);
    wound::Light light;
    light.kind = scene.directional ? wound::LightKind::Directional
                 : scene.falloff   ? wound::LightKind::Point
                                   : wound::LightKind::PointWithoutFalloff;
    light.position = to_cv(middle + scene.distance_m * towards);
    light.direction = to_cv(towards);
    light.strength = cv::Vec3d(scene.color[0], scene.color[1], scene.color[2]) * scene.intensity;
    light.reference_distance_m = std::max(scene.distance_m, 1e-3);
    light.translucency_distance = wound::paper_distance(head_height(face), scene.distance_m);
    return light;
}

} // namespace

glm::dvec3 face_middle(const passes::FaceFrame& face)
{
    return face.nose_tip + face.unit_m * glm::dvec3(0, 0.13, -0.45);
}

glm::dvec3 unit_towards(const Direction& from)
{
    const double azimuth = glm::radians(from.azimuth_deg), elevation = glm::radians(from.elevation_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

std::vector<wound::Light> make_lights(const Scene& scene, const passes::FaceFrame& face)
{
    std::vector<wound::Light> made;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        made.push_back(make_light(scene.lights[i], face));
        wound::check_light(made[i], fmt::format("scene: /lights/{}", i));
        wound::check_shading(
            scene.shading.model,
            wound::translucency_distances(made[i], to_cv(face_middle(face)), head_height(face)),
            "scene: /shading");
    }
    return made;
}

} // namespace app
