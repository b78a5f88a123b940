// What a capture draws: for every picture its day, its camera and the name of its files.
#pragma once
#include <string>
#include <vector>

#include "scene/loaded_scene.hpp"

namespace scene {

/// What one picture shows.
struct Shot
{
    double day = 0;
    std::string view; // the camera's name
    head::Camera camera;
    std::string name;    // of its files, without extension: "day_005"
    double turn_deg = 0; // by which the view's camera has gone about the head
};

/// A view's name and where it is seen from.
struct NamedCamera
{
    std::string name;
    head::Camera camera;
};

/// The views that every scene has: camera (the scene's own), front, left, right, ..., close-up (of the first
/// wound), close-up-2, ... With what each shows, for people.
std::vector<std::pair<std::string, std::string>> standard_views();

/// The names of the views to show: the chosen ones, standard or the scene's own; none chosen: all that the
/// scene lists. Throws base::InputError for a name that does not exist or comes twice.
std::vector<std::string> view_names(const Scene& scene, const std::vector<std::string>& chosen);
/// The same with their cameras; when there is none, the scene's camera under an empty name.
std::vector<NamedCamera> chosen_views(const LoadedScene& scene, const std::vector<std::string>& chosen);

/// One picture per day and view. day_005, day_005.5; the second of the same day is day_005_2; a view's name
/// follows: day_005_front.
std::vector<Shot> shots_of_days(const std::vector<double>& days, const std::vector<NamedCamera>& views);

/// Evenly spaced pictures over which the day moves from `first` to `last` while the camera goes `turn_deg`
/// about the head, positive towards the viewer's right: what films and turntables are made of.
struct Sweep
{
    double first_day = 0, last_day = 0;
    double turn_deg = 0;   // the last picture stands at its end, or, after whole turns, one step before it
    std::size_t count = 2; // at least 1
    std::string stem = "frame";
};
/// Named STEM_000, STEM_001, ...; a view's name follows.
std::vector<Shot> shots_of_sweep(const LoadedScene& scene, const NamedCamera& view, const Sweep& sweep);

} // namespace scene
