// The scene file: what is shown, from where, in which light, on which days. docs/scene.md documents every
// field.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "passes/forward.hpp"
#include "passes/placement.hpp"
#include "wound/healing.hpp"
#include "wound/reflectance.hpp"
#include "wound/segmentation.hpp"

namespace app {

struct WoundScene
{
    std::filesystem::path photo;           // empty: the default wound, generated from `kind` and `seed`
    std::filesystem::path mask;            // empty: segmented
    wound::SegmentationHints segmentation; // without a mask
    std::string kind = "abrasion";
    std::uint32_t seed = 3;
    passes::Place place = std::string("cheek");
    double width_mm = 30;    // of the wound along its longer side
    double roll_deg = 0;     // counter-clockwise as the viewer sees it
    double depth_factor = 1; // scales the tissue's depth
    wound::Healing healing;
    bool operator==(const WoundScene&) const = default;
};

/// A place around the face's middle: 0, 0 is in front; positive azimuth towards the viewer's right, positive
/// elevation above.
struct Direction
{
    double azimuth_deg = 0, elevation_deg = 0;
    bool operator==(const Direction&) const = default;
};

struct LightScene
{
    Direction from;
    double distance_m = 0.25; // from the face's middle; directional lights have none
    bool directional = false;
    bool falloff = true;                  // inverse square; eq. (8) has none
    std::array<double, 3> color{1, 1, 1}; // linear
    double intensity = 1;                 // irradiance / pi at the face's middle
    bool operator==(const LightScene&) const = default;
};

struct CameraScene
{
    Direction from{18, 2};
    double distance_m = 0;            // from the face's middle; 0: such that the head fills the picture
    double fov_deg = 20;              // vertical
    std::array<double, 3> target_m{}; // what it looks at, from the face's middle
    bool operator==(const CameraScene&) const = default;
};

/// A camera beside the scene's own, or the name of one that every scene has (apps/shots.hpp).
struct ViewScene
{
    std::string name; // letters, digits, - and _: it goes into names of files
    std::optional<CameraScene> camera;
    bool operator==(const ViewScene&) const = default;
};

/// The mended equations with coefficients for skin, and everything as the paper prints it.
passes::Shading corrected_shading();
passes::Shading published_shading();

struct Scene
{
    std::filesystem::path head; // empty: the default head
    std::vector<WoundScene> wounds{WoundScene{}};
    std::string tissue = "light"; // a preset, or a tissue file
    wound::Rung reflectance_model = wound::Rung::Calibrated;
    passes::Shading shading = corrected_shading();
    std::vector<LightScene> lights{{{-38, 28}, 0.9, false, true, {1.0, 0.96, 0.91}, 1.25},
                                   {{60, 10}, 1.2, false, true, {0.86, 0.92, 1.0}, 0.4}};
    CameraScene camera;
    std::vector<ViewScene> views; // what `capture` shows; empty: `camera` alone
    std::array<std::uint32_t, 2> size{1280, 720};
    std::uint32_t samples = 1; // 1 or 4
    double exposure_stops = 0; // each doubles the light
    std::vector<double> days{0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30};
    bool operator==(const Scene&) const = default;
};

/// "segmentation": {"seed": [x, y], "rect": [x, y, w, h]}; messages begin with `where`. Throws
/// cicatrix::InputError.
wound::SegmentationHints read_hints(const nlohmann::json& object, const std::string& where);

/// Reads a scene; files inside are relative to the scene's folder. Throws cicatrix::InputError naming file
/// and field.
Scene read_scene(const std::filesystem::path& path);
/// The same of JSON that was read or made elsewhere: files inside are relative to the folder of `path`, and
/// messages begin with `where`.
Scene scene_of(const nlohmann::json& root, const std::filesystem::path& path, const std::string& where);
/// The scene as JSON, all fields spelled out, as capture.json records it; read_scene reads it back.
nlohmann::json to_json(const Scene& scene);

/// Writes the scene as a file that read_scene reads back as an equal value. Files in the new file's folder or
/// below are named relative to it, so that the folder can be moved; others absolutely. Throws
/// cicatrix::InputError when it cannot be written.
void save_scene(const std::filesystem::path& path, const Scene& scene);

/// "0:30:3" (first:last:step) or "0,5,12"; 0 to 3650, at most 10000 days. Throws cicatrix::InputError naming
/// `where`.
std::vector<double> parse_days(const std::string& text, const std::string& where);
/// "1280x720", 16 to 16384 a side. Throws cicatrix::InputError naming `where`.
std::array<std::uint32_t, 2> parse_size(const std::string& text, const std::string& where);

} // namespace app
