// The backward warp at the centres of a square of texels: day-0 coordinates in xy.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/warp.h"

layout(constant_id = 0) const uint WARP_MODEL = 0; // wound::WarpModel

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform writeonly image2D day0;
layout(scalar, binding = 1) uniform Header { WarpHeader header; };
layout(scalar, binding = 2) readonly buffer WarpValues_ { vec2 warp_values[]; };
#include "lib/warp.glsl"

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(day0);
    if (any(greaterThanEqual(texel, size)))
        return;
    const vec2 p = (vec2(texel) + 0.5) * 2 / vec2(size) - 1;
    imageStore(day0, texel, vec4(warp_backward(WARP_MODEL, header, p), 0, 0));
}
