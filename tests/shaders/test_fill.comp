// Fills an image with a colour plus its own texel coordinates, to check that every texel is written.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const float gain = 1.0;
layout(binding = 0, rgba32f) uniform writeonly image2D result;
layout(binding = 1, scalar) uniform Params
{
    vec3 color;
    float step;
} params;
layout(binding = 2, scalar) readonly buffer Offsets { vec2 offsets[]; };

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(result))))
        return;
    vec2 offset = vec2(0.0);
    for (int i = 0; i < offsets.length(); ++i)
        offset += offsets[i];
    imageStore(result, texel, vec4(gain * params.color + params.step * vec3(vec2(texel) + offset, 0.0), 1.0));
}
