#include "apps/shots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "wound/input_error.hpp"

namespace app {
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

/// "close-up" is of wound 0, "close-up-2" of wound 1; none: the name is no close-up's.
std::optional<std::size_t> close_up_of(const std::string& name)
{
    const std::string stem = "close-up";
    if (name == stem)
        return 0;
    if (name.size() == stem.size() + 2 && name.starts_with(stem + "-") && name.back() >= '2' &&
        name.back() <= '9')
        return std::size_t(name.back() - '1');
    return std::nullopt;
}

/// Turns a camera that looks at the face about the head's middle, so that the head stays in the picture.
passes::Camera turned(const Stage& stage, const passes::Camera& camera, const Direction& by)
{
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(by.azimuth_deg), glm::dvec3(0, 1, 0)) *
                            glm::rotate(glm::dmat4(1), -glm::radians(by.elevation_deg), glm::dvec3(1, 0, 0));
    const glm::dvec3 middle = stage.head_middle();
    const auto about = [&](const glm::dvec3& point) {
        return middle + glm::dvec3(turn * glm::dvec4(point - middle, 0));
    };
    return {about(camera.eye), about(camera.target), camera.fov_deg};
}

std::optional<passes::Camera> standard_camera(const Stage& stage, const std::string& name)
{
    const Scene& scene = stage.scene();
    if (name == "camera")
        return stage.camera();
    if (const auto wound = close_up_of(name); wound && *wound < std::max<std::size_t>(1, scene.wounds.size()))
        return stage.close_up(*wound);
    for (const StandardView& view : around_the_head)
        if (view.name == name)
            return turned(stage, stage.camera({{0, 0}, scene.camera.distance_m, scene.camera.fov_deg}),
                          view.from);
    return std::nullopt;
}

View find_view(const Stage& stage, const std::string& name, const std::string& where)
{
    for (const ViewScene& view : stage.scene().views)
        if (view.name == name && view.camera)
            return {name, stage.camera(*view.camera)};
    if (const auto camera = standard_camera(stage, name))
        return {name, *camera};
    std::vector<std::string> known;
    for (const ViewScene& view : stage.scene().views)
        if (view.camera)
            known.push_back(view.name);
    for (const auto& [standard, shows] : standard_views())
        known.push_back(standard);
    throw cicatrix::InputError(where, "there is no view \"" + name + "\" in this scene",
                               fmt::format("choose from {}", fmt::join(known, ", ")));
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
    views.emplace_back("close-up", "the first wound, large; close-up-2 the second, and so on");
    return views;
}

std::vector<View> chosen_views(const Stage& stage, const std::vector<std::string>& names)
{
    const Scene& scene = stage.scene();
    std::vector<View> views;
    for (const std::string& name : names) {
        if (std::ranges::find(views, name, &View::name) != views.end())
            throw cicatrix::InputError("--views", "names \"" + name + "\" twice", "name each view once");
        views.push_back(find_view(stage, name, "--views"));
    }
    if (names.empty())
        for (const ViewScene& view : scene.views)
            views.push_back(find_view(stage, view.name, "scene: /views"));
    if (views.empty())
        views.push_back({"", stage.camera()});
    return views;
}

std::vector<Shot> shots_of_days(const std::vector<double>& days, const std::vector<View>& views)
{
    std::vector<Shot> shots;
    std::map<double, int> repetitions;
    for (const double day : days) {
        const int repetition = ++repetitions[day];
        for (const View& view : views)
            shots.push_back({day, view.name, view.camera,
                             day_text(day) + (repetition > 1 ? fmt::format("_{}", repetition) : "") +
                                 (view.name.empty() ? "" : "_" + view.name)});
    }
    return shots;
}

} // namespace app
