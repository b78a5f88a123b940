#include "scene/scene.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/input_error.hpp"
#include "shaders/shared/frame.h"
#include "shaders/shared/shading.h"
#include "wound/synthetic/kind.hpp"

namespace scene {

std::string name_of(const Wound& wound, std::size_t index)
{
    return wound.photo.empty() ? fmt::format("wound {}", index + 1) : wound.photo.string();
}

namespace {

/// Converts face coordinates (unit: nose to crown) to those of wound::tissue_thickness(): ears at x = +-1,
/// hairline and chin at y = +-1.
cv::Point2d tissue_coordinates(const head::FacePoint& face)
{
    return {face.x / 0.55, face.y / (face.y > 0 ? 0.65 : 0.58)};
}

} // namespace

wound::TissueThickness tissue_at(const head::FacePoint& face)
{
    return wound::tissue_thickness(tissue_coordinates(face));
}

wound::Healing usual_healing(const Wound& wound)
{
    if (!wound.photo.empty())
        return {};
    return wound::usual_healing(wound::kind_named(wound.kind), wound.width_mm,
                                tissue_at(head::known_face_point(wound.place).value_or(head::FacePoint{})));
}

void follow_usual_course(const Wound& before, Wound& edited)
{
    wound::Healing usual = usual_healing(before);
    usual.model = before.healing.model;
    if (before.healing != usual || edited.healing != before.healing)
        return;
    edited.healing = usual_healing(edited);
    edited.healing.model = before.healing.model;
}

double last_day(const Scene& scene)
{
    return std::max(1.0, *std::ranges::max_element(scene.days));
}

void make_published(Scene& scene)
{
    scene.shading = optics::published_shading();
    scene.reflectance_model = optics::ReflectanceModel::Published;
    scene.tissue = "table1";
    for (Wound& wound : scene.wounds)
        wound.healing.model = wound::HealingModel::Contraction;
    if (!scene.lights.empty()) {
        scene.lights.resize(1);
        scene.lights.front().falloff = false;
        scene.lights.front().distance_m = published_light_distance_m;
    }
}

void check(const Scene& scene)
{
    if (scene.days.empty())
        throw base::InputError("scene: /days", "is empty", "name at least one day");
    if (scene.wounds.size() > std::size_t(shared::MAX_WOUNDS))
        throw base::InputError("scene: /wounds", fmt::format("holds {}", scene.wounds.size()),
                               fmt::format("give at most {}", shared::MAX_WOUNDS));
    if (scene.lights.size() > std::size_t(shared::MAX_LIGHTS))
        throw base::InputError("scene: /lights", fmt::format("holds {}", scene.lights.size()),
                               fmt::format("give at most {}", shared::MAX_LIGHTS));
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        wound::validate(scene.wounds[i].healing, fmt::format("scene: /wounds/{}/healing", i));
}

} // namespace scene
