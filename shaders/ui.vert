// The user interface: triangles in pixel coordinates with sRGB-encoded colours.
#version 460

layout(location = 0) in vec2 position; // pixels
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color; // not premultiplied
layout(push_constant) uniform Scale
{
    vec2 clip_per_pixel, clip_of_origin;
};
layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_color;

void main()
{
    out_uv = uv;
    out_color = color;
    gl_Position = vec4(position * clip_per_pixel + clip_of_origin, 0.0, 1.0);
}
