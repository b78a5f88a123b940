#include "reference/rival.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "wound/optics/tissue_choice.hpp"

namespace reference {
namespace {

constexpr unsigned light_rays = 4;      // of a sample, for light that does not come straight from a light
constexpr double solid_angle = .08;     // of a voxel that counts as one sample
constexpr double blur_in_spacings = .6; // of a layered profile: the samples' pattern does not show
constexpr double farthest = 9;          // in 1 / sigma_tr: a thousandth of a dipole's light goes farther
constexpr int walks_per_ray = 4;        // of li
constexpr std::uint64_t rival_seed = 0x21;

/// The dipole of a source so deep in the medium, metres.
optics::DipoleSources core_sources(const Medium& medium, int channel, double depth)
{
    const double albedo = medium.single_albedo[channel], extinction = medium.extinction[channel];
    const double scattering = extinction * albedo * (1 - medium.g), absorption = extinction * (1 - albedo);
    const optics::DiffusiveMedium core{scattering / (scattering + absorption), scattering + absorption,
                                       optics::boundary_factor(medium.n)};
    return {core.transport(), depth, depth + 2 * core.outside()};
}

/// Whether the scenes differ in nothing but lights, cameras and what the rasteriser alone looks at.
bool same_but_for_lights(scene::Scene a, const scene::Scene& b)
{
    a.lights = b.lights;
    a.camera = b.camera;
    a.views = b.views;
    a.size = b.size;
    a.samples = b.samples;
    a.exposure_stops = b.exposure_stops;
    a.shading.transport = b.shading.transport;
    return a == b;
}

Levels without_walks()
{
    Levels levels;
    levels.subsurface = false;
    return levels;
}

double largest_path_m(const Medium& medium)
{
    return 1 / std::min({medium.extinction[0], medium.extinction[1], medium.extinction[2]});
}

} // namespace

/// All that holds for a day; its lights may change.
struct Rival::Day
{
    scene::LoadedScene scene;
    double day;
    DayWounds wounds;
    Surfaces surfaces;
    PathTracer tracer;
    std::vector<optics::LayeredProfile>
        profiles; // of donner-jensen: the face's, then of each wound bed and new skin

    Day(const scene::LoadedScene& of, double on)
        : scene(of), day(on), wounds(scene, day, MediumChoice{}), surfaces(scene, wounds),
          tracer(scene, surfaces, wounds, without_walks())
    {
    }
};

void Rival::prepare(const scene::LoadedScene& scene, double day)
{
    const bool same_head = sampled_ == scene.head->model;
    if (!day_ || !same_head || day_->day != day || !same_but_for_lights(scene.scene, day_->scene.scene)) {
        day_ = std::make_shared<Day>(scene, day);
        ++work_.days;
    } else if (day_->scene.lights != scene.lights) {
        day_->scene = scene;
    } else {
        return;
    }
    if (!same_head) {
        const base::Color paths_mm = day_->wounds.skin().mean_free_path_mm;
        light_ = std::make_shared<SurfaceLight>(
            scene, 1e-3 * std::max((paths_mm[0] + paths_mm[1] + paths_mm[2]) / 3, .05));
        sampled_ = scene.head->model;
        ++work_.trees;
    }
    if (method_ == RivalMethod::Jensen && !inversion_)
        inversion_ = std::make_shared<const optics::DipoleInversion>(MediumChoice{}.index);
    if (method_ == RivalMethod::DonnerJensen && day_->profiles.empty()) {
        const double blur_mm = 1e3 * blur_in_spacings * light_->spacing_m();
        day_->profiles.emplace_back(optics::layers_of(scene.tissue), blur_mm);
        for (std::size_t wound = 0; wound < day_->wounds.count(); ++wound)
            for (const bool bed : {true, false})
                day_->profiles.emplace_back(day_->wounds.layers_under(wound, bed), blur_mm);
    }
    light_->illuminate(day_->surfaces, day_->tracer, light_rays);
    ++work_.lights;
    shown_ = {};
}

cv::Mat4f Rival::draw(const scene::LoadedScene& scene, const head::Camera& camera, const cv::Size& size,
                      double day, int rays_per_axis)
{
    prepare(scene, day);
    if (shown_.camera == camera && shown_.size == size && shown_.rays_per_axis == rays_per_axis)
        return shown_.picture;
    const PathTracer::SkinLight skin_light = [this](const SurfacePoint& point, const glm::dvec3& normal,
                                                    Random& random) {
        return method_ == RivalMethod::Jensen         ? by_dipole(point)
               : method_ == RivalMethod::DonnerJensen ? by_layers(point)
                                                      : by_walks(point, normal, random);
    };
    cv::Mat4f picture(size);
    base::in_parallel(std::size_t(size.height), 0, [&](std::size_t y) {
        for (int x = 0; x < size.width; ++x) {
            cv::Vec4d sum(0, 0, 0, 0);
            for (int ray = 0; ray < rays_per_axis * rays_per_axis; ++ray) {
                Random random(rival_seed, y * std::size_t(size.width) + std::size_t(x), std::uint64_t(ray));
                const glm::dvec2 place((ray % rays_per_axis + .5) / rays_per_axis,
                                       (ray / rays_per_axis + .5) / rays_per_axis);
                const Radiance seen = day_->tracer.along(
                    camera.eye, head::sight_through_pixel(camera, glm::dvec2(x, y) + place, size), random,
                    skin_light);
                const base::Color light = seen.diffuse + seen.specular;
                sum += cv::Vec4d(light[0], light[1], light[2], seen.alpha);
            }
            picture(int(y), x) = sum / double(rays_per_axis * rays_per_axis);
        }
    });
    shown_ = {camera, size, rays_per_axis, picture};
    ++work_.pictures;
    return picture;
}

base::Color Rival::by_dipole(const SurfacePoint& point) const
{
    const base::Color albedo = day_->scene.scene.shading.rho_d * point.skin.skin.albedo;
    const Medium medium = day_->wounds.medium(point.skin, albedo);
    std::array<double, 3> strength;
    std::array<optics::DipoleSources, 3> sources;
    double reach = 0;
    for (int c = 0; c < 3; ++c) {
        const double length = 1 / (medium.extinction[c] * std::max(medium.single_albedo[c], .05));
        const optics::Dipole dipole = inversion_->dipole_of(albedo[c], length);
        // Wider in proportion, which changes no integral, where the samples are too far apart for it.
        const double wider = std::max(light_->spacing_m() / dipole.sources.depth, 1.);
        strength[std::size_t(c)] = dipole.strength;
        sources[std::size_t(c)] = {dipole.sources.transport / wider, dipole.sources.depth * wider,
                                   dipole.sources.image * wider};
        reach = std::max(reach, farthest * wider / dipole.sources.transport);
    }
    return light_->gathered(point.at, reach, solid_angle, [&](double r2) {
        return base::Color(strength[0] * sources[0].at_squared(r2), strength[1] * sources[1].at_squared(r2),
                           strength[2] * sources[2].at_squared(r2));
    });
}

base::Color Rival::by_layers(const SurfacePoint& point) const
{
    const base::Color albedo = day_->scene.scene.shading.rho_d * point.skin.skin.albedo;
    const double own = std::max(0.0, 1 - point.skin.bed - point.skin.covered);
    const double all = own + point.skin.bed + point.skin.covered;
    const std::array<std::pair<double, std::size_t>, 3> shares{
        {{own / all, 0},
         {point.skin.bed / all, 1 + 2 * point.skin.wound},
         {point.skin.covered / all, 2 + 2 * point.skin.wound}}};
    constexpr double mm2_per_m2 = 1e6;
    double reach_mm = 0;
    for (const auto& [share, which] : shares)
        if (share > 0)
            reach_mm = std::max(reach_mm, day_->profiles[which].reach_mm());
    const base::Color per_m2 = light_->gathered(point.at, 1e-3 * reach_mm, solid_angle, [&](double r2) {
        base::Color value(0, 0, 0);
        for (const auto& [share, which] : shares)
            if (share > 0) {
                const std::array<float, 3> at = day_->profiles[which].at_squared(mm2_per_m2 * r2);
                value += share * base::Color(double(at[0]), double(at[1]), double(at[2]));
            }
        return value;
    });
    return mm2_per_m2 * albedo.mul(per_m2);
}

base::Color Rival::by_walks(const SurfacePoint& point, const glm::dvec3& normal, Random& random) const
{
    const base::Color albedo = day_->scene.scene.shading.rho_d * point.skin.skin.albedo;
    const Medium medium = day_->wounds.medium(point.skin, albedo);
    const double core = largest_path_m(medium);
    const HalfSpace flat_body(point.at, point.flat);
    double depth = 0, flat_depth = 0; // of the places where the walks have stopped
    const StopsAt stops_at = [&](const glm::dvec3& at) {
        if (glm::distance(at, point.at) < core)
            return false;
        const std::optional<double> found = light_->depth(at, core);
        depth = found.value_or(0);
        return found.has_value();
    };
    const StopsAt stops_flat = [&](const glm::dvec3& at) {
        flat_depth = glm::dot(point.at - at, point.flat);
        return flat_depth >= core;
    };
    base::Color sum(0, 0, 0), flat_sum(0, 0, 0);
    for (int walk = 0; walk < walks_per_ray; ++walk) {
        const std::uint64_t key = random.bits();
        const WalkEnds ends = random_walk(medium, day_->surfaces, point.at, point.flat, key, stops_at);
        sum += day_->tracer.by_channel(ends, random);
        if (ends.stopped != base::Color(0, 0, 0))
            sum += from_core(medium, ends, depth);
        const WalkEnds flat = random_walk(medium, flat_body, point.at, point.flat, key, stops_flat);
        flat_sum += flat.reflected;
        if (flat.stopped != base::Color(0, 0, 0))
            for (int c = 0; c < 3; ++c)
                flat_sum[c] += flat.stopped[c] * core_sources(medium, c, flat_depth).total();
    }
    // The reference's control variate: the same walks in a half space, whose albedo is known.
    base::Color known = albedo;
    for (double& channel : known.val)
        channel = std::min(channel, AlbedoTable::largest_diffuse);
    return sum / double(walks_per_ray) +
           (known - flat_sum / double(walks_per_ray)).mul(day_->tracer.open_light(point, normal));
}

base::Color Rival::from_core(const Medium& medium, const WalkEnds& ends, double depth) const
{
    std::array<optics::DipoleSources, 3> sources;
    double reach = 0;
    for (int c = 0; c < 3; ++c) {
        sources[std::size_t(c)] = core_sources(medium, c, depth);
        reach = std::max(reach, farthest / sources[std::size_t(c)].transport + depth);
    }
    const double above2 = depth * depth;
    return ends.stopped.mul(light_->gathered(ends.stopped_at, reach, solid_angle, [&](double distance2) {
        const double r2 = std::max(distance2 - above2, 0.0); // along the surface
        return base::Color(sources[0].at_squared(r2), sources[1].at_squared(r2), sources[2].at_squared(r2));
    }));
}

std::size_t Rival::bytes() const
{
    return (light_ ? light_->bytes() : 0) + shown_.picture.total() * shown_.picture.elemSize() +
           (day_ ? day_->profiles.size() * optics::LayeredProfile::bytes() : 0);
}

} // namespace reference
