// The visibility of the light from each point of a list.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/shadow.glsl"

struct Receiver
{
    vec3 position, normal, to_light;
};

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer ReceiverBlock { Receiver receivers[]; };
layout(binding = 1, scalar) uniform ShadowBlock { Shadow shadow; };
layout(binding = 2) uniform sampler2D shadow_depth;
layout(binding = 3, r32f) uniform writeonly image2D visibility;

void main()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    uint index = place.y * imageSize(visibility).x + place.x;
    if (place.x >= imageSize(visibility).x || index >= receivers.length())
        return;
    Receiver r = receivers[index];
    vec4 in_light = shadow_place(shadow, r.position, r.normal, r.to_light);
    vec2 slope = shadow_slope(shadow, r.position, r.normal, r.to_light);
    imageStore(visibility, place, vec4(shadow_visibility(shadow_depth, in_light, slope)));
}
