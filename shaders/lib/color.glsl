// Linear light and its sRGB encoding (IEC 61966-2-1, exact piecewise form). No film curve: skin must keep the colour the
// optics gave it, so everything up to a knee is exposure and sRGB alone, and only what lies above rolls off.
#ifndef LIB_COLOR_GLSL
#define LIB_COLOR_GLSL

vec3 srgb_from_linear(vec3 linear)
{
    vec3 power = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(power, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 linear_from_srgb(vec3 encoded)
{
    vec3 power = pow((max(encoded, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4));
    return mix(power, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

// The largest value a half-float target holds; a light at the surface must not become infinite there.
vec3 finite_radiance(vec3 linear) { return clamp(linear, 0.0, 65504.0); }

// Identity up to the knee, then towards 1 without reaching it, with the same slope at the knee; a hyperbola, because an
// exponential costs a software rasteriser as much again as the encoding. Channel by channel, so that a bright highlight
// turns white as on film.
vec3 soft_shoulder(vec3 linear)
{
    const float knee = 0.8;
    vec3 over = max(linear - knee, 0.0) / (1.0 - knee);
    return min(linear, knee) + (1.0 - knee) * over / (1.0 + over);
}

#endif
