// Linear light and its sRGB encoding (IEC 61966-2-1). There is no film curve, because skin must keep the colour
// that the optics gave it: only values above the knee are compressed.
#ifndef LIB_COLOR_GLSL
#define LIB_COLOR_GLSL

// For 0..1. Two square roots are cheaper than a power on a software rasteriser: our fit to 1.055 x^(1/2.4) - 0.055 of
// least largest error, 3.5e-5 or .009 of an 8-bit code.
vec3 srgb_from_linear(vec3 linear)
{
    vec3 root = sqrt(linear), fourth = sqrt(root);
    vec3 power = root * (1.12268198 - 0.335501831 * fourth) + 0.196135694 * fourth + 0.0813300388 * linear - 0.0646115099;
    return mix(min(power, 1.0), 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 linear_from_srgb(vec3 encoded)
{
    vec3 power = pow((max(encoded, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4));
    return mix(power, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

// Clamps to the largest half float, so that a light at the surface does not give infinity in the target.
vec3 finite_radiance(vec3 linear) { return clamp(linear, 0.0, 65504.0); }

// Identity up to the knee, then a hyperbola towards 1 with equal slope at the knee; on a software rasteriser
// an exponential would cost as much as the encoding. Applied per channel, so that a bright highlight turns
// white as on film.
vec3 soft_shoulder(vec3 linear)
{
    const float knee = 0.8;
    vec3 over = max(linear - knee, 0.0) / (1.0 - knee);
    return min(linear, knee) + (1.0 - knee) * over / (1.0 + over);
}

#endif
