// Light along one camera ray: the scene's lights, surroundings and materials as the rasteriser has them, with
// everything that it approximates done by tracing rays.
//
//   diffuse   C rho_d (direct light + surroundings + light from other skin), of the point itself or, with
//             subsurface scattering, of where a random walk from it leaves the skin. C rho_d is the diffuse
//             albedo for all light: the surroundings' too.
//   specular  the scene's lobes, of every light that reaches the point; with SpecularModel::Skin also of the
//             surroundings and of the diffuse light of other skin
//
// Units as optics::Light has them: a light's strength is the radiance of a white diffuser that faces it, so
// that direct light is the sum of strength x cosine, without pi.
#pragma once
#include <functional>

#include "reference/levels.hpp"
#include "reference/surface.hpp"

namespace reference {

/// Linear radiance, premultiplied.
struct Radiance
{
    base::Color diffuse{0, 0, 0}, specular{0, 0, 0};
    double alpha = 0; // 1 where the ray meets the head
};

class PathTracer
{
  public:
    /// Keeps references to all of them.
    PathTracer(const scene::LoadedScene& scene, const Surfaces& surfaces, const DayWounds& wounds,
               const Levels& levels);

    /// What leaves a point of skin diffusely, by another method than the tracer's own.
    using SkinLight = std::function<base::Color(const SurfacePoint&, const glm::dvec3& normal, Random&)>;
    /// `direction` may have any length.
    Radiance along(const glm::dvec3& origin, const glm::dvec3& direction, Random& random,
                   const SkinLight& skin_light = {}) const;

    /// Light of the lights that falls on a point, as the radiance of a white diffuser there.
    base::Color direct(const SurfacePoint& point, const glm::dvec3& normal) const;
    /// The light that would fall there if nothing of the head stood in the surroundings' way but a wound's
    /// hollow.
    base::Color open_light(const SurfacePoint& point, const glm::dvec3& normal) const;
    /// All light but the lights' that falls there: received() without direct().
    base::Color indirect(const SurfacePoint& point, const glm::dvec3& normal, const base::Color& importance,
                         int bounce, Random& random) const;
    /// What leaves the skin through a walk's exits, one of each channel.
    base::Color by_channel(const WalkEnds& ends, Random& random) const;

  private:
    /// Light that falls on a point, from lights, surroundings and other skin. `importance`: its weight in
    /// what is seen, for Russian roulette. `bounce`: how often it has gone from skin to skin.
    base::Color received(const SurfacePoint& point, const glm::dvec3& normal, const base::Color& importance,
                         int bounce, Random& random) const;
    /// Light that leaves a point diffusely.
    base::Color reflected(const SurfacePoint& point, const glm::dvec3& normal, int bounce,
                          Random& random) const;
    /// The same through one of a walk's exits, which stands for all of them.
    base::Color by_one_exit(const WalkEnds& ends, int bounce, Random& random) const;
    /// A control variate: zero on average, and where the skin is flat and evenly lit it takes away all noise
    /// of the walk with this key. The same walk in a half space reflects nearly as much, and what a half
    /// space reflects on average is known: `albedo`.
    base::Color flat_correction(const SurfacePoint& point, const glm::dvec3& normal, const Medium& medium,
                                const base::Color& albedo, std::uint64_t key) const;
    base::Color specular(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& to_viewer,
                         Random& random) const;
    /// `weight` times the diffuse light that comes from `towards`.
    base::Color mirrored(const SurfacePoint& point, const glm::dvec3& towards, double weight,
                         Random& random) const;
    /// What a wound's hollow, which is in no triangle, lets in of the light from all around.
    base::Color openness(const SurfacePoint& point) const;
    /// 1 or 0.
    double visible(const optics::Light& light, const optics::LightSample& sample,
                   const SurfacePoint& point) const;

    const scene::LoadedScene& scene_;
    const optics::Shading& shading_;
    const Surfaces& surfaces_;
    const DayWounds& wounds_;
    const Levels levels_;
    const base::Color ambient_;
};

} // namespace reference
