// The user interface: a colour times a texture (glyphs or a picture). Blends sRGB-encoded values directly.
#version 460

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(binding = 0) uniform sampler2D texture_of_it;
layout(location = 0) out vec4 out_color;

void main() { out_color = color * texture(texture_of_it, uv); }
