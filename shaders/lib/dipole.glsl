// The dipole of Jensen, Marschner, Levoy & Hanrahan 2001, "A practical model for subsurface light transport", eq. (4). In
// double precision: optics::DipoleSources (wound/optics/dipole.hpp).
#ifndef LIB_DIPOLE_GLSL
#define LIB_DIPOLE_GLSL
#include "shared/chang.h"

// Flux through the surface from a source at distance z from it. r2: along the surface.
vec3 flux_from(vec3 transport, vec3 z, float r2)
{
    vec3 square = r2 + z * z, d = sqrt(square);
    return z * (1.0 + transport * d) * exp(-transport * d) / (12.5663706143592 * square * d);
}

// Per mm^2: of light that enters at a point and leaves somewhere, the share that leaves at this distance.
vec3 dipole_share(Dipole dipole, float r2)
{
    return dipole.per_total * (flux_from(dipole.transport, dipole.depth, r2) + flux_from(dipole.transport, dipole.image, r2));
}

#endif
