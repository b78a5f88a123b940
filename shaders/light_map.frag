#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The light that leaves the skin diffusely, seen from anywhere, and what of the first two lights reaches it. The same
// terms as in forward.frag, whose normal is bent towards the viewer at the head's outline.
#include "lib/diffusion.glsl"
#include "lib/light_inputs.glsl"
#include "lib/on_atlas.glsl"
#include "lib/skin_code.glsl"

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;

layout(scalar, binding = 0) uniform Draw_ { AtlasDraw draw; };
layout(scalar, binding = 1) uniform Code_ { LightCode code; };
layout(binding = 4) uniform sampler2D skin_albedo;
layout(binding = 5) uniform sampler2D skin_normal;
layout(binding = 6) uniform sampler2D skin_gloss;

layout(binding = 7) uniform sampler2D diffused_light; // used with transport diffused

layout(constant_id = 16) const bool RECEIVED = false;

// rgb: root of the light over `white`, or if RECEIVED what the skin receives, per reflectance; a: share of the first light
layout(location = 0) out vec4 out_light;
layout(location = 1) out vec4 out_normal; // rgb: as in the skin's map; a: share of the second light

void main()
{
    if (outside_tile(draw, gl_FragCoord.xy))
        discard;
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    const vec4 albedo = texelFetch(skin_albedo, texel, 0), normal = texelFetch(skin_normal, texel, 0);
    const SkinPoint skin = decoded_skin(albedo.rgb, normal.rgb, texelFetch(skin_gloss, texel, 0));
    const vec3 geometric = normalize_or(v_normal, vec3(0, 0, 1));
    const float open = albedo.a;

    const DiffuseSkin body = diffuse_skin(TRANSPORT, shading.rho_d * skin.albedo, shading.scattering, v_curvature);
    const vec3 seen = surroundings_seen(open * skin.occlusion, body.albedo);
    vec3 diffuse = shading.ambient * surroundings_left(TRANSPORT, body, seen, v_thinness) * skin.albedo;
    vec3 bounced = vec3(0);
    vec2 visible = vec2(1);
    for (uint i = 0; i < LIGHTS; ++i)
    {
        const LightSample light = sample_light(lighting.light[i], v_position);
        const vec3 local_light = vec3(0, 0, dot(light.direction, skin.normal));
        if (BOUNCE)
            bounced += light.strength * bounced_share(open, local_light.z);
        const Shade shade = shade_here(i, v_position, geometric, light.direction);
        diffuse += leaving(TRANSPORT, body, light.strength, local_light, vec3(0, 0, 1), dot(geometric, light.direction), shade);
        if (i < 2)
            visible[i] = shade.visibility;
    }
    diffuse += body.albedo * body.albedo * bounced;
    if (RECEIVED)
        out_light = vec4(min(diffuse / max(body.albedo, vec3(1e-3)), vec3(6e4)), visible.x);
    else
    {
        if (TRANSPORT == TRANSPORT_DIFFUSED)
            diffuse = with_surroundings(body, diffuse, textureLod(diffused_light, gl_FragCoord.xy / vec2(textureSize(skin_albedo, 0)), 0));
        out_light = vec4(sqrt(clamp(diffuse / code.white, 0.0, 1.0)), visible.x);
    }
    out_normal = vec4(normal.rgb, visible.y);
}
