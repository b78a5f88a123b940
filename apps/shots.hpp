// What a capture draws: for every picture its day, its camera and the name of its files.
#pragma once
#include <string>
#include <vector>

#include "apps/renderer.hpp"
#include "apps/scene.hpp"
#include "apps/stage.hpp"

namespace app {

/// A view's name and where it is seen from.
struct View
{
    std::string name;
    passes::Camera camera;
};

/// The views that every scene has: camera (the scene's own), front, left, right, ..., close-up (of the first
/// wound), close-up-2, ... With what each shows, for people.
std::vector<std::pair<std::string, std::string>> standard_views();

/// The views asked for by name, standard ones or the scene's own; without names, all of the scene's; when it
/// has none, its camera alone, under an empty name. Throws cicatrix::InputError for a name that does not
/// exist.
std::vector<View> chosen_views(const Stage& stage, const std::vector<std::string>& names);

/// One picture per day and view. day_005, day_005.5; the second of the same day is day_005_2; a view's name
/// follows: day_005_front.
std::vector<Shot> shots_of_days(const std::vector<double>& days, const std::vector<View>& views);

} // namespace app
