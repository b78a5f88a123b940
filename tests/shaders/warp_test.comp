// The day-0 point of every texel's centre, for the test that compares the warp with its double-precision twin.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/warp.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint RUNG = 1; // wound::WarpRung
layout(binding = 0, scalar) uniform Warp_ { WarpHeader warp; };
layout(binding = 1, scalar) readonly buffer WarpValues_ { vec2 warp_values[]; };
layout(binding = 2, rg32f) uniform writeonly image2D day0;

#include "lib/warp.glsl"

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(day0);
    if (any(greaterThanEqual(texel, size)))
        return;
    const vec2 p = (vec2(texel) + .5) * 2 / vec2(size) - 1;
    imageStore(day0, texel, vec4(warp_backward(RUNG, warp, p), 0, 0));
}
