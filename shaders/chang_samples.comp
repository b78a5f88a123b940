#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Chang et al. 2008, "Real-time translucent rendering using GPU-based texture space importance sampling": samples of the
// skin, the same for all pixels, by the warping of even numbers down the pyramid of importance.
#include "lib/chang.glsl"

layout(local_size_x = 64) in;
layout(binding = 2) uniform sampler2D levels[CHANG_LEVELS]; // from the finest; the coarsest ones may be one texel
layout(binding = 3, rgba32f) uniform writeonly image2D sample_places; // mm
layout(binding = 4, rgba32f) uniform writeonly image2D sample_lights; // mm^2 x light: E A / (N p)

// Chooses one of 16 parts; `chance` is the probability so far, `number` even between 0 and 1.
void choose(float parts[16], inout float number, inout float chance, inout ivec2 cell)
{
    float sum = 0;
    for (int i = 0; i < 16; ++i)
        sum += parts[i];
    float left = number * sum;
    int chosen = 0;
    for (int i = 0; i < 16; ++i)
    {
        if (parts[i] <= 0)
            continue;
        chosen = i;
        if (left < parts[i])
            break;
        left -= parts[i];
    }
    number = clamp(left / max(parts[chosen], 1e-30), 0.0, 0.9999999);
    chance *= parts[chosen] / max(sum, 1e-30);
    cell = 4 * cell + ivec2(chosen & 3, chosen >> 2);
}

// A macro, because lavapipe reads nothing from an array of textures by an index that is not constant.
#define DESCEND(k)                                                                                            \
    for (int i = 0; i < 16; ++i)                                                                              \
    {                                                                                                         \
        const ivec2 at = 4 * cell + ivec2(i & 3, i >> 2);                                                     \
        parts[i] = all(lessThan(at, textureSize(levels[k], 0))) ? texelFetch(levels[k], at, 0).r : 0.0;       \
    }                                                                                                         \
    choose(parts, number, chance, cell);

void main()
{
    const int n = int(gl_GlobalInvocationID.x);
    if (n >= CHANG_SAMPLES)
        return;
    float number = (float(n) + 0.5) / float(CHANG_SAMPLES), chance = 1;
    ivec2 cell = ivec2(0);
    float parts[16];
    DESCEND(5) DESCEND(4) DESCEND(3) DESCEND(2) DESCEND(1) DESCEND(0)
    for (int i = 0; i < 16; ++i)
        parts[i] = importance(4 * cell + ivec2(i & 3, i >> 2));
    choose(parts, number, chance, cell);
    const vec4 place = texelFetch(home, cell, 0);
    const vec3 light = place.a > 0 ? texelFetch(irradiance, cell, 0).rgb * place.a / (float(CHANG_SAMPLES) * max(chance, 1e-20))
                                   : vec3(0);
    imageStore(sample_places, ivec2(n, 0), place);
    imageStore(sample_lights, ivec2(n, 0), vec4(light, 0));
}
