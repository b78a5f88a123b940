#include "scene/scene.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/input_error.hpp"
#include "shaders/shared/frame.h"
#include "shaders/shared/shading.h"

namespace scene {

std::string name_of(const Wound& wound, std::size_t index)
{
    return wound.photo.empty() ? fmt::format("wound {}", index + 1) : wound.photo.string();
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
