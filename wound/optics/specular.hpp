// The highlight of a point of skin: Ward's lobe, eq. (7) of Choi & Chin 2014, and what SpecularModel makes of
// it. The float versions are in shaders/lib/ward.glsl and specular.glsl. Vectors as in
// wound/optics/shading.hpp.
//
// SpecularModel::Skin is two lobes times Fresnel's reflectance: the wide one with the shading's slopes, the
// narrower one with half of them. Where serum wets an open wound, its film's clear lobe takes their place.
#pragma once
#include "wound/optics/shading.hpp"

namespace optics {

/// Ward's reflection function, 1/sr, without rho_s. 0 when either direction is at or below the horizon.
/// Cosines are clamped to at least `ward_min_cosine`, which keeps every model finite.
inline constexpr double ward_min_cosine = 1e-4;
double ward(WardModel model, double alpha_x, double alpha_y, const cv::Vec3d& incident,
            const cv::Vec3d& outgoing);

/// The share of light from this direction that ward() reflects: f cos integrated over outgoing directions.
double ward_albedo(WardModel model, double alpha_x, double alpha_y, const cv::Vec3d& incident);

/// Schlick 1994, for skin and serum; `cosine` 0..1 between the half vector and either direction.
double fresnel_reflectance(double cosine);

/// The specular coefficient times the lobes. Times I max(cos, 0) it is the highlight's radiance; as in eq.
/// (8), I is irradiance / pi, so that all light is reflected where its albedo is pi.
double specular(const Shading& shading, const Finish& finish, const cv::Vec3d& incident,
                const cv::Vec3d& outgoing);

/// A direction from which a viewer sees light in the surface, and the share of its radiance that he sees.
struct MirrorRay
{
    cv::Vec3d direction; // unit
    double weight;       // 0 where the direction is below the surface
};
/// One of the directions of SpecularModel::Skin; the weights' mean is specular_albedo(). `lobe`, `u`, `v`:
/// within 0..1, u > 0.
MirrorRay mirror_ray(const Shading& shading, const Finish& finish, const cv::Vec3d& outgoing, double lobe,
                     double u, double v);

/// The share of light from this direction that SpecularModel::Skin reflects, by quadrature.
double specular_albedo(const Shading& shading, const Finish& finish, const cv::Vec3d& incident);
/// Nearly the same in closed form, for slopes alpha_x, alpha_y of .06 to .6: R0 + c (1 - cos)^4, times
/// fresnel_scale().
double ambient_specular(const Shading& shading, const Finish& finish, double cosine);
/// Factor on Fresnel's reflectance.
double fresnel_scale(const Shading& shading);
/// c of ambient_specular() without a film.
double grazing_reflectance(const Shading& shading);

} // namespace optics
