#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A level of the pyramid of importance: sums over blocks of 4 x 4.
#include "lib/chang.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool FIRST = true; // from the atlas itself
layout(binding = 2) uniform sampler2D finer;
layout(binding = 3, r32f) uniform writeonly image2D level;

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(level))))
        return;
    float sum = 0;
    for (int i = 0; i < 16; ++i)
    {
        const ivec2 at = 4 * p + ivec2(i & 3, i >> 2);
        if (FIRST)
            sum += importance(at);
        else if (all(lessThan(at, textureSize(finer, 0))))
            sum += texelFetch(finer, at, 0).r;
    }
    imageStore(level, p, vec4(sum));
}
