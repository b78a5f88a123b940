// The pictures of a capture: the day, camera and file name of each.
#pragma once
#include <string>
#include <vector>

#include "scene/loaded_scene.hpp"

namespace scene {

/// One picture.
struct Shot
{
    double day = 0;
    std::string view; // the camera's name
    head::Camera camera;
    std::string name;    // of its files, without extension: "day_005"
    double turn_deg = 0; // rotation of the view's camera about the head
};

/// A view's name and camera.
struct NamedCamera
{
    std::string name;
    head::Camera camera;
};

/// Names and descriptions of the views that every scene has: camera (the scene's own), front, left, right,
/// ..., close-up (of the first wound).
std::vector<std::pair<std::string, std::string>> standard_views();

/// The names of the views to draw: the chosen ones, standard or the scene's own; if none is chosen, all that
/// the scene lists. Throws base::InputError for an unknown or repeated name.
std::vector<std::string> view_names(const Scene& scene, const std::vector<std::string>& chosen);
/// view_names() with their cameras; if there are none, the scene's camera with an empty name.
std::vector<NamedCamera> chosen_views(const LoadedScene& scene, const std::vector<std::string>& chosen);

/// One picture per day and view, named day_005, day_005.500; the second of the same day is day_005_2; a
/// view's name is appended: day_005_front.
std::vector<Shot> shots_of_days(const std::vector<double>& days, const std::vector<NamedCamera>& views);

/// Evenly spaced pictures of a film or turntable: the day goes from first_day to last_day while the camera
/// turns by turn_deg about the head, positive towards the viewer's right.
struct Sweep
{
    double first_day = 0, last_day = 0;
    double turn_deg = 0;   // reached by the last picture; for whole turns the last picture is one step before
    std::size_t count = 2; // at least 1
    std::string stem = "frame";
};
/// Named STEM_000, STEM_001, ...; a view's name is appended.
std::vector<Shot> shots_of_sweep(const LoadedScene& scene, const NamedCamera& view, const Sweep& sweep);

} // namespace scene
