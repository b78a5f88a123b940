// Blocks of every shape, for the reflection and the layout tests.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 16, local_size_y = 4) in;
layout(constant_id = 0) const bool on = true;
layout(constant_id = 1) const int count = 3;
layout(constant_id = 2) const uint flags = 1u;
layout(constant_id = 7) const float weight = 0.5;
struct Light
{
    vec3 direction;
    float strength;
};
layout(binding = 0, scalar) uniform Everything
{
    mat4 view;
    vec3 eye;
    mat3 rotation;
    vec2 pair;
    float list[3];
    Light lights[2];
    uint last;
} everything;
layout(binding = 1, scalar) readonly buffer Points
{
    uint used;
    Light points[];
};
layout(binding = 2) uniform sampler2D maps[2];
layout(binding = 3, rgba8) uniform writeonly image2D result;

void main()
{
    vec4 sum = everything.view[0] + vec4(everything.eye, everything.list[1]) + vec4(everything.rotation[1], 0.0);
    sum += vec4(everything.pair, everything.lights[1].strength, float(everything.last + used + flags) * weight);
    sum += textureLod(maps[0], vec2(0.5), 0.0) + textureLod(maps[1], vec2(0.5), 0.0);
    if (on)
        sum += vec4(points[count].direction, 0.0);
    imageStore(result, ivec2(gl_GlobalInvocationID.xy), sum);
}
