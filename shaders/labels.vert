#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The head's vertices for the label pass.
#include "shared/frame.h"

layout(scalar, binding = 0) uniform View_ { View view; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;

void main()
{
    v_position = position;
    v_normal = normal;
    gl_Position = view.clip_from_world * vec4(position, 1);
}
