#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// The skin, with light that spreads from the surroundings of each point.
#define DIFFUSED
#include "lib/forward_fragment.glsl"
