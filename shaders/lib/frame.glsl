// Orthonormal frames from interpolated normals and tangents, which may have any length.
#ifndef LIB_FRAME_GLSL
#define LIB_FRAME_GLSL

vec3 normalize_or(vec3 v, vec3 otherwise)
{
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!(largest > 1e-30 && largest < 1e30))
        return otherwise;
    v /= largest; // so that the squares neither underflow nor overflow
    return v * inversesqrt(dot(v, v));
}

// A unit vector perpendicular to the unit vector n; Duff et al. 2017, "Building an orthonormal basis,
// revisited".
vec3 across(vec3 n)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    return vec3(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

// Columns: tangent, bitangent, normal. tangent.w is the bitangent's sign (glTF). A zero tangent, or one along
// the normal, gives an arbitrary rotation, which matters only for an anisotropic slope.
mat3 frame_of(vec3 normal, vec4 tangent)
{
    vec3 n = normalize_or(normal, vec3(0.0, 0.0, 1.0));
    vec3 t = normalize_or(tangent.xyz, n);
    t -= n * dot(n, t);
    t = dot(t, t) > 1e-6 ? normalize(t) : across(n);
    return mat3(t, cross(n, t) * (tangent.w < 0.0 ? -1.0 : 1.0), n);
}

// A normal-mapped normal may face away from the viewer of the visible surface. This bends it back to the
// horizon, where reflection is dim but not cut off. n, to_viewer: unit.
const float LEAST_FACING = 0.01;
vec3 bend_to_viewer(vec3 n, vec3 to_viewer)
{
    float cosine = dot(n, to_viewer);
    return cosine >= LEAST_FACING ? n : normalize_or(n + (LEAST_FACING - cosine) * to_viewer, to_viewer);
}

#endif
