// The highlight of a point of skin; the double-precision reference is wound/optics/specular.cpp.
#ifndef LIB_SPECULAR_GLSL
#define LIB_SPECULAR_GLSL
#include "lib/ward.glsl"

// optics::Finish.
struct Finish
{
    float wetness;        // share of the point under a film of serum
    float slope_variance; // added to alpha^2
};

// Schlick 1994.
float fresnel_reflectance(float cosine)
{
    float x = 1.0 - cosine, square = x * x;
    return SKIN_F0 + (1.0 - SKIN_F0) * square * square * x;
}

// Two lobes. The narrower one has half the slope, so that its exponential is the fourth power of the wide one's.
float skin_lobes(WardForm ward, vec2 slope)
{
    vec2 steepness = ward.steepness / slope;
    float wide = exp(-dot(steepness, steepness)), square = wide * wide;
    return ward.form / (slope.x * slope.y) * ((1.0 - NARROW_SHARE) * wide + 4.0 * NARROW_SHARE * square * square);
}

// The specular coefficient times the lobes times cos(theta_i). `film`: whether the point may be wet.
float specular_times_cosine(uint model, uint ward_model, bool film, ShadingParams p, Finish finish, vec3 i, vec3 o)
{
    WardForm ward = ward_form(ward_model, i, o);
    if (model == SPECULAR_WARD)
        return p.rho_s * ward_times_cosine(ward, p.slope);
    float lobes;
    if (film)
    {
        lobes = skin_lobes(ward, sqrt(p.slope * p.slope + finish.slope_variance));
        float slope = sqrt(WET_SLOPE * WET_SLOPE + finish.slope_variance);
        lobes = mix(lobes, ward_times_cosine(ward, vec2(slope)), finish.wetness);
    }
    else
        lobes = skin_lobes(ward, p.slope);
    return 3.14159265358979 * p.fresnel_scale * fresnel_reflectance(ward.cosine) * lobes;
}

// specular_times_cosine() for a slope that is the same in all directions and not below .02: without a tangent frame.
// `facing_i`, `facing_o`: cosines between the normal and i and o.
float even_specular_times_cosine(uint model, uint ward_model, bool film, ShadingParams p, Finish finish, vec3 i, vec3 o,
                                 float facing_i, float facing_o)
{
    float ci = max(facing_i, WARD_MIN_COSINE), co = max(facing_o, WARD_MIN_COSINE);
    // Of the half vector. Divisions are dear on a software rasteriser, hence the factors.
    float square = 2.0 + 2.0 * dot(i, o), per_across = 1.0 / (ci + co), per_q = per_across * per_across;
    float form = max(facing_i, 0.0) * (1.0 / 3.14159265358979);
    if (ward_model == WARD_PUBLISHED)
        form *= 0.25 * inversesqrt(ci * co);
    else if (ward_model == WARD_DUER)
        form *= 0.25 / (ci * co);
    else
        form *= square * per_q * per_q;
    float steepness = max(square * per_q - 1.0, 0.0), variance = p.slope.x * p.slope.x; // tan^2
    if (film && model != SPECULAR_WARD)
        variance += finish.slope_variance;
    float per_variance = 1.0 / variance, wide = exp(-steepness * per_variance);
    if (model == SPECULAR_WARD)
        return p.rho_s * form * per_variance * wide;
    float square_of = wide * wide;
    float lobes = ((1.0 - NARROW_SHARE) * wide + 4.0 * NARROW_SHARE * square_of * square_of) * per_variance;
    if (film)
    {
        float per_wet = 1.0 / (WET_SLOPE * WET_SLOPE + finish.slope_variance);
        lobes = mix(lobes, exp(-steepness * per_wet) * per_wet, finish.wetness);
    }
    return 3.14159265358979 * p.fresnel_scale * fresnel_reflectance(min(0.5 * sqrt(square), 1.0)) * form * lobes;
}

// The share of even light that SPECULAR_SKIN reflects, without fresnel_scale. `cosine` between normal and viewer.
float ambient_specular(ShadingParams p, Finish finish, float cosine)
{
    float x = 1.0 - cosine, square = x * x;
    return SKIN_F0 + mix(p.grazing, WET_GRAZING, finish.wetness) * square * square;
}

// The share of even light that reaches a mirror's lobe where `open` of diffuse light does. `cosine` between normal and viewer.
float specular_occlusion(float open, float cosine)
{
    return pow(clamp(cosine, 1e-3, 1.0), 2.0 * (1.0 - open) / max(open, 1e-3));
}

// The share of a mirrored direction's lobe above the surface without normal map and wounds. `cosine` between the direction
// and that surface's normal. After Russell, "Horizon occlusion for normal mapped reflections".
float above_horizon(float cosine)
{
    float x = clamp(1.0 + 1.3 * cosine, 0.0, 1.0);
    return x * x;
}

// What is mirrored of even light with the radiance 1, without fresnel_scale. All vectors are unit vectors. cosine: between
// normal and viewer.
float ambient_highlight(ShadingParams p, Finish finish, float open, vec3 normal, float cosine, vec3 geometric, vec3 to_viewer)
{
    return ambient_specular(p, finish, cosine) * specular_occlusion(open, cosine) *
           above_horizon(2.0 * cosine * dot(normal, geometric) - dot(to_viewer, geometric));
}

#endif
