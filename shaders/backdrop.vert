#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The backdrop of a picture that is written without a pass for the tone curve; tonemap.comp draws the same. In bands, so narrow
// that the sRGB curve is straight within one.
#include "lib/color.glsl"
#include "shared/skin.h"

layout(scalar, binding = 14) uniform Develop_ { Develop develop; };

layout(location = 0) out vec3 v_color;

void main()
{
    const int band = gl_VertexIndex / 6, k = gl_VertexIndex % 6;
    const vec2 corner = k < 3 ? vec2(k == 1, k == 2) : 1 - vec2(k == 4, k == 5);
    const float down = (float(band) + corner.y) / float(BACKDROP_BANDS);
    v_color = srgb_from_linear(min(mix(develop.top, develop.bottom, down), 1.0));
    gl_Position = vec4(2 * corner.x - 1, 2 * down - 1, 1, 1);
}
