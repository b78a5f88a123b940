// Combines two pictures of equal size: left_picture left of the divider, right_picture from the divider on.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D left_picture;
layout(binding = 1) uniform sampler2D right_picture;
layout(binding = 2, rgba8) uniform writeonly image2D both;
layout(binding = 3) uniform Divider_ { int divider; }; // pixels from the left edge

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(both))))
        return;
    imageStore(both, texel, texel.x < divider ? texelFetch(left_picture, texel, 0) : texelFetch(right_picture, texel, 0));
}
