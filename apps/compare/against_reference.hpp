// `cicatrix compare SCENE.json --reference`: how far a scene's pictures are from its path-traced truth, for
// each region of the picture apart.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reference/regions.hpp"
#include "scene/command_line.hpp"

namespace CLI {
class App;
}

namespace compare_command {

struct ReferenceOptions
{
    bool wanted = false;
    reference::Until until;
    reference::Levels levels;
};

struct CompareOptions : scene::SceneOptions
{
    std::string other; // file of the second scene
    std::filesystem::path out = "out/compare";
    std::vector<std::string> views;
    int rounds = 9; // of the cost measurement, for each scene
    ReferenceOptions reference;
};

void add_reference_options(CLI::App& command, ReferenceOptions& options);

/// CIEDE2000 between a picture and the truth in one region; pixels = 0 when the picture does not show it.
struct RegionError
{
    std::size_t pixels = 0;
    double mean = 0, p95 = 0, p999 = 0, max = 0;
    double l = 0, a = 0, b = 0; // means of picture - truth, CIELAB
    double noise = 0;           // mean difference that two such truths would have
};

/// Per pixel; all of one size.
struct PixelErrors
{
    cv::Mat1f de, noise; // CIEDE2000
    cv::Mat3f lab;       // picture - truth
};
RegionError error_in(const cv::Mat1b& region, const PixelErrors& errors);

/// Writes the pages and numbers into options.out. Throws base::InputError.
void compare_with_reference(const CompareOptions& options);

} // namespace compare_command
