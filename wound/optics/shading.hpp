// Shading of a point of skin: section 5 of Choi & Chin 2014 in double precision, each equation as printed and
// corrected. The renderer's float versions are in shaders/lib/; a test compares the two. docs/shading.md says
// what was corrected and why.
//
// (8)  C_L = C (rho_d max(cos,0) + rho_ts / (alpha d + beta)^gamma) + I max(cos,0) rho_s f_ward
//
// Local vectors are (tangent, bitangent, normal) components, unit length, pointing away from the surface.
#pragma once
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/color.hpp"
#include "shaders/shared/shading.h"

namespace optics {

#define MODEL_ENUMERATOR(number, enumerator, name, constant) enumerator = number,
#define MODEL_NAME(number, enumerator, name, constant) #name,

/// What each model is, and its name in scene files, stands in shaders/shared/shading.h.
enum class WardModel : std::uint32_t
{
    WARD_MODELS(MODEL_ENUMERATOR)
};
enum class SpecularModel : std::uint32_t
{
    SPECULAR_MODELS(MODEL_ENUMERATOR)
};
enum class TranslucencyModel : std::uint32_t
{
    TRANSLUCENCY_MODELS(MODEL_ENUMERATOR)
};
enum class BlendModel : std::uint32_t
{
    BLEND_MODELS(MODEL_ENUMERATOR)
};
/// How light that enters the skin comes out again.
enum class Transport : std::uint32_t
{
    TRANSPORTS(MODEL_ENUMERATOR)
};

/// By number.
inline const std::vector<std::string> ward_model_names{WARD_MODELS(MODEL_NAME)},
    specular_model_names{SPECULAR_MODELS(MODEL_NAME)},
    translucency_model_names{TRANSLUCENCY_MODELS(MODEL_NAME)}, blend_model_names{BLEND_MODELS(MODEL_NAME)},
    transport_names{TRANSPORTS(MODEL_NAME)};

#undef MODEL_ENUMERATOR
#undef MODEL_NAME

/// The terms of eq. (8), their models and coefficients. Default coefficients are the paper's; default models
/// conserve energy.
struct Shading
{
    bool lambert = true, translucency = true, ward = true;
    bool normal_map = true, shadow = true;
    bool bounce = true; // light that comes by way of the skin around a hollow
    Transport transport = Transport::Published;
    SpecularModel specular_model = SpecularModel::Ward;
    WardModel ward_model = WardModel::Bounded; // the form of every lobe
    TranslucencyModel translucency_model = TranslucencyModel::Bounded;
    BlendModel blend_model = BlendModel::Corrected;
    double rho_d = 0.7, rho_ts = 0.7, rho_s = 0.8; // diffuse, translucent, specular; 0..1
    double alpha = 0.2, beta = 0.75, gamma = 10;   // eq. (6), distances in the paper's unit
    double alpha_x = 0.4, alpha_y = 0.4; // standard deviation of the slope along tangent and bitangent
    base::Color ambient{0, 0, 0};        // linear radiance of the surroundings; 0 disables the term

    /// Which terms are drawn: chosen, and with a coefficient above 0.
    bool lambertian() const { return lambert && rho_d > 0; }
    bool translucent() const { return translucency && transport == Transport::Published && rho_ts > 0; }
    bool glossy() const { return ward && rho_s > 0; }
    /// The transport that is drawn: without its term, `published` is Lambert's.
    Transport drawn_transport() const
    {
        return transport == Transport::Published && !translucent() ? Transport::Lambert : transport;
    }
    /// The same where nothing is known of the light around a point.
    Transport pointwise_transport() const
    {
        return transport == Transport::Diffused ? Transport::Preintegrated : drawn_transport();
    }
    /// Light spreads in the picture (passes/screen_diffusion.hpp): `separable`, `burley` and `chang`.
    bool in_picture() const
    {
        return transport == Transport::Separable || transport == Transport::Burley ||
               transport == Transport::Chang;
    }
    /// The light that the skin receives is asked for on its atlas.
    bool on_atlas() const { return transport == Transport::Diffused || transport == Transport::Chang; }
    /// Asks for the tissue's scattering length (optics/transport.hpp).
    bool spreads() const
    {
        return transport == Transport::Preintegrated || transport == Transport::Diffused || in_picture();
    }
    /// What leaves a point depends on the viewer.
    bool by_viewer() const { return transport == Transport::OrenNayar; }
    /// W, the largest translucent weight at which a point that faces the light reflects no more light than it
    /// receives: rho_d + rho_ts W = 1.
    double translucency_bound() const;
    bool operator==(const Shading&) const = default;
};

/// Whether the highlight is eq. (7) as published, which nothing else touches: neither wetness nor occlusion.
inline bool only_ward(const Shading& shading)
{
    return shading.specular_model == SpecularModel::Ward && shading.ward_model == WardModel::Published;
}

/// Section 5 as printed: its equations and coefficients, no shadow, no ambient light.
Shading published_shading();
/// Corrected equations with coefficients for skin in a dim room. rho_d = .862 reflects as much light at the
/// face's middle as .8 and eq. (6) did together, without light where none arrives (docs/shading.md). The
/// highlight is that of SpecularModel::Skin.
Shading skin_shading();
/// With SpecularModel::Skin rho_s is relative to this: it reflects Fresnel's share of the light.
inline constexpr double skin_rho_s = 0.2;

/// The paper's unit of length, in which d of eq. (6) is measured: its object is 2.2 wide and its light at
/// distance 2 from the object's middle.
inline constexpr double paper_width = 2.2, paper_light_distance = 2;
/// Units per metre for an object of this width, wherever its lights are.
double paper_units_per_m(double object_width_m);

enum class LightKind : std::uint32_t
{
    Directional = shared::LIGHT_DIRECTIONAL,
    Point = shared::LIGHT_POINT,                               // inverse square
    PointWithoutFalloff = shared::LIGHT_POINT_WITHOUT_FALLOFF, // as in eq. (8)
};

struct Light
{
    LightKind kind = LightKind::Point;
    cv::Vec3d position{0, 0, 1};  // m; directional: a point of the plane from which d is measured
    cv::Vec3d direction{0, 0, 1}; // unit, towards the light; directional only
    /// I: radiance of a white diffuser that faces the light at the reference distance (irradiance / pi).
    base::Color strength{1, 1, 1};
    double reference_distance_m = 1;
    double paper_units_per_m = 1; // of the d of eq. (6)
    bool operator==(const Light&) const = default;
};

/// A light as a point sees it.
struct LightSample
{
    cv::Vec3d direction;  // unit, towards the light
    double distance_m;    // of a directional light from its plane, below 0 beyond it
    base::Color strength; // radiance of a white diffuser at the point that faces the light
};
LightSample sample_light(const Light& light, const cv::Vec3d& position);

/// Smallest and largest distance d, in the paper's unit, from a light to the points of a ball.
struct DistanceRange
{
    double min = 0, max = 0;
};
DistanceRange translucency_distances(const Light& light, const cv::Vec3d& center, double radius_m);

/// Throw base::InputError naming `where` and the field when a value is not finite or out of range, or when
/// alpha d + beta <= 0 for a distance in `reachable`.
void check_shading(const Shading& shading, const DistanceRange& reachable, std::string_view where);
void check_light(const Light& light, std::string_view where);

/// Eq. (6) at distance d (paper's unit); alpha d + beta > 0.
double translucency(const Shading& shading, double d);

/// Eq. (4). `recovery` is clamped to 0..1.
base::Color blend(BlendModel model, const base::Color& wound, const base::Color& reflectance,
                  const base::Color& skin, double recovery);

/// What changes the highlight from point to point.
struct Finish
{
    double wetness = 0;        // share of the point under a film of serum
    double slope_variance = 0; // 2 x variance of the slopes that are seen as one, added to the lobes' alpha^2
};

struct ShadedPoint
{
    cv::Vec3d position;                     // m
    cv::Matx33d frame = cv::Matx33d::eye(); // rows: tangent, bitangent, normal; orthonormal
    cv::Vec3d to_viewer{0, 0, 1};           // unit, in the space of `position`
    base::Color albedo{1, 1, 1};            // C of eq. (4)
    Finish finish;
    // What transports that spread light ask for:
    std::optional<cv::Vec3d> smooth{};         // unit normal without a normal map; none: the frame's
    cv::Vec2d curvature{0, 0};                 // 1/m, of the smooth surface: mean, root mean square
    double thinness = 0;                       // 1/m, of the part around it; 0: thick
    base::Color scattering_length_mm{0, 0, 0}; // scattering_length_mm() (transport.hpp)
};
/// What these transports have of a light's shadow map.
struct ShadowMap
{
    double filter_m = 1; // half width of the filter that gave the visibility
    double through_m = std::numeric_limits<double>::infinity(); // from the point to the first lit surface
};
/// Eq. (8) for one light; with transport `diffused`, what would leave if light left where it entered.
/// `visibility` (0 in full shadow .. 1) multiplies the direct light; as in the paper it does not affect the
/// translucent term.
base::Color shade(const Shading& shading, const Light& light, const ShadedPoint& point, double visibility,
                  const ShadowMap& map = {});

} // namespace optics
