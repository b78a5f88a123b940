// How light that enters the skin leaves it again: the models of TRANSPORTS (shared/shading.h) at one point, for one
// light. The same in double precision, with sources and reasons, is wound/optics/transport.hpp.
#ifndef LIB_TRANSPORT_GLSL
#define LIB_TRANSPORT_GLSL
#include "lib/shadow.glsl"
#include "shared/shading.h"

const float LEAST_WIDTH_M = 1e-6; // where no light enters

// A point of the skin. diffuse_skin() makes it, once for all lights.
struct DiffuseSkin
{
    vec3 albedo;      // rho_d C
    vec3 width;       // m, how far light spreads; of transports that spread it
    vec3 gain;        // what a body that bends returns more than a half space does; preintegrated and diffused
    vec3 slope, bend; // of received_bent(); preintegrated
    vec3 detail;      // share of the normal map's detail that diffusion leaves; preintegrated
};

// scattering: m, of the part of the head: 0 where no light enters. curvature: 1/m, mean (convex: > 0) and root mean square.
DiffuseSkin diffuse_skin(uint transport, vec3 albedo, vec3 scattering, vec2 curvature)
{
    DiffuseSkin skin = DiffuseSkin(albedo, vec3(0.0), vec3(1.0), vec3(1.0), vec3(0.0), vec3(1.0));
    if (transport == TRANSPORT_SEPARABLE || transport == TRANSPORT_BURLEY)
        skin.width = max(albedo * scattering, vec3(LEAST_WIDTH_M));
    if (transport == TRANSPORT_PREINTEGRATED || transport == TRANSPORT_DIFFUSED)
    {
        skin.width = max(albedo * scattering, vec3(LEAST_WIDTH_M));
        vec3 more = max(5.6 - 6.6 * albedo, 0.0) * clamp(curvature.x * skin.width, -0.25, 0.25);
        skin.gain = (1.0 + max(more, 0.0)) / (1.0 - min(more, 0.0));
    }
    if (transport == TRANSPORT_PREINTEGRATED)
    {
        vec3 turn = min(curvature.y * skin.width, 0.25); // radians
        vec3 square = turn * turn;
        skin.bend = square / (1.0 + 7.0 * square);
        vec3 peak = 1.0 - 7.0 * skin.bend;
        skin.slope = peak - skin.bend / peak;
        skin.detail = PORE_WIDTH / (PORE_WIDTH + 1.6 * skin.width);
    }
    return skin;
}

// Share of the light that leaves within this radius of where it entered, by Burley's profile. Same unit. In double
// precision: optics::left_within().
vec3 left_within(vec3 width, float radius)
{
    vec3 t = exp(-radius / (3.0 * width));
    return 1.0 - t * (t * t + 3.0) / 4.0;
}

// Schlick's 1 - F over its cosine-weighted mean, which is the same for any reflectance at normal incidence.
float through_gloss(float cosine)
{
    float x = clamp(1.0 - cosine, 0.0, 1.0), square = x * x;
    return 1.05 * (1.0 - square * square * x);
}

// Oren & Nayar 1994, eq. (30), with the footnote's .57 for light that goes back and forth between facets, under Gotanda's
// gloss, over what it returns of even light. i, o: unit, to the light and to the viewer, in the frame of the normal. Times cos(theta_i).
float oren_nayar_times_cosine(vec3 i, vec3 o)
{
    if (i.z <= 0.0)
        return 0.0;
    float ci = i.z, co = max(o.z, 1e-4);
    float variance = FACET_SLOPE * FACET_SLOPE;
    float a = 1.0 - 0.5 * variance / (variance + 0.57), b = 0.45 * variance / (variance + 0.09);
    float across = max(dot(i.xy, o.xy), 0.0); // sin(theta_i) sin(theta_o) max(cos(phi_i - phi_o), 0)
    return ci / FACETS_RETURN * (a + b * across / max(ci, co)) * through_gloss(ci) * through_gloss(co);
}

// What leaves of the surroundings' even light, over it and skin.albedo. seen: share of it that reaches the point;
// thinness: 1/m, of the part of the head, 0: thick.
vec3 surroundings_left(uint transport, DiffuseSkin skin, vec3 seen, float thinness)
{
    if (transport != TRANSPORT_PREINTEGRATED && transport != TRANSPORT_DIFFUSED)
        return seen;
    vec3 albedo = clamp(skin.albedo, 1e-3, 0.99), square = albedo * albedo;
    vec3 depth = 3.0 * skin.width / (1.0 - square * sqrt(albedo));
    vec3 share = exp(-1.0 / max(depth * thinness, 1e-3)) * vec3(greaterThan(skin.width, vec3(LEAST_WIDTH_M)));
    vec3 passed = (1.0 - square) * share / (albedo * (1.0 + albedo * share));
    return seen * min(skin.gain, 1.0) + max(seen * (skin.gain - 1.0), passed);
}

// The light that a ball returns where its normal and the light enclose this angle, over skin.gain and what a plane that
// faces the light returns: a hyperbola.
vec3 received_bent(DiffuseSkin skin, vec3 cosine)
{
    vec3 along = skin.slope * cosine;
    return max(0.5 * (along + sqrt(along * along + 4.0 * skin.bend)), 0.0);
}

// What the edge of a cast shadow becomes when light spreads under it.
vec3 softened(vec3 width, Shade shade)
{
    float side = 2.0 * shade.visibility - 1.0; // -1 and 1: where the filter ends in the dark and in the light
    vec3 blur = 0.8 * width / shade.filter_m + 1e-4;
    return 0.5 + 0.5 * side * (1.0 + blur) / (abs(side) + blur);
}

// The light that leaves the point diffusely; diffused, separable, burley: that would, if light left where it entered. strength: of the light,
// unshadowed; local_light and local_viewer in the frame of the shaded normal; facing: cosine between the light and the
// smooth surface.
vec3 leaving(uint transport, DiffuseSkin skin, vec3 strength, vec3 local_light, vec3 local_viewer, float facing, Shade shade)
{
    if (transport == TRANSPORT_OREN_NAYAR)
        return skin.albedo * (oren_nayar_times_cosine(local_light, local_viewer) * shade.visibility) * strength;
    if (transport == TRANSPORT_SEPARABLE || transport == TRANSPORT_BURLEY)
    {
        // Jimenez et al. 2010: the far side is lit evenly as this side turns away. Both papers pass the share of the
        // profile farther away than the thickness.
        vec3 passed = max(-facing, 0.0) * (1.0 - left_within(skin.width, shade.through_m));
        return skin.albedo * (max(local_light.z, 0.0) * shade.visibility + passed) * strength;
    }
    if (transport != TRANSPORT_PREINTEGRATED && transport != TRANSPORT_DIFFUSED)
        return skin.albedo * (max(local_light.z, 0.0) * shade.visibility) * strength;
    vec3 cosine = mix(vec3(facing), vec3(local_light.z), skin.detail);
    vec3 received = transport == TRANSPORT_DIFFUSED ? vec3(max(local_light.z, 0.0) * shade.visibility)
                                                    : received_bent(skin, cosine) * softened(skin.width, shade);
    vec3 reflected = skin.albedo * skin.gain * received;
    // Through a thin part, from its far side, which is taken to face the light as this side turns away from it.
    // Nothing passes what no light enters: hair, and a channel without albedo.
    vec3 passed = max(-facing, 0.0) * exp(-shade.through_m / (3.0 * skin.width)) *
                  vec3(greaterThan(skin.width, vec3(LEAST_WIDTH_M)));
    return max(reflected, passed) * strength;
}

#endif
