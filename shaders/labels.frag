#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Labels of a pixel for training or testing measuring programs: kind of surface, number and depth of the
// wound, distance, and the area of the wound's surface in the pixel. See passes/labels.hpp.
#include "lib/frame.glsl"
#include "lib/wound_projection.glsl"
#include "shared/labels.h"

layout(constant_id = 0) const uint WOUNDS = 0; // number of projected wounds, at most WOUNDS_HERE
layout(constant_id = 1) const uint SURFACE = LABEL_SKIN;

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;
layout(location = 0) out vec2 out_kind;     // LABEL_..., number of the wound from 1 (0: none); both / 255
layout(location = 1) out vec4 out_measures; // depth, distance in mm; mm2 of open bed, mm2 inside border

layout(scalar, binding = 1) uniform LabelCamera_ { LabelCamera camera; };
layout(scalar, binding = 2) uniform Wounds_ { WoundFrame wounds[WOUNDS_HERE]; };
layout(binding = 3) uniform sampler2D wound_state[WOUNDS_HERE];
layout(binding = 4) uniform sampler2D wound_relief[WOUNDS_HERE];

struct Seen
{
    uint wound; // number from 1; 0: none
    float bed, inside; // shares of the pixel's surface, 0..1: open bed, inside the outer border
    float depth_mm;
};

// Of overlapping wounds chooses the one that covers more; at equal coverage the later one, which is drawn on
// top.
void see_wound(WoundFrame w, sampler2D state_map, sampler2D relief_map, vec3 geometric, inout Seen seen)
{
    const WoundPlace place = project_wound(w, v_position, geometric);
    if (place.facing <= 0)
        return;
    const vec4 state = textureLod(state_map, place.uv, 0);
    const float bed = state.b * place.facing, inside = max(state.a, state.b) * place.facing;
    if (inside > 0 && inside >= seen.inside)
        seen = Seen(w.number, bed, inside, textureLod(relief_map, place.uv, 0).a);
}

void main()
{
    const vec3 geometric = normalize_or(gl_FrontFacing ? v_normal : -v_normal, vec3(0, 0, 1));
    Seen seen = Seen(0, 0, 0, 0);
    [[unroll]] for (uint i = 0; i < WOUNDS_HERE; ++i)
        if (i < WOUNDS)
            see_wound(wounds[i], wound_state[i], wound_relief[i], geometric, seen);
    const uint kind = seen.bed >= 0.5 ? LABEL_OPEN_BED : seen.inside >= 0.5 ? LABEL_NEW_EPITHELIUM : SURFACE;
    out_kind = vec2(kind, seen.wound) / 255;

    // The pixel's area on the triangle: z^2 / (fx fy) on a plane parallel to the image, divided by the
    // cosine.
    const vec3 sight = v_position - camera.eye;
    const float z = dot(sight, camera.forward);
    const vec3 flat_normal = normalize_or(cross(dFdx(v_position), dFdy(v_position)), geometric);
    const float cosine = abs(dot(flat_normal, sight)) / z; // cos(normal, sight) / cos(sight, optical axis)
    const float surface_mm2 = 1e6 * z * z * camera.pixel_area / max(cosine, 0.02);
    out_measures = vec4(kind == SURFACE ? 0 : seen.depth_mm, 1e3 * z, surface_mm2 * seen.bed, surface_mm2 * seen.inside);
}
