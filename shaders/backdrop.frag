#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The backdrop of a picture that is written without a pass for the tone curve; tonemap.comp draws the same.
#include "lib/color.glsl"
#include "shared/skin.h"

layout(scalar, binding = 14) uniform Develop_ { Develop develop; };
layout(location = 0) out vec4 out_color;

void main() { out_color = vec4(srgb_from_linear(min(mix(develop.top, develop.bottom, gl_FragCoord.y / develop.size.y), 1.0)), 1); }
