#include "apps/stage.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "apps/around_face.hpp"
#include "apps/bake.hpp"
#include "passes/reflectance_table.hpp"
#include "passes/skin_under.hpp"
#include "passes/split.hpp"
#include "passes/surface.hpp"
#include "shaders/shared/shading.h"
#include "wound/input_error.hpp"

namespace app {
namespace {

const wound::RungOptions scene_rung_options{.angles = 4, .photons = 2000}; // photons: per wavelength

double last_day(const Scene& scene)
{
    return std::max(1.0, *std::ranges::max_element(scene.days));
}

/// What a file could not say, for read_scene() checks it: the user interface may set anything.
void check(const Scene& scene)
{
    if (scene.days.empty())
        throw cicatrix::InputError("scene: /days", "is empty", "name at least one day");
    if (scene.wounds.size() > std::size_t(shared::MAX_WOUNDS))
        throw cicatrix::InputError("scene: /wounds", fmt::format("holds {}", scene.wounds.size()),
                                   fmt::format("give at most {}", shared::MAX_WOUNDS));
    if (scene.lights.size() > std::size_t(shared::MAX_LIGHTS))
        throw cicatrix::InputError("scene: /lights", fmt::format("holds {}", scene.lights.size()),
                                   fmt::format("give at most {}", shared::MAX_LIGHTS));
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        wound::validate(scene.wounds[i].healing, fmt::format("scene: /wounds/{}/healing", i));
}

std::vector<std::string> notes_on(const Scene& scene, const LoadedHead& head,
                                  const wound::HealingTissue& tissue)
{
    std::vector<std::string> notes = head.notes;
    if (scene.reflectance_model == wound::Rung::Published)
        if (const auto note = domain_note(layers_of(tissue)))
            notes.push_back(*note);
    return notes;
}

} // namespace

std::vector<std::shared_ptr<Fit>> Stage::Props::wounds() const
{
    std::vector<std::shared_ptr<Fit>> fits;
    for (std::size_t i = 0; i < scene.wounds.size(); ++i) {
        std::shared_ptr<Fit> fit;
        while (!(fit = workshop->fit(scene.wounds[i], head, name_of(scene.wounds[i], i)))) {
            workshop->wait();
            workshop->collect();
        }
        fits.push_back(std::move(fit));
    }
    return fits;
}

Stage::Props Stage::prepare(const Scene& scene)
{
    check(scene);
    Props props{scene, std::make_shared<Workshop>(), nullptr};
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        props.workshop->begin(scene.wounds[i], name_of(scene.wounds[i], i));
    props.head = load_head(scene.head);
    props.workshop->put(props.head);
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        props.workshop->fit(scene.wounds[i], props.head, name_of(scene.wounds[i], i));
    return props;
}

Stage::Stage(const engine::Device& device, const Scene& scene, const Props& props)
    : device_(&device), workshop_(props.workshop), seen_news_(props.workshop->news())
{
    set_.head = props.head;
    set_.bare = std::make_shared<const passes::Head>(passes::upload_head(device, *props.head->model));
    props.wounds();
    accept(make(scene));
    settle();
}

void Stage::update(const Scene& scene, bool dragging)
{
    const bool before = std::exchange(dragging_, dragging);
    try {
        accept(make(scene));
    } catch (...) {
        dragging_ = before;
        throw;
    }
}

void Stage::accept(Set set)
{
    set_ = std::move(set);
    if (set_.complete)
        whole_ = set_;
}

bool Stage::poll()
{
    workshop_->collect();
    if (seen_news_ == workshop_->news())
        return false;
    seen_news_ = workshop_->news();
    if (set_.complete)
        return false; // another stage's news
    try {
        accept(make(set_.scene));
    } catch (const cicatrix::InputError&) {
        accept(whole_);
        throw;
    }
    return true;
}

void Stage::settle()
{
    if (dragging_)
        update(Scene(set_.scene));
    while (pending()) {
        workshop_->wait();
        poll();
    }
}

void Stage::foresee(const Scene& scene) const
{
    try {
        const std::shared_ptr<const LoadedHead> head = workshop_->head(scene.head, set_.head);
        for (std::size_t i = 0; i < scene.wounds.size(); ++i)
            if (const std::string name = name_of(scene.wounds[i], i); head)
                workshop_->fit(scene.wounds[i], head, name);
            else
                workshop_->begin(scene.wounds[i], name);
    } catch (const cicatrix::InputError&) {
        return; // tried again by update()
    }
}

Stage::Set Stage::make(const Scene& scene) const
{
    check(scene);
    Set set;
    set.scene = scene;
    set.complete = true;
    if (std::shared_ptr<const LoadedHead> head = workshop_->head(scene.head, set_.head)) {
        set.bare = head == set_.head
                       ? set_.bare
                       : std::make_shared<const passes::Head>(passes::upload_head(*device_, *head->model));
        set.head = std::move(head);
        set.placed = scene.wounds;
    } else {
        set.head = set_.head;
        set.bare = set_.bare;
        set.placed = set_.placed; // the new ones may be for the new head
        set.complete = false;
    }
    set.tissue = set_.wounded && scene.tissue == set_.scene.tissue ? set_.tissue
                                                                   : healing_tissue_or_file(scene.tissue);
    set.notes = notes_on(scene, *set.head, set.tissue);
    set.lights = make_lights(scene, set.head->face);
    place_wounds(set);
    if (set.bare == set_.bare && set.anchors == set_.anchors && set_.wounded)
        set.wounded = set_.wounded;
    else
        set.wounded = std::make_shared<const passes::Head>(
            passes::with_wounds(*device_, *set.bare, *set.head->model, set.anchors));
    return set;
}

void Stage::place_wounds(Set& set) const
{
    for (std::size_t i = 0; i < set.placed.size(); ++i) {
        const WoundScene& wound = set.placed[i];
        const std::string name = name_of(wound, i);
        std::shared_ptr<Fit> fit = workshop_->fit(wound, set.head, name, !dragging_);
        const bool exact = fit != nullptr;
        if (!exact) {
            set.complete = false;
            fit = workshop_->similar(wound, set.head->face);
        }
        if (!fit && i < set_.fits.size() && set.placed.size() == set_.placed.size())
            fit = set_.fits[i]; // the old photograph until the new one is ready
        set.fits.push_back(fit);
        if (!fit)
            continue;
        check_count(set.wounds.size() + fit->wounds.size(), fit->wounds.size(), name);
        place_wound(set, i, *fit, name, exact);
        if (exact &&
            !std::ranges::all_of(fit->wounds, [](const auto& w) { return w.prepared.patch.shows_skin; }))
            set.notes.push_back(name +
                                ": shows no healthy skin beside the wound; the face's own is taken for it");
    }
}

/// `exact`: the fit is for this wound as it is; otherwise it stands in for one that is being made.
void Stage::place_wound(Set& set, std::size_t index, Fit& fit, const std::string& name, bool exact) const
{
    const WoundScene& wound = set.placed[index];
    const std::vector<passes::Anchor> anchors =
        exact ? std::vector<passes::Anchor>{} : anchors_of(wound, fit, *set.head, name);
    const passes::LutTissue lut = lut_of(set, wound.healing);
    for (std::size_t i = 0; i < fit.wounds.size(); ++i) {
        if (fit.maps.size() <= i)
            fit.maps.push_back(passes::upload_wound(*device_, fit.wounds[i].prepared.patch));
        passes::WoundMaps maps = fit.maps[i];
        if (wound.healing == fit.scene.healing)
            maps.region = fit.wounds[i].region; // else all of the patch
        set.scene_wounds.push_back(index);
        set.anchors.push_back(exact ? fit.wounds[i].anchor : anchors[i]);
        set.prepared.push_back(fit.wounds[i].prepared);
        set.wounds.push_back({set.anchors.back(), std::move(maps), lut});
    }
}

/// Kept from the set before as long as tissue and curve stand.
passes::LutTissue Stage::lut_of(const Set& set, const wound::Healing& healing) const
{
    if (!set_.wounds.empty() && set.scene.tissue == set_.scene.tissue &&
        set.scene.reflectance_model == set_.scene.reflectance_model &&
        last_day(set.scene) == last_day(set_.scene))
        for (std::size_t i = 0; i < set_.wounds.size(); ++i)
            if (set_.placed[set_.scene_wounds[i]].healing == healing)
                return set_.wounds[i].tissue;
    return make_lut(set, healing);
}

passes::LutTissue Stage::make_lut(const Set& set, const wound::Healing& healing) const
{
    const passes::LutRows rows = passes::lut_rows(set.tissue, healing, passes::lut_size, last_day(set.scene));
    passes::LutTissue tissue = passes::lut_tissue(rows.days, last_day(set.scene));
    if (set.scene.reflectance_model > wound::Rung::Calibrated) // the shader does not know it
        tissue.table = std::make_shared<engine::Texture>(passes::upload_reflectance_table(
            *device_, kept_table(rows, passes::lut_size, set.scene.reflectance_model, scene_rung_options),
            "reflectance table"));
    return tissue;
}

void Stage::set_tissue(const wound::HealingTissue& tissue)
{
    set_.tissue = tissue;
    for (std::size_t i = 0; i < set_.wounds.size(); ++i)
        set_.wounds[i].tissue = make_lut(set_, set_.placed[set_.scene_wounds[i]].healing);
}

cv::Mat1f Stage::surface_mm2(std::size_t wound) const
{
    const passes::WoundMaps& maps = set_.wounds.at(wound).maps;
    const cv::Mat1f all = passes::surface_under(head(), set_.head->skin, set_.anchors[wound], maps.size);
    return maps.region.empty() ? all : all(maps.region).clone();
}

std::vector<wound::WoundDay> Stage::wounds_on(double day) const
{
    std::vector<wound::WoundDay> wounds;
    for (std::size_t i = 0; i < set_.prepared.size(); ++i)
        wounds.push_back(wound::wound_at(set_.prepared[i], set_.placed[set_.scene_wounds[i]].healing, day));
    return wounds;
}

const std::vector<wound::WoundDay>& Stage::today(double day)
{
    today_.resize(set_.prepared.size());
    wounds_today_.resize(set_.prepared.size());
    for (std::size_t i = 0; i < set_.prepared.size(); ++i) {
        Today asked{day, set_.placed[set_.scene_wounds[i]].healing, set_.prepared[i].border};
        if (today_[i] == asked)
            continue;
        wounds_today_[i] = wound::wound_at(set_.prepared[i], asked.healing, day);
        today_[i] = std::move(asked);
    }
    return wounds_today_;
}

double Stage::distance(const CameraScene& from) const
{
    const double half_height = 0.98 * set_.head->face.unit_m; // from the neck to the crown
    return from.distance_m > 0 ? from.distance_m : half_height / std::tan(glm::radians(from.fov_deg) / 2);
}

passes::Camera Stage::camera(const CameraScene& from) const
{
    const glm::dvec3 target =
        face_middle(set_.head->face) + glm::dvec3(from.target_m[0], from.target_m[1], from.target_m[2]);
    return {target + distance(from) * unit_towards(from.from), target, from.fov_deg};
}

std::optional<glm::dvec3> Stage::pick(const passes::Camera& camera, double x, double y, double aspect) const
{
    const std::optional<passes::SurfacePoint> seen =
        passes::first_on_ray(*set_.head->model, camera.eye, passes::sight_through(camera, x, y, aspect));
    if (!seen || seen->material != set_.head->skin)
        return std::nullopt;
    return seen->at;
}

std::optional<std::size_t> Stage::wound_near(const glm::dvec3& point, double tolerance_m) const
{
    std::optional<std::size_t> found;
    double nearest = 1;
    for (std::size_t i = 0; i < set_.anchors.size(); ++i) {
        const passes::Anchor& anchor = set_.anchors[i];
        const glm::dvec3 from = (point - anchor.centre) / anchor.half_width_m;
        const double height = glm::dot(from, anchor.normal);
        if (std::abs(height) > passes::Anchor::reach)
            continue;
        const cv::Point2f at(float(glm::dot(from, anchor.right)), float(glm::dot(from, anchor.down)));
        std::vector<cv::Point2f> border(set_.prepared[i].border.begin(), set_.prepared[i].border.end());
        const double inside = cv::pointPolygonTest(border, at, true); // > 0 in it
        const double distance = std::hypot(at.x, at.y);
        if (inside * anchor.half_width_m >= -tolerance_m && (!found || distance < nearest)) {
            found = set_.scene_wounds[i];
            nearest = distance;
        }
    }
    return found;
}

glm::dvec3 Stage::head_middle() const
{
    return face_middle(set_.head->face) - glm::dvec3(0, 0, 0.3 * set_.head->face.unit_m);
}

shared::View Stage::view(const passes::Camera& camera, const passes::Canvas& canvas) const
{
    return passes::make_view(camera, *set_.wounded, canvas);
}

passes::Camera Stage::close_up(std::size_t wound) const
{
    if (wound >= set_.anchors.size())
        return camera();
    const passes::Anchor& anchor = set_.anchors[wound];
    // From a little above the surface's normal towards the front, so that the hollow can be seen as one.
    const glm::dvec3 towards = glm::normalize(anchor.normal + 0.35 * unit_towards(set_.scene.camera.from));
    constexpr double fov_deg = 12;
    const double distance = 0.95 * anchor.half_width_m / std::tan(glm::radians(fov_deg) / 2);
    return {anchor.centre + distance * towards, anchor.centre, fov_deg};
}

passes::FrameImages Stage::declare(engine::Graph& graph, const std::vector<wound::WoundDay>& today,
                                   const passes::Camera& camera, const passes::Shading& shading,
                                   const passes::Canvas& canvas) const
{
    passes::FrameInput input{*set_.wounded, set_.wounds, today, set_.lights, camera, shading};
    input.canvas = canvas;
    return declare(graph, input);
}

passes::FrameImages Stage::declare(engine::Graph& graph, double day, const passes::Canvas& canvas)
{
    passes::FrameInput input{*set_.wounded, set_.wounds, today(day),
                             set_.lights,   camera(),    set_.scene.shading};
    input.canvas = canvas;
    input.every_frame = false;
    return declare(graph, input);
}

passes::FrameImages Stage::declare(engine::Graph& graph, const passes::FrameInput& input) const
{
    passes::FrameInput frame = input;
    frame.reflectance = set_.scene.reflectance_model;
    frame.samples = set_.scene.samples;
    frame.exposure = float(set_.scene.exposure_stops);
    graph.keep(set_.wounded);
    for (const passes::SceneWound& wound : set_.wounds) {
        graph.keep(wound.maps.color);
        graph.keep(wound.maps.shape);
    }
    return passes::add_frame(graph, frame);
}

engine::ImageId declare_split(engine::Graph& graph, Stage& left, double left_day, Stage& right,
                              double right_day, const passes::Canvas& canvas, double divider)
{
    const engine::ImageId first = left.declare(graph, left_day, canvas).picture;
    graph.prefix("right ");
    const engine::ImageId second = right.declare(graph, right_day, canvas).picture;
    graph.prefix("");
    return passes::add_split(graph, first, second, divider);
}

} // namespace app
