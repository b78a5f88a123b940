#include "wound/optics/shading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/input_error.hpp"
#include "wound/optics/specular.hpp"
#include "wound/optics/transport.hpp"

namespace optics {
namespace {

constexpr double smallest_slope = 1e-4, largest_slope = 1.5;

void require(bool good, std::string_view where, std::string_view field, std::string_view what,
             std::string_view cure)
{
    if (!good)
        throw base::InputError(fmt::format("{}/{}", where, field), what, cure);
}

// Also rejects NaN and infinity.
void require_within(double value, double low, double high, std::string_view where, std::string_view field)
{
    require(value >= low && value <= high, where, field, fmt::format("{} is out of range", value),
            fmt::format("give a number from {} to {}", low, high));
}

void require_finite(const cv::Vec3d& v, std::string_view where, std::string_view field)
{
    require(std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]), where, field,
            "a component is not finite", "give three numbers");
}

} // namespace

double Shading::translucency_bound() const
{
    return rho_ts > 0 ? std::max(0.0, 1 - rho_d) / rho_ts : 0;
}

Shading published_shading()
{
    Shading shading;
    shading.ward_model = WardModel::Published;
    shading.translucency_model = TranslucencyModel::Published;
    shading.blend_model = BlendModel::Published;
    shading.shadow = false;
    return shading;
}

Shading skin_shading()
{
    Shading shading;
    shading.transport = Transport::Diffused;
    shading.specular_model = SpecularModel::Skin;
    shading.rho_d = 0.862;
    shading.rho_ts = 0.25;
    shading.rho_s = skin_rho_s;
    shading.alpha_x = shading.alpha_y = 0.3;
    shading.ambient = {0.14, 0.145, 0.16};
    return shading;
}

double paper_units_per_m(double object_width_m)
{
    return paper_width / object_width_m;
}

DistanceRange translucency_distances(const Light& light, const cv::Vec3d& center, double radius_m)
{
    const cv::Vec3d to_light = light.position - center;
    const double distance =
        light.kind == LightKind::Directional ? to_light.dot(light.direction) : cv::norm(to_light);
    const auto paper = [&](double metres) { return light.paper_units_per_m * std::max(0.0, metres); };
    return {paper(distance - radius_m), paper(distance + radius_m)};
}

void check_shading(const Shading& shading, const DistanceRange& reachable, std::string_view where)
{
    require_within(shading.rho_d, 0, 1, where, "rho_d");
    require_within(shading.rho_ts, 0, 1, where, "rho_ts");
    require_within(shading.rho_s, 0, 1, where, "rho_s");
    require_within(shading.alpha, -1e6, 1e6, where, "alpha");
    require_within(shading.beta, -1e6, 1e6, where, "beta");
    require_within(shading.gamma, 0, 100, where, "gamma");
    require_within(shading.alpha_x, smallest_slope, largest_slope, where, "alpha_x");
    require_within(shading.alpha_y, smallest_slope, largest_slope, where, "alpha_y");
    for (double d : {reachable.min, reachable.max}) // alpha d + beta is linear, so its minimum is at an end
        require(shading.alpha * d + shading.beta > 0, where, "beta",
                fmt::format("alpha d + beta = {:.4g} at distance d = {:.4g} of the object from a light",
                            shading.alpha * d + shading.beta, d),
                "raise alpha or beta, or move the light, so that alpha d + beta > 0");
}

void check_light(const Light& light, std::string_view where)
{
    require_finite(light.position, where, "position");
    require_finite(light.direction, where, "direction");
    require_finite(light.strength, where, "strength");
    for (double channel : light.strength.val)
        require_within(channel, 0, 1e4, where, "strength");
    require_within(light.reference_distance_m, 1e-3, 1e3, where, "reference_distance_m");
    require_within(light.paper_units_per_m, 0, 1e6, where, "paper_units_per_m");
    if (light.kind == LightKind::Directional)
        require(std::abs(cv::norm(light.direction) - 1) < 1e-6, where, "direction", "not of unit length",
                "give a direction other than 0 0 0, normalised");
}

double translucency(const Shading& shading, double d)
{
    const double published = std::pow(shading.alpha * d + shading.beta, -shading.gamma);
    if (shading.translucency_model == TranslucencyModel::Published)
        return published;
    const double bound = shading.translucency_bound();
    return bound > 0 ? std::pow(std::pow(published, -4) + std::pow(bound, -4), -0.25) : 0;
}

base::Color blend(BlendModel model, const base::Color& wound, const base::Color& reflectance,
                  const base::Color& skin, double recovery)
{
    const double r = std::clamp(recovery, 0.0, 1.0), root = std::sqrt(r);
    if (model == BlendModel::Published)
        return (1 - 0.8 * root) * wound + 0.8 * root * reflectance + 0.4 * r * (skin - reflectance);
    // The root terms of eq. (4) as printed, plus a r W + b r R + c r S: C(1) = S requires a = -.2, b = -.8,
    // c = 1.
    const double of_reflectance = 0.8 * (root - r);
    return (1 - (of_reflectance + r)) * wound + of_reflectance * reflectance + r * skin;
}

LightSample sample_light(const Light& light, const cv::Vec3d& position)
{
    constexpr double nearest = 1e-3; // m; smallest distance, for a light on or inside the surface
    const cv::Vec3d offset = light.position - position;
    if (light.kind == LightKind::Directional)
        return {light.direction, offset.dot(light.direction), light.strength};
    const double metres = std::max(cv::norm(offset), nearest);
    const double falloff =
        light.kind == LightKind::Point ? std::pow(light.reference_distance_m / metres, 2) : 1;
    return {offset / metres, metres, falloff * light.strength};
}

base::Color shade(const Shading& shading, const Light& light, const ShadedPoint& point, double visibility,
                  const ShadowMap& map)
{
    const LightSample sample = sample_light(light, point.position);
    const cv::Vec3d incident = point.frame * sample.direction, outgoing = point.frame * point.to_viewer;
    const base::Color direct = visibility * std::max(0.0, incident[2]) * sample.strength;
    base::Color left =
        leaving(shading, point, sample.direction, incident, visibility, map).mul(sample.strength);
    if (shading.transport == Transport::Published) {
        const double d = light.paper_units_per_m * std::max(0.0, sample.distance_m);
        left += shading.rho_ts * translucency(shading, d) * light.strength.mul(point.albedo);
    }
    return left + specular(shading, point.finish, incident, outgoing) * direct;
}

} // namespace optics
