// One colour, or the texture coordinates.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
layout(binding = 1, scalar) uniform Paint { vec4 paint; };
layout(constant_id = 0) const bool show_uv = false;

void main() { color = show_uv ? vec4(uv, 0.0, 1.0) : paint; }
