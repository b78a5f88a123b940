// A scene as a value: head, wounds, cameras, lights and days. scene/field_table.hpp defines its fields,
// scene/file.hpp reads and writes it, docs/scene.md documents it.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "head/placement.hpp"
#include "wound/depth.hpp"
#include "wound/healing/healing.hpp"
#include "wound/optics/reflectance.hpp"
#include "wound/optics/shading.hpp"
#include "wound/photo/segmentation.hpp"

namespace scene {

struct Wound
{
    std::filesystem::path photo;           // empty: the default wound, generated from `kind` and `seed`
    std::filesystem::path mask;            // empty: the photo is segmented
    wound::SegmentationHints segmentation; // used without a mask
    std::string kind = "avulsion";         // wound::kind_names()
    std::uint32_t seed = 3;
    head::Place place = std::string("cheek");
    double width_mm = 30;    // the wound's longer side
    double roll_deg = 0;     // counter-clockwise as the viewer sees it
    double depth_factor = 1; // factor on the thickness of the tissue's layers
    wound::Healing healing;  // here usual_healing() of a Wound{}
    bool operator==(const Wound&) const = default;
};

/// How a wound closes where a scene does not say it: a default wound by its kind, width and place, a
/// photograph's by the default curve.
wound::Healing usual_healing(const Wound& wound);

/// After an edit of a wound's kind, width, place or photo: if its course was the usual one and was not edited
/// itself, it becomes the usual one of the edited wound; the model stays.
void follow_usual_course(const Wound& before, Wound& edited);

/// Thickness of the skin's layers at a place of the face, without depth_factor.
wound::TissueThickness tissue_at(const head::FacePoint& face);

/// A direction from the face's middle: 0, 0 is in front; positive azimuth is to the viewer's right, positive
/// elevation above.
struct Direction
{
    double azimuth_deg = 0, elevation_deg = 0;
    bool operator==(const Direction&) const = default;
};

struct Light
{
    Direction from;
    double distance_m = 0.25; // from the face's middle; directional: used by the translucency term only
    bool directional = false;
    bool falloff = true;                  // inverse square; eq. (8) has none
    std::array<double, 3> color{1, 1, 1}; // linear
    double intensity = 1;                 // irradiance / pi at the face's middle
    bool operator==(const Light&) const = default;
};

struct Camera
{
    Direction from{18, 2};
    double distance_m = 0;            // from the target; 0: chosen so that the head fills the picture
    double fov_deg = 20;              // vertical
    std::array<double, 3> target_m{}; // point that the camera looks at, relative to the face's middle
    bool operator==(const Camera&) const = default;
};

/// An additional camera, or the name of a standard view (scene/shots.hpp).
struct View
{
    std::string name;             // letters, digits, - and _: becomes part of file names
    std::optional<Camera> camera; // nullopt: `name` is a standard view
    bool operator==(const View&) const = default;
};

struct Scene
{
    std::filesystem::path head; // empty: the default head
    std::vector<Wound> wounds{Wound{}};
    std::string tissue = "light"; // a preset, or a tissue file
    optics::ReflectanceModel reflectance_model = optics::ReflectanceModel::Calibrated;
    optics::Shading shading = optics::skin_shading();
    std::vector<Light> lights{{{-38, 28}, 0.9, false, true, {1.0, 0.96, 0.91}, 1.25},
                              {{60, 10}, 1.2, false, true, {0.86, 0.92, 1.0}, 0.4}};
    Camera camera;
    std::vector<View> views; // views that `capture` draws; empty: `camera` only
    std::array<std::uint32_t, 2> size{1280, 720};
    std::uint32_t samples = 1; // 1 or 4
    double exposure_stops = 0; // each stop doubles the light
    std::vector<double> days{0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30};
    bool operator==(const Scene&) const = default;
};

/// The wound's name in messages: the photograph's path, or for example "wound 2".
std::string name_of(const Wound& wound, std::size_t index);

/// The last of the days, at least 1: reflectance tables reach so far.
double last_day(const Scene& scene);

/// The paper's distance of 2 between light and face, for a head that is 25 cm from chin to crown, as the
/// default head is.
inline constexpr double published_light_distance_m = optics::paper_light_distance / optics::paper_width * .25;

/// Published mode: everything as in the paper, nothing of ours beside it. Eqs. (2) and (3) in their domain,
/// of Table 1 as thick as at the wound's place; eqs. (4), (6) and (7) as printed, with the paper's
/// coefficients; contraction alone; one light without falloff at the paper's distance; no shadow, no ambient
/// light. A scene may also name the `published` model of a single equation. docs/shading.md compares the
/// modes.
void make_published(Scene& scene);

/// Checks a scene that was not read by read_scene(), for instance one edited in the window: counts of days,
/// wounds and lights, and ranges of the healing curves. Throws base::InputError.
void check(const Scene& scene);

} // namespace scene
