// Shows an image, times a tint.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform sampler2D source;
layout(binding = 1, scalar) uniform Tint { vec4 tint; };

void main() { color = tint * texture(source, uv); }
