// Subsurface scattering by random walk: light enters a body through its surface, scatters in the homogeneous
// medium that fills it, and leaves somewhere else. One walk carries all three channels.
//
// The surface is diffuse to whoever looks at it from outside: light enters it from all directions as it falls
// on a Lambertian surface, and where it leaves it is gathered and sent out like that. So the body's diffuse
// albedo is one number per channel for all light, from anywhere (single_albedo.hpp tells which medium has
// it), and the walk adds where the light comes out. A specular lobe on the surface is the caller's.
#pragma once
#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "base/color.hpp"
#include "reference/random.hpp"

namespace reference {

struct Medium
{
    base::Color extinction;    // sigma_t per metre, > 0
    base::Color single_albedo; // of one scattering event, 0..1
    double g = 0;              // Henyey-Greenstein anisotropy, -.99...99
    double n = 1;              // refractive index; 1: matched to the air, the surface reflects nothing
};

/// Where a ray meets the body's surface.
struct SurfaceHit
{
    double distance = 0;          // metres
    glm::dvec3 normal{0, 0, 1};   // unit, geometric, out of the body
    std::uint32_t triangle = 0;   // and where on it, for whoever put triangles there
    glm::dvec2 barycentric{0, 0}; // weights of the second and third corner
};

/// A body in which to walk: something closed.
class Body
{
  public:
    virtual ~Body() = default;
    /// The first surface that a ray meets within `reach` metres, from either side. `origin` may lie on the
    /// surface, which then is not met there.
    virtual std::optional<SurfaceHit> first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                                   double reach) const = 0;
};

/// The body below a plane.
class HalfSpace : public Body
{
  public:
    HalfSpace(const glm::dvec3& point, const glm::dvec3& outward) : point_(point), outward_(outward) {}
    std::optional<SurfaceHit> first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                           double reach) const override;

  private:
    glm::dvec3 point_, outward_;
};

/// A place where light leaves the body.
struct WalkExit
{
    glm::dvec3 at{0.0}; // on the surface, metres
    SurfaceHit surface;
    base::Color weight{0, 0, 0}; // share of the light that entered which comes out here
};

/// What a walk finds. At each step the part of the light that reaches the surface leaves, and the rest
/// scatters on before it, so that the reflected light varies little from walk to walk.
struct WalkEnds
{
    base::Color reflected{0, 0, 0}; // sum of the weights of all exits; its mean is the diffuse albedo
    /// One exit for each channel, drawn from all with a probability proportional to its weight in that
    /// channel by one random number for the three: often the same exit. Undefined for a channel without
    /// reflected light.
    std::array<WalkExit, 3> exits;
    /// Where the walk was stopped inside the body, and the light that it still carried; no weight: it was
    /// not.
    glm::dvec3 stopped_at{0.0};
    base::Color stopped{0, 0, 0};
};
/// Whether a walk stops at a place inside the body, where it scatters.
using StopsAt = std::function<bool(const glm::dvec3&)>;

/// A walk from a point of the surface, with the body's outward normal there. Each step has random numbers of
/// its own, made from `key`, so that walks with the same key in similar bodies stay similar.
WalkEnds random_walk(const Medium& medium, const Body& body, const glm::dvec3& from, const glm::dvec3& normal,
                     std::uint64_t key, const StopsAt& stops_at = {});

} // namespace reference
