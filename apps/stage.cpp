#include "apps/stage.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "apps/bake.hpp"
#include "apps/bake_head.hpp"
#include "engine/image_io.hpp"
#include "passes/skin_under.hpp"
#include "shaders/shared/shading.h"
#include "wound/drawn_region.hpp"
#include "wound/input_error.hpp"
#include "wound/prepare.hpp"
#include "wound/skin_match.hpp"
#include "wound/synthetic.hpp"

namespace app {
namespace {

constexpr std::size_t table_rows =
    32; // as wide as high: the smallest table within .002 of direct evaluation (docs/optics.md)

glm::dvec3 face_middle(const passes::FaceFrame& face)
{
    return face.nose_tip + face.unit_m * glm::dvec3(0, 0.13, -0.45);
}
/// Crown to chin, about; the object of the paper's set-up.
double head_height(const passes::FaceFrame& face)
{
    return 1.65 * face.unit_m;
}

glm::dvec3 unit_towards(const Direction& from)
{
    const double azimuth = glm::radians(from.azimuth_deg), elevation = glm::radians(from.elevation_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

cv::Vec3d to_cv(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

wound::Light make_light(const LightScene& scene, const passes::FaceFrame& face)
{
    const glm::dvec3 towards = unit_towards(scene.from), middle = face_middle(face);
    wound::Light light;
    light.kind = scene.directional ? wound::LightKind::Directional
                 : scene.falloff   ? wound::LightKind::Point
                                   : wound::LightKind::PointWithoutFalloff;
    light.position = to_cv(middle + scene.distance_m * towards);
    light.direction = to_cv(towards);
    light.strength = cv::Vec3d(scene.color[0], scene.color[1], scene.color[2]) * scene.intensity;
    light.reference_distance_m = std::max(scene.distance_m, 1e-3);
    light.translucency_distance = wound::paper_distance(head_height(face), scene.distance_m);
    return light;
}

/// From face coordinates (unit: nose to crown) to those of the tissue map: ears at x = +-1, hairline and
/// chin at y = +-1.
cv::Point2d tissue_coordinates(const passes::FacePoint& face)
{
    return {face.x / 0.55, face.y / (face.y > 0 ? 0.65 : 0.58)};
}

wound::TissueThickness scaled(wound::TissueThickness tissue, double factor)
{
    return {tissue.epidermis * factor, tissue.dermis * factor, tissue.subcutis * factor};
}

wound::Photograph read_photograph(const WoundScene& scene)
{
    if (scene.photo.empty()) {
        wound::SyntheticWound synthetic;
        synthetic.shape = scene.kind == "laceration" ? wound::WoundShape::laceration
                          : scene.kind == "avulsion" ? wound::WoundShape::avulsion
                                                     : wound::WoundShape::abrasion;
        synthetic.seed = scene.seed;
        return wound::synthesize(synthetic);
    }
    wound::Photograph photograph{engine::read_rgb(scene.photo), {}};
    if (!scene.mask.empty())
        photograph.mask = engine::read_mask(scene.mask);
    return photograph;
}

std::string name_of(const WoundScene& wound, std::size_t index)
{
    return wound.photo.empty() ? fmt::format("wound {}", index + 1) : wound.photo.string();
}

wound::PreparedWound prepare_wound(const WoundScene& scene, const wound::WoundPart& part,
                                   const passes::FacePoint& face, const std::string& name)
{
    wound::Preparation preparation;
    preparation.where = name;
    preparation.width_mm = part.width_mm;
    preparation.hints = scene.segmentation;
    preparation.depth.tissue = scaled(wound::tissue_thickness(tissue_coordinates(face)), scene.depth_factor);
    return wound::prepare(part.photograph, preparation);
}

/// What is made of a photograph while the head is being read: its wounds and, where the place on the face is
/// known without the head, the largest one prepared.
struct EarlyWound
{
    std::shared_future<std::vector<wound::WoundPart>> parts;
    std::shared_future<wound::PreparedWound> largest; // invalid where the place is not known

    EarlyWound(const WoundScene& scene, const std::string& name)
        : parts(std::async(std::launch::async, [scene, name] {
              return wound::separate(read_photograph(scene), scene.width_mm,
                                     scene.mask.empty() ? name : scene.mask.string());
          }))
    {
        if (const auto face = passes::known_face_point(scene.place))
            largest = std::async(std::launch::async, [scene, name, face = *face, ready = parts] {
                return prepare_wound(scene, ready.get().front(), face, name);
            });
    }
};

/// Places the wounds of one photograph as they lie in it, and starts what is left to prepare of them.
void place_wound(Stage::Props& props, const WoundScene& scene, std::size_t index, const EarlyWound& early)
{
    const std::string name = name_of(scene, index);
    const passes::Anchor first =
        passes::anchor_wound(*props.head, props.face, scene.place, scene.width_mm / wound::kWoundShare,
                             scene.roll_deg, name + ": at");
    const std::size_t count = scene.mask.empty() ? 1 : early.parts.get().size(); // no need to wait for one
    if (props.wounds.size() + count > std::size_t(shared::MAX_WOUNDS))
        throw cicatrix::InputError(
            name,
            fmt::format("its mask has {} components, which makes more than {} wounds in the scene", count,
                        shared::MAX_WOUNDS),
            "leave wounds out of the scene, or components out of the mask");
    const std::uint32_t skin = passes::skin_material(*props.head);
    for (std::size_t i = 0; i < count; ++i) {
        passes::Anchor anchor = first;
        if (i > 0) {
            const wound::WoundPart& part = early.parts.get()[i];
            anchor = passes::anchor_beside(
                *props.head, props.face, first, 1e-3 * glm::dvec2(part.offset_mm.x, part.offset_mm.y),
                part.width_mm / wound::kWoundShare, fmt::format("{}: component {} of the mask", name, i + 1));
        }
        props.scene_wounds.push_back(index);
        props.anchors.push_back(anchor);
        props.wounds.push_back(std::async(std::launch::async, [=, head = props.head] {
            wound::PreparedWound prepared =
                i == 0 && early.largest.valid()
                    ? early.largest.get()
                    : prepare_wound(scene, early.parts.get()[i], anchor.face, name);
            prepared.patch = wound::match_to_skin(
                prepared.patch, passes::skin_under(*head, skin, anchor, prepared.patch.color.cols));
            return prepared;
        }));
    }
}

std::shared_ptr<const engine::Model> read_head(const Scene& scene, std::vector<std::string>& notes)
{
    const std::filesystem::path file = scene.head.empty() ? default_head_path() : scene.head;
    if (scene.head.empty() && !std::filesystem::exists(file))
        throw cicatrix::InputError(file.string(), "the default head has not been made yet",
                                   "make it once with cicatrix-fetch-head (from a checkout: ./run setup), or "
                                   "give one of your own with "
                                   "--head FILE.glb");
    auto head = std::make_shared<engine::Model>(engine::load_model(file));
    engine::normalise_size(*head);
    for (const std::string& note : head->notes)
        notes.push_back(fmt::format("{}: {}", file.string(), note));
    return head;
}

} // namespace

Stage::Props Stage::prepare(const Scene& scene)
{
    // Photographs are read and prepared while the head is being read.
    std::vector<EarlyWound> early;
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        early.emplace_back(scene.wounds[i], name_of(scene.wounds[i], i));

    Props props;
    props.head = read_head(scene, props.notes);
    props.face = passes::find_face(*props.head);
    props.tissue = healing_tissue_or_file(scene.tissue);
    if (const auto* table = std::get_if<wound::SkinLayers>(&props.tissue);
        table != nullptr && scene.reflectance_model == wound::Rung::Published)
        if (const std::size_t outside = wound::outside_domain(*table).size(); outside > 0)
            props.notes.push_back(fmt::format("eqs. (2) and (3) as printed are outside their domain in {} of "
                                              "{} layers and channels: colours of the wound are off, "
                                              "often green (docs/optics.md)",
                                              outside, table->layers.size() * table->channels()));
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        place_wound(props, scene.wounds[i], i, early[i]);
    return props;
}

Stage::Stage(const engine::Device& device, const Scene& scene, Props props)
    : scene_(scene), props_(std::move(props)),
      head_(passes::upload_head(device, *props_.head, props_.anchors))
{
    for (std::size_t i = 0; i < props_.wounds.size(); ++i) {
        prepared_.push_back(props_.wounds[i].get());
        wounds_.push_back(
            {props_.anchors[i], passes::upload_wound(device, prepared_[i].patch), table_tissue(i)});
        wounds_.back().maps.region = wound::drawn_region(prepared_[i], healing(i));
    }
    set_lights(scene_.lights);
}

void Stage::set_lights(const std::vector<LightScene>& lights)
{
    std::vector<wound::Light> made;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        made.push_back(make_light(lights[i], props_.face));
        wound::check_light(made[i], fmt::format("scene: /lights/{}", i));
        wound::check_shading(
            scene_.shading.model,
            wound::translucency_distances(made[i], to_cv(face_middle(props_.face)), head_height(props_.face)),
            "scene: /shading");
    }
    scene_.lights = lights;
    lights_ = std::move(made);
}

cv::Mat1f Stage::surface_mm2(std::size_t wound) const
{
    const passes::WoundMaps& maps = wounds_.at(wound).maps;
    return passes::surface_under(head(), passes::skin_material(head()), props_.anchors[wound],
                                 maps.size)(maps.region)
        .clone();
}

passes::LutTissue Stage::table_tissue(std::size_t wound) const
{
    const double last_day = std::max(1.0, *std::ranges::max_element(scene_.days));
    const passes::LutRows rows = passes::lut_rows(props_.tissue, healing(wound), table_rows, last_day);
    return passes::lut_tissue(rows.open, last_day);
}

void Stage::set_tissue(const wound::HealingTissue& tissue)
{
    props_.tissue = tissue;
    for (std::size_t i = 0; i < wounds_.size(); ++i)
        wounds_[i].tissue = table_tissue(i);
}

const wound::Healing& Stage::healing(std::size_t wound) const
{
    return scene_.wounds[props_.scene_wounds[wound]].healing;
}

std::vector<wound::WoundDay> Stage::wounds_on(double day) const
{
    std::vector<wound::WoundDay> today;
    for (std::size_t i = 0; i < prepared_.size(); ++i)
        today.push_back(wound::wound_at(prepared_[i], healing(i), day));
    return today;
}

passes::Camera Stage::camera(const CameraScene& from) const
{
    const double half_height = 0.98 * props_.face.unit_m; // from the neck to the crown
    const double distance =
        from.distance_m > 0 ? from.distance_m : half_height / std::tan(glm::radians(from.fov_deg) / 2);
    const glm::dvec3 target = face_middle(props_.face);
    return {target + distance * unit_towards(from.from), target, from.fov_deg};
}

glm::dvec3 Stage::head_middle() const
{
    return face_middle(props_.face) - glm::dvec3(0, 0, 0.3 * props_.face.unit_m);
}

shared::View Stage::view(const passes::Camera& camera, const passes::Canvas& canvas) const
{
    return passes::make_view(camera, head_, canvas);
}

passes::Camera Stage::close_up(std::size_t wound) const
{
    if (wound >= props_.anchors.size())
        return camera();
    const passes::Anchor& anchor = props_.anchors[wound];
    // From a little above the surface's normal towards the front, so that the hollow can be seen as one.
    const glm::dvec3 towards = glm::normalize(anchor.normal + 0.35 * unit_towards(scene_.camera.from));
    constexpr double fov_deg = 12;
    const double distance = 0.95 * anchor.half_width_m / std::tan(glm::radians(fov_deg) / 2);
    return {anchor.centre + distance * towards, anchor.centre, fov_deg};
}

passes::FrameImages Stage::declare(engine::Graph& graph, const std::vector<wound::WoundDay>& today,
                                   const passes::Camera& camera, const passes::Shading& shading,
                                   const passes::Canvas& canvas) const
{
    passes::FrameInput input{head_, wounds_, today, lights_, camera, shading};
    input.reflectance = scene_.reflectance_model;
    input.canvas = canvas;
    input.samples = scene_.samples;
    input.exposure = float(scene_.exposure_stops);
    return passes::add_frame(graph, input);
}

} // namespace app
