// Choi & Chin 2014, section 3, with Arad et al. 1994: the backward warp, today's patch point -> day 0's, in
// single precision. The double-precision reference is wound/warp/warp.cpp. The including shader must declare
// `vec2 warp_values[]` in a layout(scalar) buffer.
#include "../shared/models.h"
#include "../shared/warp.h"


vec2 warp_radial(WarpHeader warp, vec2 p)
{
    const vec2 offset = p - warp.center;
    const float radius = length(offset);
    if (radius == 0 || warp.count == 0)
        return p;
    const float turn = (atan(offset.y, offset.x) / 6.283185307 + .5) * warp.count;
    const uint index = min(uint(turn), warp.count - 1);
    const float hull = mix(warp_values[warp.first + index].x, warp_values[warp.first + (index + 1) % warp.count].x, turn - index);
    // Distance to the patch's edge along the ray, in units of the radius; infinite parallel to an edge, so
    // min() ignores it.
    const vec2 reach = (mix(vec2(-1), vec2(1), greaterThan(offset, vec2(0))) - warp.center) / offset;
    const float frame = radius * min(offset.x == 0 ? 1e9 : reach.x, offset.y == 0 ? 1e9 : reach.y);
    if (radius >= frame)
        return p;
    const float day0 = min(hull, .95 * frame / max(warp.scale, 1));
    const float today = warp.scale * day0;
    const float moved = radius <= today ? radius / warp.scale : day0 + (radius - today) * (frame - day0) / (frame - today);
    return warp.center + offset * (moved / radius);
}

float warp_asinh(float x) { return log(x + sqrt(x * x + 1)); } // x >= 0

vec2 warp_grid(WarpHeader warp, vec2 p)
{
    const vec2 offset = p - warp.center;
    const vec2 side = mix(vec2(-1), vec2(1), greaterThanEqual(offset, vec2(0)));
    const vec2 reach = (1 - side * warp.center) / warp.grid_epsilon;
    const vec2 away = abs(offset) / warp.grid_epsilon;
    const vec2 t = side * vec2(warp_asinh(away.x) / warp_asinh(reach.x), warp_asinh(away.y) / warp_asinh(reach.y));
    const uvec2 cell = uvec2(clamp((t + 1) * float(warp.count / 2), vec2(0), vec2(warp.count - 2)));

    const uint columns = warp.first + cell.x, rows = warp.first + cell.y;
    const vec2 low = vec2(warp_values[columns].x, warp_values[rows].y);
    const vec2 high = vec2(warp_values[columns + 1].x, warp_values[rows + 1].y);
    const vec2 f = (p - low) / (high - low);
    const uint node = warp.first + warp.count + cell.y * warp.count + cell.x;
    const vec2 above = mix(warp_values[node], warp_values[node + 1], f.x);
    const vec2 below = mix(warp_values[node + warp.count], warp_values[node + warp.count + 1], f.x);
    return mix(above, below, f.y);
}

vec2 warp_steps(WarpHeader warp, vec2 p)
{
    uint value = warp.first;
    for (uint step_index = 0; step_index < warp.steps; ++step_index) {
        vec2 moved = warp_values[value] + warp_values[value + 1] * p.x + warp_values[value + 2] * p.y;
        value += 3;
        for (uint i = 0; i < warp.count; ++i, value += 2) {
            const vec2 offset = p - warp_values[value];
            const float squared = dot(offset, offset);
            moved += warp_values[value + 1] * (squared * log(squared + 1e-30)); // 1e-30 makes 0 log 0 equal 0
        }
        p += moved;
    }
    return p;
}

/// `model` should be a specialisation constant, so that the other models are not compiled in.
vec2 warp_backward(uint model, WarpHeader warp, vec2 p)
{
    if (model == WARP_RADIAL)
        return warp_radial(warp, p);
    if (model == WARP_GRID)
        return warp_grid(warp, p);
    return warp_steps(warp, p);
}
