// The reflectance of one stack of layers per invocation: r, r without the first surface, t.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "reflectance_case.h"
#include "lib/reflectance.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer CaseBlock { ReflectanceCase cases[]; };
layout(binding = 1, scalar) readonly buffer LayerBlock { ReflectanceLayer layers[]; };
layout(binding = 2, rgba32f) uniform writeonly image2D results;

float index_below(ReflectanceCase c, uint i)
{
    return i + 1 < c.count ? layers[c.first + i + 1].n : c.n_below;
}

vec3 two_stream(ReflectanceCase c, float first_surface)
{
    Element stack = boundary(c.n_above, layers[c.first].n);
    for (uint i = 0; i < c.count; ++i) {
        ReflectanceLayer layer = layers[c.first + i];
        stack = over(stack, tissue_slab(int(c.model), vec3(layer.sigma_a), vec3(layer.sigma_s_reduced), layer.g, layer.thickness_mm));
        stack = over(stack, boundary(layer.n, index_below(c, i)));
    }
    return vec3(stack.r_top.x, stack.r_top.x - first_surface, stack.t_down.x);
}

vec3 paper(ReflectanceCase c, float first_surface)
{
    vec3 sum = vec3(0.0), incoming = vec3(1.0);
    for (uint i = 0; i < c.count; ++i) {
        ReflectanceLayer layer = layers[c.first + i];
        vec3 reflected, transmitted;
        paper_layer(int(c.model), vec3(layer.sigma_a), vec3(layer.sigma_s_reduced * backward_fraction(layer.g)), layer.thickness_mm,
                    diffuse_fresnel(layer.n, index_below(c, i)), reflected, transmitted);
        sum += incoming * reflected;
        incoming *= transmitted;
    }
    float diffuse = paper_top_factor(int(c.model), c.n_above, layers[c.first].n) * sum.x;
    float entering = c.model <= REFLECTANCE_PUBLISHED ? 1.0 : 1.0 - first_surface; // eq. (2) has no first surface
    return vec3(first_surface + diffuse, diffuse, entering * incoming.x);
}

void main()
{
    uint index = gl_GlobalInvocationID.y * imageSize(results).x + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= imageSize(results).x || index >= cases.length())
        return;
    ReflectanceCase c = cases[index];
    float first_surface = diffuse_fresnel(c.n_above, layers[c.first].n);
    vec3 response = c.model >= REFLECTANCE_TWO_STREAM_PAPER ? two_stream(c, first_surface) : paper(c, first_surface);
    imageStore(results, ivec2(gl_GlobalInvocationID.xy), vec4(response, 1.0));
}
