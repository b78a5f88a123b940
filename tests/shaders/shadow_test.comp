// The visibility of the light from each point of a list; in a second row metres of skin towards the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/shadow.glsl"

struct Receiver
{
    vec3 position, normal, to_light;
    float curvature; // 1/m, of the body that light enters; 0: it does not
};

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer ReceiverBlock { Receiver receivers[]; };
layout(binding = 1, scalar) uniform ShadowBlock { Shadow shadow; };
layout(binding = 2) uniform sampler2D shadow_depth;
layout(binding = 3, r32f) uniform writeonly image2D results;

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    uint index = place.x;
    if (place.x >= imageSize(results).x || index >= receivers.length())
        return;
    Receiver r = receivers[index];
    ShadowLookup lookup = shadow_lookup(shadow, r.position, r.normal, r.to_light, r.curvature > 0.0 ? TRANSPORT_PREINTEGRATED : TRANSPORT_LAMBERT, r.curvature);
    Shade shade = shadow_sample(shadow_depth, shadow, lookup);
    imageStore(results, place, vec4(place.y == 0 ? shade.visibility : shade.through_m));
}
