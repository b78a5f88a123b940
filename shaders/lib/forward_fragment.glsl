// Shades the head: albedo and normal map, wounds projected in object space and blended by eq. (4), shading by
// eq. (8) of Choi & Chin 2014. A term that a specialisation constant turns off is not compiled.
// With DIFFUSED defined the part has a place on the skin's atlas and takes its light from all around. With APART defined the
// skin's diffuse light, its reflectance and its distance are handed out beside the rest (lib/screen_diffusion.glsl).
#ifndef LIB_FORWARD_FRAGMENT_GLSL
#define LIB_FORWARD_FRAGMENT_GLSL
#include "lib/develop.glsl"
#include "lib/light_inputs.glsl"
#include "lib/skin_inputs.glsl"
#ifdef DIFFUSED
#include "lib/diffusion.glsl"
#endif

layout(constant_id = 3) const bool WARD = true;
layout(constant_id = 7) const uint WARD_MODEL = WARD_BOUNDED;
layout(constant_id = 8) const uint TRANSLUCENCY_MODEL = TRANSLUCENCY_BOUNDED;
layout(constant_id = 11) const uint SPECULAR_MODEL = SPECULAR_SKIN;
layout(constant_id = 13) const bool DEVELOPED = false; // the picture is written, not radiance

layout(location = 4) in vec3 v_subsurface;
layout(location = 0) out vec4 out_color;

layout(scalar, binding = 0) uniform View_ { View view; };
layout(scalar, binding = 14) uniform Develop_ { Develop develop; };
#ifdef DIFFUSED
layout(location = 12) in vec2 v_place;
layout(binding = 15) uniform sampler2D diffused_light;
#endif

#ifdef APART
layout(constant_id = 17) const bool SPREADS = true; // opaque skin; what else there is hides it
// Where blending dims them, it makes their alpha the share that is hidden.
layout(location = 1) out vec4 out_received;
layout(location = 2) out vec4 out_reflectance;
layout(location = 3) out vec4 out_distance;
#endif

void main()
{
    const vec3 to_viewer = normalize_or(view.eye - v_position, vec3(0, 0, 1));
    mat3 frame = frame_of(gl_FrontFacing ? v_normal : -v_normal, v_tangent);
    const vec3 geometric = frame[2];
    float alpha, open;
    SkinPoint skin = skin_here(frame, alpha, open);

    frame = frame_of(bend_to_viewer(skin.normal, to_viewer), v_tangent);
    // Eq. (7) as published: neither wetness nor occlusion touches it.
    const bool only_ward = SPECULAR_MODEL == SPECULAR_WARD && WARD_MODEL == WARD_PUBLISHED;
    const ShadingParams params = with_gloss(SPECULAR_MODEL, only_ward, shading, part, skin);
    const Finish finish = Finish(skin.wetness, skin.slope_variance);
    const vec3 local_viewer = to_viewer * frame;
    const vec3 visible = AMBIENT ? surroundings_seen(open * skin.occlusion, params.rho_d * skin.albedo) : vec3(0);
    const DiffuseSkin body =
        diffuse_skin(TRANSPORT, params.rho_d * skin.albedo, part.scattering * params.scattering, v_curvature);
    vec3 diffuse = vec3(0);
    if (AMBIENT)
        diffuse = params.ambient * surroundings_left(TRANSPORT, body, visible, v_thinness) * skin.albedo; // ambient: times rho_d already
    vec3 mirrored = vec3(0), bounced = vec3(0);
    for (uint i = 0; i < LIGHTS; ++i)
    {
        LightSample light = sample_light(lighting.light[i], v_position);
        const vec3 local_light = light.direction * frame;
        if (BOUNCE && AMBIENT && LAMBERT)
            bounced += light.strength * bounced_share(open, local_light.z);
        const Shade shade = shade_here(i, v_position, geometric, light.direction);
        if (LAMBERT)
            diffuse += leaving(TRANSPORT, body, light.strength, local_light, local_viewer, dot(geometric, light.direction), shade);
        light.strength *= shade.visibility;
        if (WARD)
            mirrored += light.strength * specular_times_cosine(SPECULAR_MODEL, WARD_MODEL, WOUNDS > 0, params, finish, local_light,
                                                               local_viewer);
    }
    diffuse += body.albedo * body.albedo * bounced;
#ifdef DIFFUSED
    diffuse = with_surroundings(body, diffuse, texture(diffused_light, v_place));
#endif
    // Translucency is multiplied by ambient occlusion, except in the published model.
    if (TRANSPORT == TRANSPORT_PUBLISHED)
        diffuse += v_subsurface * skin.albedo *
                   (part.translucency * (TRANSLUCENCY_MODEL == TRANSLUCENCY_PUBLISHED ? 1 : open * skin.occlusion));
    // The head's own shadows dim the lights' highlights, but a wound's hollow is in no shadow map.
    mirrored *= only_ward ? 1 : skin.occlusion;
    if (AMBIENT && WARD && SPECULAR_MODEL == SPECULAR_SKIN)
        mirrored += params.mirrored * skin.occlusion * ambient_highlight(params, finish, open, frame[2], local_viewer.z, geometric, to_viewer);
#ifdef APART
    out_received = vec4(SPREADS ? finite_radiance(diffuse / max(body.albedo, vec3(1e-3))) : vec3(0), SPREADS ? 0 : alpha);
    out_reflectance = vec4(SPREADS ? body.albedo : vec3(0), alpha);
    out_distance = vec4(SPREADS ? 1 / gl_FragCoord.w : 0, 0, 0, alpha);
    if (SPREADS)
        diffuse = vec3(0);
#endif
    const vec3 radiance = diffuse + mirrored;
    out_color = DEVELOPED ? vec4(developed(develop, radiance), 1) : vec4(finite_radiance(radiance), alpha);
}

#endif
