// The one bounding volume hierarchy of a head's triangles, and what rays meet in it. Embree finds the
// triangles that a ray may meet; each of them is intersected here, in double precision. So a hit depends on
// the ray and the triangle alone, not on the hierarchy, the processor or the number of threads, and rays do
// not slip through between neighbouring triangles.
//
// A Bvh keeps its own copy of the corners. Queries allocate nothing and may run in many threads at once.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

#include "head/model.hpp"

namespace head {

/// The sides of a triangle that a ray meets; its corners run counter-clockwise seen from the front.
enum class Facing : std::uint8_t
{
    Front,
    Both
};

/// Where a ray meets a triangle.
struct Hit
{
    std::uint32_t triangle = 0;  // index of its first index in the list of indices
    std::uint32_t primitive = 0; // of the model; 0 in a plain mesh
    std::uint32_t material = 0;  // of the model; 0 in a plain mesh
    bool front = true;           // whether its front was met
    double distance = 0;         // in lengths of the ray's direction
    double u = 0, v = 0;         // the point is (1-u-v) a + u b + v c
};

/// Says of each hit that a query comes upon whether it counts; where it does not, the ray goes on behind it.
/// Refers to a callable `bool(const Hit&)` that must outlive the query and must not throw. It is asked once
/// at most about each triangle, in no particular order, and about some that lie behind the one that is found.
class HitFilter
{
  public:
    HitFilter() = default; // every hit counts
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
        Solid, // hair and lashes left out: materials that are blended (AlphaMode::Blend)
        All
    };
    explicit Bvh(const Model& model, Triangles which = Triangles::Solid);
    /// Three indices a triangle.
    Bvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    ~Bvh();
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;

    /// The nearest hit at a distance of tmin to tmax (may be infinite). `direction` may have any length, in
    /// which distances are told. Of triangles that are equally near, the first in the mesh is found.
    /// Triangles without area and triangles that are not finite are never met; a ray that is not finite meets
    /// nothing.
    std::optional<Hit> nearest(const glm::dvec3& origin, const glm::dvec3& direction, double tmin,
                               double tmax, Facing facing = Facing::Both, HitFilter accept = {}) const;

    /// Whether anything is met at a distance of 0 to `reach`, from either side.
    bool any(const glm::dvec3& origin, const glm::dvec3& direction, double reach,
             HitFilter accept = {}) const;

  private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace head
