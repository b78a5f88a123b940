#include "scene/loaded_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/input_error.hpp"
#include "head/albedo_under.hpp"
#include "head/surface.hpp"
#include "head/vectors.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/prepare.hpp"

namespace scene {
namespace {

/// About the height from chin to crown, m; the object's size in the paper's set-up.
double head_height(const head::FaceFrame& face)
{
    return 1.65 * face.unit_m;
}

optics::Light make_light(const Light& light, const head::FaceFrame& face)
{
    const glm::dvec3 towards = unit_towards(light.from), middle = face_middle(face);
    optics::Light made;
    made.kind = light.directional ? optics::LightKind::Directional
                : light.falloff   ? optics::LightKind::Point
                                  : optics::LightKind::PointWithoutFalloff;
    made.position = head::to_cv(middle + light.distance_m * towards);
    made.direction = head::to_cv(towards);
    made.strength = cv::Vec3d(light.color[0], light.color[1], light.color[2]) * light.intensity;
    made.reference_distance_m = std::max(light.distance_m, 1e-3);
    made.paper_units_per_m = optics::paper_units_per_m(head_height(face));
    return made;
}

/// The scene's lights around this face. Throws base::InputError if a value is out of range or eq. (6) is
/// undefined.
std::vector<optics::Light> make_lights(const Scene& scene, const head::FaceFrame& face)
{
    std::vector<optics::Light> made;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        made.push_back(make_light(scene.lights[i], face));
        optics::check_light(made[i], fmt::format("scene: /lights/{}", i));
        optics::check_shading(
            scene.shading,
            optics::translucency_distances(made[i], head::to_cv(face_middle(face)), head_height(face)),
            "scene: /shading");
    }
    return made;
}

/// Tells once of each tissue where the paper's equations leave their domain.
void add_domain_notes(LoadedScene& loaded)
{
    std::vector<std::string> told;
    for (const PlacedWound& wound : loaded.wounds) {
        const auto note =
            optics::domain_note(optics::layers_of(loaded.tissue_at(wound)), loaded.scene.reflectance_model);
        if (!note || std::ranges::count(told, *note) > 0)
            continue;
        told.push_back(*note);
        loaded.notes.push_back(
            fmt::format("{}: {}", name_of(loaded.shown[wound.scene_wound], wound.scene_wound), *note));
    }
}

/// `exact`: `photograph` was fitted for this wound; otherwise it replaces one that is not ready yet.
void place_wound(LoadedScene& loaded, std::size_t index,
                 const std::shared_ptr<const FittedPhotograph>& photograph, const std::string& name,
                 bool exact)
{
    const Wound& wound = loaded.shown[index];
    const std::vector<head::Anchor> anchors =
        exact ? std::vector<head::Anchor>{} : anchors_of(wound, *photograph, *loaded.head, name);
    for (std::size_t i = 0; i < photograph->wounds.size(); ++i) {
        const FittedWound& fitted = photograph->wounds[i];
        const bool same_course = wound.healing == photograph->wound.healing;
        loaded.wounds.push_back({index, photograph, i, exact ? fitted.anchor : anchors[i],
                                 same_course ? fitted.region : cv::Rect{}, wound.healing});
    }
}

void place_wounds(LoadedScene& loaded, WoundLoader& loader, const LoadedScene& before, bool dragging)
{
    for (std::size_t i = 0; i < loaded.shown.size(); ++i) {
        const Wound& wound = loaded.shown[i];
        const std::string name = name_of(wound, i);
        auto photograph = loader.fitted(wanted(loaded.shown, i), loaded.head, !dragging);
        const bool exact = photograph != nullptr;
        if (!exact) {
            loaded.complete = false;
            photograph = loader.similar(wound, loaded.head->face);
        }
        if (!photograph && i < before.photographs.size() && loaded.shown.size() == before.shown.size())
            photograph = before.photographs[i]; // the old photograph until the new one is ready
        loaded.photographs.push_back(photograph);
        if (!photograph)
            continue;
        check_count(loaded.wounds.size() + photograph->wounds.size(), photograph->wounds.size(), name);
        place_wound(loaded, i, photograph, name, exact);
        if (exact && !std::ranges::all_of(photograph->wounds,
                                          [](const auto& w) { return w.prepared.patch.shows_skin; }))
            loaded.notes.push_back(
                name + ": shows no healthy skin beside the wound; the face's skin is used instead");
    }
}

} // namespace

bool LoadedScene::same_tissue(const PlacedWound& a, const PlacedWound& b) const
{
    const auto* const table = std::get_if<optics::SkinLayers>(&tissue);
    return a.healing == b.healing &&
           (table == nullptr || !table->facial || a.fitted().thickness == b.fitted().thickness);
}

std::vector<wound::WoundDay> LoadedScene::wounds_on(double day) const
{
    std::vector<wound::WoundDay> today;
    for (const PlacedWound& wound : wounds)
        today.push_back(wound::wound_at(wound.prepared(), wound.healing, day));
    return today;
}

cv::Mat1f LoadedScene::surface_mm2(std::size_t wound) const
{
    const PlacedWound& placed = wounds.at(wound);
    const cv::Mat1f all =
        head::surface_under(*head->model, head->skin, placed.anchor, placed.prepared().patch.color.cols);
    return placed.region.empty() ? all : all(placed.region).clone();
}

std::vector<head::Anchor> LoadedScene::anchors() const
{
    std::vector<head::Anchor> anchors;
    for (const PlacedWound& wound : wounds)
        anchors.push_back(wound.anchor);
    return anchors;
}

double LoadedScene::distance(const Camera& from) const
{
    const double half_height = 0.98 * head->face.unit_m; // from the neck to the crown
    return from.distance_m > 0 ? from.distance_m : half_height / std::tan(glm::radians(from.fov_deg) / 2);
}

head::Camera LoadedScene::camera(const Camera& from) const
{
    const glm::dvec3 target =
        face_middle(head->face) + glm::dvec3(from.target_m[0], from.target_m[1], from.target_m[2]);
    return {target + distance(from) * unit_towards(from.from), target, from.fov_deg};
}

head::Camera LoadedScene::close_up(std::size_t wound) const
{
    if (wound >= wounds.size())
        return camera();
    const head::Anchor& anchor = wounds[wound].anchor;
    // Tilted from the surface's normal towards the scene's camera, so that the hollow is recognisable.
    const glm::dvec3 towards = glm::normalize(anchor.normal + 0.35 * unit_towards(scene.camera.from));
    constexpr double fov_deg = 12;
    const double away = 0.95 * anchor.half_width_m / std::tan(glm::radians(fov_deg) / 2);
    return {anchor.centre + away * towards, anchor.centre, fov_deg};
}

glm::dvec3 LoadedScene::head_middle() const
{
    return face_middle(head->face) - glm::dvec3(0, 0, 0.3 * head->face.unit_m);
}

std::optional<glm::dvec3> LoadedScene::pick(const head::Camera& camera, double x, double y,
                                            double aspect) const
{
    const std::optional<head::SurfacePoint> seen =
        head::first_on_ray(*head->bvh, camera.eye, head::sight_through(camera, x, y, aspect));
    if (!seen || seen->material != head->skin)
        return std::nullopt;
    return seen->at;
}

std::optional<std::size_t> LoadedScene::wound_near(const glm::dvec3& point, double tolerance_m) const
{
    std::optional<std::size_t> found;
    double nearest = 1;
    for (const PlacedWound& wound : wounds) {
        const head::Anchor& anchor = wound.anchor;
        const glm::dvec3 from = (point - anchor.centre) / anchor.half_width_m;
        const double height = glm::dot(from, anchor.normal);
        if (std::abs(height) > head::Anchor::reach)
            continue;
        const cv::Point2f at(float(glm::dot(from, anchor.right)), float(glm::dot(from, anchor.down)));
        const std::vector<cv::Point2f> border(wound.prepared().border.begin(), wound.prepared().border.end());
        const double inside = cv::pointPolygonTest(border, at, true); // distance, positive inside
        const double distance = std::hypot(at.x, at.y);
        if (inside * anchor.half_width_m >= -tolerance_m && (!found || distance < nearest)) {
            found = wound.scene_wound;
            nearest = distance;
        }
    }
    return found;
}

std::shared_ptr<const LoadedHead> begin_loading(WoundLoader& loader, const Scene& scene)
{
    check(scene);
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        loader.begin(wanted(scene.wounds, i));
    std::shared_ptr<const LoadedHead> head = load_head(scene.head);
    loader.put(head);
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        loader.fitted(wanted(scene.wounds, i), head);
    return head;
}

LoadedScene assemble(const Scene& scene, WoundLoader& loader, const LoadedScene& before, bool dragging)
{
    check(scene);
    LoadedScene loaded;
    loaded.scene = scene;
    loaded.complete = true;
    if (std::shared_ptr<const LoadedHead> head = loader.head(scene.head, before.head)) {
        loaded.head = std::move(head);
        loaded.shown = scene.wounds;
    } else {
        loaded.head = before.head;
        loaded.shown = before.shown; // the new wounds may be placed for the new head
        loaded.complete = false;
    }
    loaded.tissue = (before.complete || !before.shown.empty()) && scene.tissue == before.scene.tissue
                        ? before.tissue
                        : optics::healing_tissue_or_file(scene.tissue);
    loaded.notes = loaded.head->notes;
    loaded.lights = make_lights(scene, loaded.head->face);
    place_wounds(loaded, loader, before, dragging);
    add_domain_notes(loaded);
    return loaded;
}

LoadedScene load(const Scene& scene)
{
    WoundLoader loader;
    LoadedScene loaded;
    loaded.head = begin_loading(loader, scene);
    while (!loaded.complete) {
        loaded = assemble(scene, loader, loaded, false);
        loader.wait();
        loader.collect();
    }
    return loaded;
}

glm::dvec3 face_middle(const head::FaceFrame& face)
{
    return face.nose_tip + face.unit_m * glm::dvec3(0, 0.13, -0.45);
}

glm::dvec3 unit_towards(const Direction& from)
{
    const double azimuth = glm::radians(from.azimuth_deg), elevation = glm::radians(from.elevation_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

} // namespace scene
