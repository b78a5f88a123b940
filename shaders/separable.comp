#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Jimenez et al. 2015, "Separable subsurface scattering": one of two passes along the picture's axes. As in the authors'
// program the kernel is scaled by the pixel's own strength and by its distance, and where a sample's depth differs from the pixel's, the
// pixel's own light takes its place ("follow surface").
#include "lib/screen_diffusion.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool ALONG_Y = false; // the second pass, which makes the picture
layout(binding = 5, rgba16f) uniform writeonly image2D spread;
layout(scalar, binding = 6) uniform Kernel_ { SeparableKernel kernel; };

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = imageSize(spread);
    if (any(greaterThanEqual(p, size)))
        return;
    const vec4 behind = ALONG_Y ? texelFetch(specular, p, 0) : texelFetch(received, p, 0);
    const SkinPixel here = skin_pixel(p);
    if (here.share < LEAST_SKIN)
    {
        imageStore(spread, p, behind);
        return;
    }
    const float pixels = pixels_per_width(here, SEPARABLE_REACH);
    const float widest = max(max(here.width.r, here.width.g), here.width.b);
    const vec2 direction = ALONG_Y ? vec2(0, 1) : vec2(1, 0);
    vec3 sum = here.light * kernel.taps[0].rgb;
    for (int i = 1; i < SEPARABLE_TAPS; ++i)
    {
        const vec4 tap = kernel.taps[i];
        const vec2 at = clamp(vec2(p) + 0.5 + tap.a * pixels * direction, tile.low + 0.5, tile.high - 0.5);
        const vec4 there = textureLod(received, at / vec2(size), 0); // between pixels
        const float share = max(1.0 - there.a, LEAST_SKIN);
        const float gap = texelFetch(distances, ivec2(at), 0).r / share - here.distance_m;
        // Our reading of the authors' constant, which belongs to their scene: all is refused at the kernel's own reach.
        const float refused = 1.0 - there.a < LEAST_SKIN ? 1.0 : min(abs(gap) / (SEPARABLE_REACH * widest), 1.0);
        sum += tap.rgb * mix(there.rgb / share, here.light, refused);
    }
    imageStore(spread, p, ALONG_Y ? vec4(behind.rgb + here.share * here.albedo * sum, behind.a)
                                  : vec4(here.share * sum, behind.a));
}
