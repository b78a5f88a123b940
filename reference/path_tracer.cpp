#include "reference/path_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "head/vectors.hpp"
#include "reference/directions.hpp"
#include "wound/optics/specular.hpp"
#include "wound/optics/surroundings.hpp"

namespace reference {
namespace {

const base::Color black(0, 0, 0);

double largest(const base::Color& color)
{
    return std::max({color[0], color[1], color[2]});
}

/// Without what the scene leaves out.
Levels drawn(Levels levels, const optics::Shading& shading)
{
    if (!shading.bounce)
        levels.bounces = 0;
    return levels;
}

} // namespace

PathTracer::PathTracer(const scene::LoadedScene& scene, const Surfaces& surfaces, const DayWounds& wounds,
                       const Levels& levels)
    : scene_(scene), shading_(scene.scene.shading), surfaces_(surfaces), wounds_(wounds),
      levels_(drawn(levels, shading_)), ambient_(levels.ambient ? shading_.ambient : black)
{
}

Radiance PathTracer::along(const glm::dvec3& origin, const glm::dvec3& direction, Random& random,
                           const SkinLight& skin_light) const
{
    const glm::dvec3 unit = glm::normalize(direction), to_viewer = -unit;
    double from = 0;
    while (const std::optional<head::Hit> hit = surfaces_.seen(origin, unit, from)) {
        const SurfacePoint point = surfaces_.point(*hit);
        if (point.look->blended && random() >= point.alpha) { // seen through
            from = hit->distance + 1e-7;
            continue;
        }
        const glm::dvec3 normal = bent_to_viewer(point.normal, to_viewer);
        Radiance radiance{black, black, 1};
        if (shading_.lambert)
            radiance.diffuse = skin_light && point.look->surface == head::Surface::Skin
                                   ? skin_light(point, normal, random)
                                   : reflected(point, normal, 0, random);
        if (shading_.ward && levels_.specular)
            radiance.specular = specular(point, normal, to_viewer, random);
        return radiance;
    }
    return {};
}

double PathTracer::visible(const optics::Light& light, const optics::LightSample& sample,
                           const SurfacePoint& point) const
{
    return !levels_.shadows || !shading_.shadow || surfaces_.reached_by(light, sample, point) ? 1 : 0;
}

base::Color PathTracer::openness(const SurfacePoint& point) const
{
    return optics::visibility(point.skin.skin.occlusion, shading_.rho_d * point.skin.skin.albedo);
}

base::Color PathTracer::direct(const SurfacePoint& point, const glm::dvec3& normal) const
{
    base::Color sum = black;
    for (const optics::Light& light : scene_.lights) {
        const optics::LightSample sample = optics::sample_light(light, head::to_cv(point.at));
        const double cosine = glm::dot(normal, head::to_glm(sample.direction));
        if (cosine > 0 && largest(sample.strength) > 0)
            sum += cosine * visible(light, sample, point) * sample.strength;
    }
    return sum;
}

base::Color PathTracer::reflected(const SurfacePoint& point, const glm::dvec3& normal, int bounce,
                                  Random& random) const
{
    const base::Color albedo = shading_.rho_d * point.skin.skin.albedo;
    if (!levels_.subsurface || point.look->surface != head::Surface::Skin)
        return albedo.mul(received(point, normal, albedo, bounce, random));
    const Medium medium = wounds_.medium(point.skin, albedo);
    const std::uint64_t key = random.bits();
    const WalkEnds ends = random_walk(medium, surfaces_, point.at, point.flat, key);
    return bounce == 0 ? by_channel(ends, random) + flat_correction(point, normal, medium, albedo, key)
                       : by_one_exit(ends, bounce, random);
}

base::Color PathTracer::flat_correction(const SurfacePoint& point, const glm::dvec3& normal,
                                        const Medium& medium, const base::Color& albedo,
                                        std::uint64_t key) const
{
    const WalkEnds flat = random_walk(medium, HalfSpace(point.at, point.flat), point.at, point.flat, key);
    base::Color known = albedo;
    for (double& channel : known.val)
        channel = std::min(channel, AlbedoTable::largest_diffuse);
    return (known - flat.reflected).mul(open_light(point, normal));
}

base::Color PathTracer::open_light(const SurfacePoint& point, const glm::dvec3& normal) const
{
    return direct(point, normal) + openness(point).mul(ambient_);
}

base::Color PathTracer::by_channel(const WalkEnds& ends, Random& random) const
{
    base::Color sum = black;
    std::array<bool, 3> done{};
    for (std::size_t c = 0; c < 3; ++c) {
        if (done[c] || ends.reflected[int(c)] <= 0)
            continue;
        base::Color weight = black; // of the channels that drew this exit
        for (std::size_t k = c; k < 3; ++k)
            if (!done[k] && ends.reflected[int(k)] > 0 && ends.exits[k].at == ends.exits[c].at) {
                done[k] = true;
                weight[int(k)] = ends.reflected[int(k)];
            }
        const SurfacePoint exit = surfaces_.point(ends.exits[c].surface);
        sum += weight.mul(received(exit, exit.normal, weight, 0, random));
    }
    return sum;
}

base::Color PathTracer::by_one_exit(const WalkEnds& ends, int bounce, Random& random) const
{
    const double all = ends.reflected[0] + ends.reflected[1] + ends.reflected[2];
    if (all <= 0)
        return black;
    const double which = random() * all;
    const std::size_t channel = which < ends.reflected[0]                       ? 0
                                : which < ends.reflected[0] + ends.reflected[1] ? 1
                                                                                : 2;
    const WalkExit& drawn = ends.exits[channel];
    // An exit is drawn with the probability (w0 + w1 + w2) / all, w its weights.
    const base::Color weight = drawn.weight * (all / (drawn.weight[0] + drawn.weight[1] + drawn.weight[2]));
    const SurfacePoint exit = surfaces_.point(drawn.surface);
    return weight.mul(received(exit, exit.normal, weight, bounce, random));
}

base::Color PathTracer::received(const SurfacePoint& point, const glm::dvec3& normal,
                                 const base::Color& importance, int bounce, Random& random) const
{
    return direct(point, normal) + indirect(point, normal, importance, bounce, random);
}

base::Color PathTracer::indirect(const SurfacePoint& point, const glm::dvec3& normal,
                                 const base::Color& importance, int bounce, Random& random) const
{
    const bool last = bounce >= levels_.bounces;
    const base::Color open = openness(point);
    if (last && ambient_ == black)
        return black;
    const glm::dvec3 towards = direction_about(normal, std::sqrt(1 - random()), random());
    const std::optional<head::Hit> hit = surfaces_.met(point.lifted, towards);
    if (!hit)
        return open.mul(ambient_);
    if (last || !(hit->front || surfaces_.look(*hit).double_sided))
        return black;                                                       // the inside of a bust is black
    const double chance = std::min(1.0, 4 * largest(open.mul(importance))); // Russian roulette
    if (random() >= chance)
        return black;
    const SurfacePoint next = surfaces_.point(*hit);
    return (1 / chance) * open.mul(reflected(next, next.normal, bounce + 1, random));
}

base::Color PathTracer::specular(const SurfacePoint& point, const glm::dvec3& normal,
                                 const glm::dvec3& to_viewer, Random& random) const
{
    const double open = optics::only_ward(shading_) ? 1 : point.skin.skin.occlusion; // of a wound's hollow
    optics::Shading gloss = wound::with_gloss(shading_, point.skin.skin);
    gloss.rho_s *= point.look->gloss.specular;
    gloss.alpha_x *= point.look->gloss.slope;
    gloss.alpha_y *= point.look->gloss.slope;
    base::Color sum = black;
    if (gloss.rho_s <= 0)
        return sum;
    const optics::Finish finish = wound::finish_of(point.skin.skin);
    const glm::dmat3 frame = tangent_frame(normal, point.tangent);
    const glm::dvec3 outgoing = to_viewer * frame;
    for (const optics::Light& light : scene_.lights) {
        const optics::LightSample sample = optics::sample_light(light, head::to_cv(point.at));
        const glm::dvec3 incident = head::to_glm(sample.direction) * frame;
        const double lobes =
            optics::specular(gloss, finish, head::to_cv(incident), head::to_cv(outgoing)) * open;
        if (lobes > 0 && largest(sample.strength) > 0)
            sum += lobes * incident.z * visible(light, sample, point) * sample.strength;
    }
    if (gloss.specular_model == optics::SpecularModel::Ward)
        return sum;
    const double lobe = random(), u = 1 - random(), v = random();
    const optics::MirrorRay ray = optics::mirror_ray(gloss, finish, head::to_cv(outgoing), lobe, u, v);
    return ray.weight > 0
               ? sum + mirrored(point, frame * head::to_glm(ray.direction), open * ray.weight, random)
               : sum;
}

base::Color PathTracer::mirrored(const SurfacePoint& point, const glm::dvec3& towards, double weight,
                                 Random& random) const
{
    const std::optional<head::Hit> hit = surfaces_.met(point.lifted, towards);
    if (!hit)
        return weight * ambient_;
    const double chance = std::min(1.0, 4 * weight); // Russian roulette
    if (levels_.bounces == 0 || !(hit->front || surfaces_.look(*hit).double_sided) || random() >= chance)
        return black;
    const SurfacePoint next = surfaces_.point(*hit);
    return weight / chance * reflected(next, next.normal, 1, random);
}

} // namespace reference
