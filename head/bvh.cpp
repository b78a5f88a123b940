#include "head/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <limits>
#include <vector>

#include "base/input_error.hpp"

namespace head {
namespace {

/// Each triangle's box is padded by this share of the mesh's largest coordinate, because Embree's rays and
/// boxes are single precision. Embree's ray starts where it enters the mesh's bounds, so its error is at most
/// about 1e-6 of that coordinate for any distance of the origin, and no triangle is missed.
constexpr double padding_share = 1e-5;

struct Triangle
{
    std::array<glm::vec3, 3> corners;
    std::uint32_t first_index, primitive, material;
};

/// The user data of Embree's callbacks.
struct Mesh
{
    std::vector<Triangle> triangles;                                // all finite, in index order
    double padding = 0;                                             // metres
    glm::dvec3 low{std::numeric_limits<double>::max()}, high{-low}; // bounds, padded
};

/// The parameters and the result of a ray query. Embree passes its address to the callbacks.
struct Query
{
    RTCIntersectContext context; // must be first: the callbacks cast its address to Query*
    glm::dvec3 origin, direction;
    double tmin, tmax; // tmax shrinks to the nearest hit so far
    Facing facing;
    const HitFilter* accept;
    double metres_per_length = 1; // of the direction
    double start = 0;             // metres from the origin to the start of Embree's ray
    double padding = 0;           // metres
    bool found = false;
    std::uint32_t order = 0; // index in Mesh::triangles of the hit triangle
    Hit hit;
};

/// Moeller & Trumbore 1997. Records the triangle's hit if it is the nearest so far. Barycentric coordinates
/// may exceed their range by 1e-9, so that neighbouring triangles overlap.
bool take(Query& query, const Triangle& triangle, std::uint32_t order)
{
    const auto& corners = triangle.corners;
    const glm::dvec3 a(corners[0]), ab = glm::dvec3(corners[1]) - a, ac = glm::dvec3(corners[2]) - a;
    const glm::dvec3 p = glm::cross(query.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (!((query.facing == Facing::Front ? determinant : std::abs(determinant)) > 1e-18))
        return false; // seen from behind, parallel to the ray or without area
    const glm::dvec3 s = query.origin - a, q = glm::cross(s, ab);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(query.direction, q) / determinant;
    if (!(u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9))
        return false;
    const double distance = glm::dot(ac, q) / determinant;
    if (!(distance >= query.tmin && distance <= query.tmax) ||
        (query.found && distance == query.tmax && order > query.order))
        return false;
    const Hit hit{
        triangle.first_index, triangle.primitive, triangle.material, determinant > 0, distance, u, v};
    if (!(*query.accept)(hit))
        return false;
    query.found = true;
    query.order = order;
    query.hit = hit;
    query.tmax = distance;
    return true;
}

template <typename Arguments>
bool take_one(Query& query, const Arguments& arguments)
{
    const Mesh& mesh = *static_cast<const Mesh*>(arguments.geometryUserPtr);
    return take(query, mesh.triangles[arguments.primID], arguments.primID);
}

void on_nearest(const RTCIntersectFunctionNArguments* arguments)
{
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    if (!take_one(query, *arguments))
        return;
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
    const double hit = query.tmax * query.metres_per_length - query.start;
    // The padding makes Embree also test triangles that are equally near.
    ray.tfar = std::min(ray.tfar, float(hit + query.padding));
}

void on_any(const RTCOccludedFunctionNArguments* arguments)
{
    if (take_one(*reinterpret_cast<Query*>(arguments->context), *arguments))
        reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity(); // stop
}

glm::vec3 low_of(const Triangle& triangle)
{
    const auto& [a, b, c] = triangle.corners;
    return glm::min(a, glm::min(b, c));
}

glm::vec3 high_of(const Triangle& triangle)
{
    const auto& [a, b, c] = triangle.corners;
    return glm::max(a, glm::max(b, c));
}

void add_if_finite(std::vector<Triangle>& triangles, const Triangle& triangle)
{
    for (const glm::vec3& corner : triangle.corners)
        if (!std::isfinite(corner.x) || !std::isfinite(corner.y) || !std::isfinite(corner.z))
            return;
    triangles.push_back(triangle);
}

std::vector<Triangle> triangles_of(const Model& model, Bvh::Triangles which)
{
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < model.primitives.size(); ++i) {
        const Primitive& primitive = model.primitives[i];
        if (which == Bvh::Triangles::Solid && model.materials[primitive.material].alpha == AlphaMode::Blend)
            continue;
        for (std::uint32_t k = 0; k + 2 < primitive.index_count; k += 3) {
            const std::uint32_t first = primitive.first_index + k;
            add_if_finite(triangles, {corners_of(model, first), first, i, primitive.material});
        }
    }
    return triangles;
}

std::vector<Triangle> triangles_of(std::span<const glm::vec3> positions,
                                   std::span<const std::uint32_t> indices)
{
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i + 2 < indices.size(); i += 3)
        add_if_finite(
            triangles,
            {{positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]}, i, 0, 0});
    return triangles;
}

Mesh with_bounds(std::vector<Triangle> triangles)
{
    Mesh mesh{std::move(triangles)};
    for (const Triangle& triangle : mesh.triangles) {
        mesh.low = glm::min(mesh.low, glm::dvec3(low_of(triangle)));
        mesh.high = glm::max(mesh.high, glm::dvec3(high_of(triangle)));
    }
    for (int axis = 0; axis < 3; ++axis)
        mesh.padding = std::max({mesh.padding, padding_share * std::abs(mesh.low[axis]),
                                 padding_share * std::abs(mesh.high[axis])});
    mesh.low -= mesh.padding;
    mesh.high += mesh.padding;
    return mesh;
}

void bounds_of(const RTCBoundsFunctionArguments* arguments)
{
    const Mesh& mesh = *static_cast<const Mesh*>(arguments->geometryUserPtr);
    const Triangle& triangle = mesh.triangles[arguments->primID];
    const glm::vec3 low(glm::dvec3(low_of(triangle)) - mesh.padding),
        high(glm::dvec3(high_of(triangle)) + mesh.padding);
    *arguments->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
}

} // namespace

struct Bvh::Scene
{
    explicit Scene(Mesh of);
    /// Makes Embree's ray for the query and sets the query's fields that depend on it; none if the ray misses
    /// the mesh's bounds.
    std::optional<RTCRay> ray_for(Query& query) const;

    const Mesh mesh;
    const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device;
    const std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> embree;
};

Bvh::Scene::Scene(Mesh of)
    : mesh(std::move(of)), device(rtcNewDevice(nullptr), rtcReleaseDevice),
      embree(device ? rtcNewScene(device.get()) : nullptr, rtcReleaseScene)
{
    const auto check = [](bool good) {
        if (!good)
            throw base::InputError("Embree (ray tracing)", "failed to start on this machine",
                                   "check that enough memory is free");
    };
    check(embree != nullptr);
    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(mesh.triangles.size()));
    rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));
    rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
    rtcSetGeometryIntersectFunction(geometry, on_nearest);
    rtcSetGeometryOccludedFunction(geometry, on_any);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(embree.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(embree.get());
    check(rtcGetDeviceError(device.get()) == RTC_ERROR_NONE);
}

std::optional<RTCRay> Bvh::Scene::ray_for(Query& query) const
{
    if (mesh.triangles.empty())
        return std::nullopt;
    const double length = glm::length(query.direction);
    const glm::dvec3 unit = query.direction / length, inverse = 1.0 / unit;
    double enter = query.tmin * length, leave = query.tmax * length;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (mesh.low[axis] - query.origin[axis]) * inverse[axis],
                     b = (mesh.high[axis] - query.origin[axis]) * inverse[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    const glm::dvec3 from = query.origin + enter * unit;
    if (!(length > 0) || !std::isfinite(length) || !(enter <= leave) ||
        !std::isfinite(from.x + from.y + from.z))
        return std::nullopt;
    query.metres_per_length = length;
    query.start = enter;
    query.padding = mesh.padding;
    rtcInitIntersectContext(&query.context);
    RTCRay ray{};
    ray.org_x = float(from.x);
    ray.org_y = float(from.y);
    ray.org_z = float(from.z);
    ray.dir_x = float(unit.x);
    ray.dir_y = float(unit.y);
    ray.dir_z = float(unit.z);
    ray.tfar = float(leave - enter + mesh.padding);
    ray.mask = ~0u;
    return ray;
}

Bvh::Bvh(const Model& model, Triangles which)
    : scene_(std::make_unique<Scene>(with_bounds(triangles_of(model, which))))
{
}

Bvh::Bvh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices)
    : scene_(std::make_unique<Scene>(with_bounds(triangles_of(positions, indices))))
{
}

Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

std::optional<Hit> Bvh::nearest(const glm::dvec3& origin, const glm::dvec3& direction, double tmin,
                                double tmax, Facing facing, HitFilter accept) const
{
    Query query{{}, origin, direction, tmin, tmax, facing, &accept};
    const std::optional<RTCRay> ray = scene_->ray_for(query);
    if (!ray)
        return std::nullopt;
    RTCRayHit both{*ray, {}};
    both.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_->embree.get(), &query.context, &both);
    return query.found ? std::optional(query.hit) : std::nullopt;
}

bool Bvh::any(const glm::dvec3& origin, const glm::dvec3& direction, double reach, HitFilter accept) const
{
    Query query{{}, origin, direction, 0, reach, Facing::Both, &accept};
    std::optional<RTCRay> ray = scene_->ray_for(query);
    if (!ray)
        return false;
    rtcOccluded1(scene_->embree.get(), &query.context, &*ray);
    return query.found;
}

} // namespace head
