// Linear light to 8-bit sRGB: exposure, optional soft shoulder for highlights, sRGB curve.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/color.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool shoulder = true;
layout(constant_id = 1) const bool transparent = false; // straight alpha instead of the backdrop
layout(binding = 0) uniform sampler2D hdr;
layout(binding = 1, rgba8) uniform writeonly image2D encoded;
// top, bottom: linear colours of the backdrop, not exposed
layout(binding = 2, scalar) uniform ExposureBlock { float exposure_factor; vec3 top, bottom; };

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(encoded))))
        return;
    vec4 radiance = texelFetch(hdr, texel, 0);
    float alpha = clamp(radiance.a, 0.0, 1.0);
    vec3 linear = finite_radiance(radiance.rgb) * exposure_factor;
    if (transparent && alpha > 0.0) // undo the premultiplication
        linear /= alpha;
    if (shoulder)
        linear = soft_shoulder(linear);
    if (!transparent)
        linear += (1.0 - alpha) * mix(top, bottom, (float(texel.y) + 0.5) / float(imageSize(encoded).y));
    imageStore(encoded, texel, vec4(srgb_from_linear(min(linear, 1.0)), transparent ? alpha : 1.0));
}
