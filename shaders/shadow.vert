// Projects the head's vertices to a light's tile of the depth image.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/shadow.h"

layout(location = 0) in vec3 position;
layout(binding = 0, scalar) uniform ShadowBlock { Shadow shadow; };

void main() { gl_Position = shadow.clip_from_world * vec4(position, 1.0); }
