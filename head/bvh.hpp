// Ray queries against a bounding volume hierarchy of a head's triangles. Embree finds the candidate
// triangles; this code intersects each of them in double precision. So a hit depends only on the ray and the
// triangle, not on the hierarchy, the processor or the number of threads, and rays do not pass between
// neighbouring triangles.
//
// A Bvh copies the corners. Queries do not allocate memory and may run in several threads at once.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

#include "head/model.hpp"

namespace head {

/// The sides of a triangle that a ray can hit; the corners are counter-clockwise seen from the front.
enum class Facing : std::uint8_t
{
    Front,
    Both
};

/// The intersection of a ray and a triangle.
struct Hit
{
    std::uint32_t triangle = 0;  // position of its first index in the index list
    std::uint32_t primitive = 0; // of the model; 0 in a plain mesh
    std::uint32_t material = 0;  // of the model; 0 in a plain mesh
    bool front = true;           // whether the front side was hit
    double distance = 0;         // in units of the direction's length
    double u = 0, v = 0;         // barycentric: the point is (1-u-v) a + u b + v c
};

/// Decides for each hit whether it counts; the ray continues behind a rejected hit. Refers to a callable
/// `bool(const Hit&)` that must outlive the query and must not throw. A query calls it at most once per
/// triangle, in no particular order, also for some triangles behind the nearest hit.
class HitFilter
{
  public:
    HitFilter() = default; // accepts every hit
    template <typename Accept>
    HitFilter(const Accept& accept)
        : accept_(&accept),
          call_([](const void* f, const Hit& hit) { return bool((*static_cast<const Accept*>(f))(hit)); })
    {
    }
    bool operator()(const Hit& hit) const { return !call_ || call_(accept_, hit); }

  private:
    const void* accept_ = nullptr;
    bool (*call_)(const void*, const Hit&) = nullptr;
};

class Bvh
{
  public:
    enum class Triangles : std::uint8_t
    {
        Solid, // without hair and lashes: materials with AlphaMode::Blend
        All
    };
    explicit Bvh(const Model& model, Triangles which = Triangles::Solid);
    /// `indices`: three per triangle.
    Bvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    ~Bvh();
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;

    /// The nearest hit at a distance of tmin to tmax, which may be infinite. `direction` may have any length;
    /// distances are in units of this length. Of equally near triangles the first in the mesh is hit.
    /// Zero-area and non-finite triangles are never hit; a non-finite ray hits nothing.
    std::optional<Hit> nearest(const glm::dvec3& origin, const glm::dvec3& direction, double tmin,
                               double tmax, Facing facing = Facing::Both, HitFilter accept = {}) const;

    /// Whether the ray hits any triangle, from either side, at a distance of 0 to `reach`.
    bool any(const glm::dvec3& origin, const glm::dvec3& direction, double reach,
             HitFilter accept = {}) const;

  private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace head
