#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// The head, each point by itself; of skin under which light spreads in the picture, what it receives stands apart.
#define APART
#include "lib/forward_fragment.glsl"
