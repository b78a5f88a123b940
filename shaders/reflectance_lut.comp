// Computes one texel of the reflectance table: the tissue's colour for an injury depth (column) and a day
// (row).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/reflectance_lut.h"
#include "lib/reflectance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int MODEL = REFLECTANCE_TWO_STREAM;

layout(scalar, set = 0, binding = 0) uniform Parameters { LutParameters parameters; };
layout(scalar, set = 0, binding = 1) readonly buffer Layers { LutLayer layers[]; };
layout(scalar, set = 0, binding = 2) readonly buffer Bands { LutBand bands[]; };   // grouped by layer
layout(scalar, set = 0, binding = 3) readonly buffer Weights { mat3 weights[]; };  // per band: channels -> RGB
layout(scalar, set = 0, binding = 4) readonly buffer Days { LutDay days[]; };
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D lut_out;

const uint FIRST_INTACT = 2;

// Layer i of the day's list for an injury `injury_mm` deep; `removed_mm` is the thickness still to be
// removed. Same as layers_at in wound/optics/healing_tissue.cpp.
LutLayer layer_at(uint base, uint i, LutDay day, float injury_mm, inout float removed_mm)
{
    LutLayer layer = layers[base + i];
    if (i == 0)
        layer.thickness_mm = min(layer.thickness_mm, injury_mm);
    else if (i == 1)
        layer.thickness_mm = day.regrown_ratio * injury_mm;
    if (i < FIRST_INTACT)
        return layer;
    float whole = layer.thickness_mm, taken = min(removed_mm, whole);
    removed_mm -= taken;
    layer.thickness_mm = whole - taken;
    // The paper's equations get every layer's own index.
    if (MODEL > REFLECTANCE_PUBLISHED && i + 1 < parameters.layers_per_day && layer.thickness_mm > 0.0)
        layer.n = mix(layers[base + i + 1].n, layer.n, min(4.0 * layer.thickness_mm / whole, 1.0));
    return layer;
}

// Reflectance of the day's tissue at the three channels of a band, without the reflection at the first
// surface.
vec3 reflect_band(uint band, uint base, LutDay day, float injury_mm)
{
    float removed_mm = min(day.missing_ratio + day.regrown_ratio, 1.0) * injury_mm;
    float n_first = parameters.n_above, n = parameters.n_above;
    Element stack = Element(vec3(0.0), vec3(0.0), vec3(1.0), vec3(1.0));
    vec3 paper_sum = vec3(0.0), incoming = vec3(1.0);
    LutLayer pending; // the paper's equations need the next layer's index: they run one layer late
    LutBand pending_optics;
    bool any_layer = false;
    for (uint i = 0; i <= parameters.layers_per_day; ++i) {
        bool end = i == parameters.layers_per_day;
        LutLayer layer;
        LutBand optics;
        if (!end) {
            layer = layer_at(base, i, day, injury_mm, removed_mm);
            if (layer.thickness_mm <= 0.0 && i + 1 < parameters.layers_per_day)
                continue;
            optics = bands[(base + i) * parameters.bands + band];
        }
        float n_next = end ? parameters.n_below : layer.n;
        if (MODEL >= REFLECTANCE_TWO_STREAM_PAPER) {
            stack = over(stack, boundary(n, n_next));
            if (!end)
                stack = over(stack, tissue_slab(MODEL, optics.sigma_a, optics.sigma_s_reduced, layer.g, layer.thickness_mm));
        } else if (any_layer) {
            vec3 reflected, transmitted;
            paper_layer(MODEL, pending_optics.sigma_a, pending_optics.sigma_s_reduced * backward_fraction(pending.g),
                        pending.thickness_mm, diffuse_fresnel(n, n_next), reflected, transmitted);
            paper_sum += incoming * reflected;
            incoming *= transmitted;
        }
        if (!any_layer)
            n_first = n_next;
        any_layer = true;
        n = n_next;
        pending = layer;
        pending_optics = optics;
    }
    return MODEL >= REFLECTANCE_TWO_STREAM_PAPER ? stack.r_top - diffuse_fresnel(parameters.n_above, n_first)
                                     : paper_top_factor(MODEL, parameters.n_above, n_first) * paper_sum;
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(lut_out);
    if (any(greaterThanEqual(texel, size)))
        return;
    float injury_mm = lut_value(texel.x, size.x, parameters.axes.deepest_mm);
    vec3 color = vec3(0.0);
    for (uint band = 0; band < parameters.bands; ++band)
        color += weights[band] * reflect_band(band, texel.y * parameters.layers_per_day, days[texel.y], injury_mm);
    imageStore(lut_out, texel, vec4(displayable(color), 1.0));
}
