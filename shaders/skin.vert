#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The skin's vertices, for light that is kept on its atlas.
#include "shared/frame.h"

layout(scalar, binding = 0) uniform View_ { View view; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float occlusion;
layout(location = 3) in vec2 place;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
layout(location = 2) out float v_open;
layout(location = 3) out vec2 v_place;

void main()
{
    v_position = position;
    v_normal = normal;
    v_open = occlusion;
    v_place = place;
    gl_Position = view.clip_from_world * vec4(position, 1);
}
