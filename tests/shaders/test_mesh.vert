// Draws a mesh given in clip space, moved in depth.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 0) out vec2 out_uv;
layout(binding = 0, scalar) uniform Place { float depth; } place;

void main()
{
    out_uv = uv;
    gl_Position = vec4(position.xy, position.z + place.depth, 1.0);
}
