#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Shades the skin from the light that is kept on its atlas: what is left to do for a camera is the highlight. The same
// terms as in forward.frag, but for a slope that is equal in all directions.
#include "lib/develop.glsl"
#include "lib/shading.glsl"
#include "lib/skin_code.glsl"

layout(constant_id = 3) const bool WARD = true;
layout(constant_id = 5) const uint SHADOWS = 0; // bit i: light i casts a shadow
layout(constant_id = 6) const bool AMBIENT = true;
layout(constant_id = 7) const uint WARD_MODEL = WARD_BOUNDED;
layout(constant_id = 10) const uint LIGHTS = 1;
layout(constant_id = 11) const uint SPECULAR_MODEL = SPECULAR_SKIN;
layout(constant_id = 13) const bool DEVELOPED = false; // the picture is written, not radiance
layout(constant_id = 15) const bool WOUNDED = false;

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;
layout(location = 2) in float v_open;
layout(location = 3) in vec2 v_place;
layout(location = 0) out vec4 out_color;

layout(scalar, binding = 0) uniform View_ { View view; };
layout(scalar, binding = 1) uniform Part_ { Part part; };
layout(scalar, binding = 2) uniform Shading_ { ShadingParams shading; };
layout(scalar, binding = 3) uniform Lighting_ { Lighting lighting; };
layout(binding = 4) uniform sampler2D light_map;
layout(binding = 5) uniform sampler2D lit_normal;
layout(binding = 6) uniform sampler2D skin_gloss;
layout(scalar, binding = 7) uniform Code_ { LightCode code; };
layout(scalar, binding = 14) uniform Develop_ { Develop develop; };

vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-20)); }

void main()
{
    const vec4 light_here = texture(light_map, v_place), normal = texture(lit_normal, v_place);
    const vec4 gloss = WOUNDED ? texture(skin_gloss, v_place) : vec4(0, 0, 0, 1);
    SkinPoint skin = decoded_gloss(gloss);
    skin.normal = unit(normal.rgb * 2 - 1);
    const vec3 to_viewer = unit(view.eye - v_position);
    const float facing = max(dot(skin.normal, to_viewer), LEAST_FACING);

    const bool only_ward = SPECULAR_MODEL == SPECULAR_WARD && WARD_MODEL == WARD_PUBLISHED;
    const ShadingParams params = with_gloss(SPECULAR_MODEL, only_ward, shading, part, skin);
    const Finish finish = Finish(skin.wetness, skin.slope_variance);
    vec3 mirrored = vec3(0);
    for (uint i = 0; WARD && i < LIGHTS; ++i)
    {
        const LightSample light = sample_light(lighting.light[i], v_position);
        const float visible = (SHADOWS >> i & 1) == 0 ? 1 : i == 0 ? light_here.a : normal.a;
        mirrored += visible * light.strength *
                    even_specular_times_cosine(SPECULAR_MODEL, WARD_MODEL, WOUNDED, params, finish, light.direction, to_viewer,
                                               dot(skin.normal, light.direction), facing);
    }
    mirrored *= only_ward ? 1 : skin.occlusion;
    if (AMBIENT && WARD && SPECULAR_MODEL == SPECULAR_SKIN)
        mirrored += params.mirrored * skin.occlusion *
                    ambient_highlight(params, finish, v_open, skin.normal, facing, v_normal, to_viewer);
    const vec3 radiance = code.white * light_here.rgb * light_here.rgb + mirrored;
    out_color = DEVELOPED ? vec4(developed(develop, radiance), 1) : vec4(finite_radiance(radiance), 1);
}
