#include "apps/demo/edit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/command_line.hpp"
#include "wound/prepare.hpp"

namespace demo_command {
namespace {

/// Radius of a wound's outline, m.
double radius_of(const head::Anchor& anchor)
{
    return anchor.half_width_m * wound::wound_share;
}

constexpr double handle_distance = 1.45; // of the roll handle from the centre, in outline radii

} // namespace

Sight::Sight(const shared::View& view)
    : clip_from_world_(view.clip_from_world), world_from_clip_(glm::inverse(clip_from_world_)), eye_(view.eye)
{
}

std::optional<glm::dvec2> Sight::project(const glm::dvec3& point) const
{
    const glm::dvec4 clip = clip_from_world_ * glm::dvec4(point, 1);
    if (clip.w <= 0)
        return std::nullopt;
    return glm::dvec2(clip.x / clip.w, clip.y / clip.w) * .5 + .5;
}

std::optional<glm::dvec3> Sight::on_plane(const glm::dvec2& at, const glm::dvec3& centre,
                                          const glm::dvec3& normal) const
{
    const glm::dvec4 far = world_from_clip_ * glm::dvec4(at * 2.0 - 1.0, 1, 1);
    const glm::dvec3 ray = glm::dvec3(far) / far.w - eye_;
    const double towards = glm::dot(ray, normal);
    if (std::abs(towards) < 1e-9 * glm::length(ray))
        return std::nullopt;
    const double t = glm::dot(centre - eye_, normal) / towards;
    if (t <= 0)
        return std::nullopt;
    return eye_ + t * ray;
}

std::optional<WoundOutline> outline_of(const head::Anchor& anchor, const Sight& sight)
{
    WoundOutline outline;
    const double radius = radius_of(anchor);
    const auto place = [&](double right, double up, glm::dvec2& to) {
        const auto at = sight.project(anchor.centre + radius * (right * anchor.right - up * anchor.down));
        to = at.value_or(glm::dvec2(0));
        return at.has_value();
    };
    bool all = place(0, 0, outline.centre) && place(1, 0, outline.width_handle) &&
               place(0, handle_distance, outline.roll_handle);
    constexpr int corners = 40;
    for (int i = 0; i < corners && all; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        all = place(std::cos(angle), std::sin(angle), outline.ring.emplace_back());
    }
    if (!all)
        return std::nullopt;
    outline.facing = glm::dot(sight.eye() - anchor.centre, anchor.normal) > 0;
    return outline;
}

bool inside(const WoundOutline& outline, const glm::dvec2& at)
{
    bool result = false; // even-odd rule
    for (std::size_t i = 0, j = outline.ring.size() - 1; i < outline.ring.size(); j = i++) {
        const glm::dvec2 &a = outline.ring[i], &b = outline.ring[j];
        if ((a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x)
            result = !result;
    }
    return result && outline.facing;
}

double dragged_width_mm(const head::Anchor& anchor, const Sight& sight, const glm::dvec2& pointer,
                        double width_mm)
{
    const auto at = sight.on_plane(pointer, anchor.centre, anchor.normal);
    return at ? std::clamp(2e3 * glm::length(*at - anchor.centre), 2.0, 200.0) : width_mm;
}

double dragged_roll_deg(const head::Anchor& anchor, const Sight& sight, const glm::dvec2& pointer,
                        double roll_deg)
{
    const auto at = sight.on_plane(pointer, anchor.centre, anchor.normal);
    if (!at || glm::length(*at - anchor.centre) < 1e-4)
        return roll_deg;
    const glm::dvec3 arm = *at - anchor.centre;
    const double clockwise = std::atan2(glm::dot(arm, anchor.right), -glm::dot(arm, anchor.down));
    return std::remainder(roll_deg - glm::degrees(clockwise), 360.0);
}

void turn(scene::Direction& from, double right_deg, double up_deg)
{
    from.azimuth_deg = std::remainder(from.azimuth_deg + right_deg, 360.0);
    from.elevation_deg = std::clamp(from.elevation_deg + up_deg, -89.0, 89.0);
}

bool is_published(const scene::Scene& scene)
{
    scene::Scene published = scene;
    scene::make_published(published);
    return published == scene;
}

void set_published(scene::Scene& scene, bool published, const scene::Scene& mended)
{
    if (published) {
        scene::make_published(scene);
        return;
    }
    scene.shading = mended.shading;
    scene.reflectance_model = mended.reflectance_model;
    scene.tissue = mended.tissue;
    for (std::size_t i = 0; i < scene.wounds.size(); ++i)
        scene.wounds[i].healing.model =
            i < mended.wounds.size() ? mended.wounds[i].healing.model : scene::Wound{}.healing.model;
    std::vector<scene::Light> lights = mended.lights;
    if (!lights.empty() && !scene.lights.empty()) // the user may have moved the key light since
        lights.front().from = scene.lights.front().from;
    scene.lights = lights;
}

scene::Wound next_wound(const scene::Scene& scene)
{
    scene::Wound wound;
    while (std::ranges::any_of(scene.wounds, [&](const scene::Wound& other) {
        return other.photo.empty() && other.seed == wound.seed;
    }))
        ++wound.seed;
    wound.width_mm = 24;
    wound.healing = scene::usual_healing(wound);
    if (!scene.wounds.empty())
        wound.healing.model = scene.wounds.front().healing.model;
    return wound;
}

} // namespace demo_command
