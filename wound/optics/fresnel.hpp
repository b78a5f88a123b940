// Fresnel reflection at a smooth boundary between two media, and the backward part of the phase function.
#pragma once

namespace optics {

/// Fresnel reflectance for unpolarised light that comes from `n_from` at `cos_incidence` (0..1).
double fresnel(double n_from, double n_to, double cos_incidence);

/// Diffuse Fresnel reflectance F_dr: the cosine-weighted mean over the hemisphere, in closed form (optics.md,
/// eq. F1).
double diffuse_fresnel(double n_from, double n_to);

/// F_dr by the polynomial that the paper takes from Groenhuis, Ferwerda & ten Bosch 1983 (optics.md, eq. F3):
/// error at most .0016 for light inside a medium whose index is up to 2 times that outside; returns .0016
/// instead of 0 for equal indices.
double diffuse_fresnel_polynomial(double n_from, double n_to);

/// The phase function of Henyey & Greenstein 1941 per steradian: its integral over the sphere is 1. `cosine`
/// of the deflection; g within -1..1.
double henyey_greenstein(double g, double cosine);

/// P(g): the part of the Henyey-Greenstein phase function in the backward half space; stable for every g in
/// [-1, 1].
double backward_fraction(double g);

/// Cosine of the deflection by the same phase function (Henyey & Greenstein 1941); `u` in 0..1, g within
/// +-.99.
double henyey_greenstein_cosine(double g, double u);

} // namespace optics
