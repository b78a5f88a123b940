// What a smooth boundary between two media does to light that meets it, and how much of a scattering event
// goes backward.
#pragma once

namespace optics {

/// Fresnel reflectance for unpolarised light that meets the boundary at `cos_incidence` (0..1), coming from
/// `n_from`.
double fresnel(double n_from, double n_to, double cos_incidence);

/// Diffuse Fresnel reflectance F_dr: the cosine-weighted mean over the hemisphere, in closed form (optics.md,
/// eq. F1).
double diffuse_fresnel(double n_from, double n_to);

/// The same by the polynomial the paper takes from Groenhuis, Ferwerda & ten Bosch 1983 (optics.md, eq. F3):
/// good to .0016 for light inside a medium up to 2 times as dense as the outside; .0016 instead of 0 at equal
/// indices.
double diffuse_fresnel_polynomial(double n_from, double n_to);

/// P(g): the part of the Henyey-Greenstein phase function in the backward half space; stable for every g in
/// [-1, 1].
double backward_fraction(double g);

} // namespace optics
