#include "scene/shots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "base/input_error.hpp"

namespace scene {
namespace {

struct StandardView
{
    const char* name;
    Direction from;
    const char* shows;
};
constexpr std::array<StandardView, 7> around_the_head{{
    {"front", {0, 0}, "the face"},
    {"left", {-90, 0}, "the profile on the viewer's left"},
    {"right", {90, 0}, "the profile on the viewer's right"},
    {"three-quarter", {45, 0}, "between front and right"},
    {"three-quarter-left", {-45, 0}, "between front and left"},
    {"above", {0, 45}, "the face from above"},
    {"below", {0, -40}, "the face from below"},
}};

/// Rotates a camera about the head's middle, so that the head stays in the picture.
head::Camera turned(const LoadedScene& loaded, const head::Camera& camera, const Direction& by)
{
    if (by.azimuth_deg == 0 && by.elevation_deg == 0)
        return camera;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(by.azimuth_deg), glm::dvec3(0, 1, 0)) *
                            glm::rotate(glm::dmat4(1), -glm::radians(by.elevation_deg), glm::dvec3(1, 0, 0));
    const glm::dvec3 middle = loaded.head_middle();
    const auto about = [&](const glm::dvec3& point) {
        return middle + glm::dvec3(turn * glm::dvec4(point - middle, 0));
    };
    return {about(camera.eye), about(camera.target), camera.fov_deg};
}

/// All names of views in this scene.
std::vector<std::string> known_views(const Scene& scene)
{
    std::vector<std::string> known;
    for (const View& view : scene.views)
        if (view.camera)
            known.push_back(view.name);
    for (const auto& [name, shows] : standard_views())
        known.push_back(name);
    for (std::size_t wound = 2; wound <= scene.wounds.size(); ++wound)
        known.push_back(fmt::format("close-up-{}", wound));
    return known;
}

/// The camera of a view; `name` is one of known_views().
head::Camera camera_of_view(const LoadedScene& loaded, const std::string& name)
{
    const Scene& scene = loaded.scene;
    for (const View& view : scene.views)
        if (view.name == name && view.camera)
            return loaded.camera(*view.camera);
    for (const StandardView& view : around_the_head)
        if (view.name == name)
            return turned(loaded, loaded.camera({{0, 0}, scene.camera.distance_m, scene.camera.fov_deg}),
                          view.from);
    if (name == "camera")
        return loaded.camera();
    const std::size_t wound = name == "close-up" ? 0 : std::size_t(name.back() - '1');
    return loaded.close_up(wound);
}

std::string day_text(double day)
{
    return fmt::format("day_{:0>3}",
                       day == std::floor(day) ? fmt::format("{:.0f}", day) : fmt::format("{:07.3f}", day));
}

} // namespace

std::vector<std::pair<std::string, std::string>> standard_views()
{
    std::vector<std::pair<std::string, std::string>> views{{"camera", "the scene's own camera"}};
    for (const StandardView& view : around_the_head)
        views.emplace_back(view.name, view.shows);
    views.emplace_back("close-up", "the first wound from close by; close-up-2 the second, and so on");
    return views;
}

std::vector<std::string> view_names(const Scene& scene, const std::vector<std::string>& chosen)
{
    std::vector<std::string> names = chosen;
    if (chosen.empty())
        for (const View& view : scene.views)
            names.push_back(view.name);
    const std::string where = chosen.empty() ? "scene: /views" : "--views";
    const std::vector<std::string> known = known_views(scene);
    for (const std::string& name : names) {
        if (std::ranges::count(names, name) > 1)
            throw base::InputError(where, "names \"" + name + "\" twice", "name each view once");
        if (std::ranges::find(known, name) == known.end())
            throw base::InputError(where, "there is no view \"" + name + "\" in this scene",
                                   fmt::format("choose from {}", fmt::join(known, ", ")));
    }
    return names;
}

std::vector<NamedCamera> chosen_views(const LoadedScene& loaded, const std::vector<std::string>& chosen)
{
    std::vector<NamedCamera> views;
    for (const std::string& name : view_names(loaded.scene, chosen))
        views.push_back({name, camera_of_view(loaded, name)});
    if (views.empty())
        views.push_back({"", loaded.camera()});
    return views;
}

std::vector<Shot> shots_of_days(const std::vector<double>& days, const std::vector<NamedCamera>& views)
{
    std::vector<Shot> shots;
    std::map<double, int> repetitions;
    for (const double day : days) {
        const int repetition = ++repetitions[day];
        for (const NamedCamera& view : views)
            shots.push_back({day, view.name, view.camera,
                             day_text(day) + (repetition > 1 ? fmt::format("_{}", repetition) : "") +
                                 (view.name.empty() ? "" : "_" + view.name)});
    }
    return shots;
}

std::vector<Shot> shots_of_sweep(const LoadedScene& loaded, const NamedCamera& view, const Sweep& sweep)
{
    const bool closed = sweep.turn_deg != 0 && std::fmod(sweep.turn_deg, 360) == 0;
    const double last = std::max<double>(1, double(sweep.count) - 1);
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < sweep.count; ++i) {
        const double turn = sweep.turn_deg * double(i) / (closed ? double(sweep.count) : last);
        const double day = sweep.first_day + (sweep.last_day - sweep.first_day) * double(i) / last;
        Shot& shot = shots.emplace_back(Shot{day, view.name, turned(loaded, view.camera, {turn, 0})});
        shot.name = fmt::format("{}_{:03}", sweep.stem, i) + (view.name.empty() ? "" : "_" + view.name);
        shot.turn_deg = turn;
    }
    return shots;
}

} // namespace scene
