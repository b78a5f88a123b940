// How light that enters skin leaves it again: the models of Transport for one light at one point, in double
// precision. shaders/lib/transport.glsl is the float version; a test compares the two.
//
// `preintegrated` (E. Penner 2011, "Pre-integrated skin shading"; J. Jimenez et al. 2010, "Real-time
// realistic skin translucency") knows of the surroundings of a point only how strongly they bend. Penner's
// table over n.l and curvature is a closed form here, because the profile of a medium has one shape and one
// width:
//
// - Light spreads by Burley's profile (Christensen & Burley 2015), of width d: within r leaves
//   1 - e^(-r/d) / 4 - 3 e^(-r/3d) / 4 of the light. In our own walk d is the diffuse albedo times the mean
//   free path between two scatterings, within 9 % for albedos of .07 to .7. So a point's width follows from
//   its own albedo and one length of the tissue, as in the reference.
// - What a ball returns depends on the cosine, on d x curvature and, by a factor, on the albedo: a hyperbola, fitted to
//   random walks in balls within .023 of full light up to d x curvature .1 (a nose's tip in red light is at .05).
//   Penner wraps the profile of a plane round the ball and normalises it. That misses what a convex body returns
//   more than a plane, since light that would go deep comes out at the other side: 12 to 20 % at .05.
// - A slab passes e^(-t/3d) of a lamp's light.
// - Of light from all around, a slab of thickness t returns and passes to a side together (A + e) / (1 + A e), where a half
//   space returns the albedo A: two fluxes (Kubelka & Munk 1931), e = e^(-t (1 - A^2.5) / 3d). That is everything at t = 0
//   and A for a thick slab, and between them that of random walks within .014. (Where light scatters often it reaches
//   deeper than 3d: hence A^2.5, a fit.)
//
// `diffused` (E. d'Eon, D. Luebke, E. Enderton 2007, "Efficient rendering of human skin"; P. Christensen, B.
// Burley 2015, "Approximate reflectance profiles for efficient subsurface scattering") takes the light that a
// point returns from all that its surroundings on the skin receive, by the same profile of distances in
// space, times the point's own albedo. passes/diffusion.hpp does that. At one point it knows what a half
// space receives.
//
// `separable` and `burley` spread the light in the picture (passes/screen_diffusion.hpp). At one point they
// know what is lit, and what passes a thin part: the share of the profile that lies farther away than its
// thickness (Jimenez 2010; Golubev 2018), of light that falls on the far side as this side turns away from it.
#pragma once
#include <array>
#include <limits>

#include "shaders/shared/skin.h"
#include "wound/optics/shading.hpp"
#include "wound/optics/tissue.hpp"

namespace optics {

/// Mean free path between two scatterings, mm, in the homogeneous isotropic medium that has the tissue's
/// diffuse albedo and spreads light as far: mean radius of its profile / (2.5 albedo), 2.5 d being the mean
/// radius of Burley's. By a short photon walk, some tenths of a second; tissues met before are remembered. 0
/// where a channel returns no light. Throws as check_walk_cost() does.
base::Color scattering_length_mm(const SkinLayers& tissue);

/// The same, and d of Burley's profile of the tissue itself, that length times its albedo.
struct TissueSpread
{
    base::Color scattering_length_mm{0, 0, 0}, width_mm{0, 0, 0};
    bool operator==(const TissueSpread&) const = default;
};
TissueSpread tissue_spread(const SkinLayers& tissue);

/// d of Burley's profile, in the length's unit.
double diffusion_width(double albedo, double scattering_length);

/// Share of the light that leaves within this radius of where it entered, by Burley's profile; same unit.
double left_within(double radius, double width);

/// Points around the origin, in widths of the profile: x, y, and radius / (e^-radius + e^(-radius/3)), the
/// weight with which a profile is integrated over them. Their radii cut the light into equal shares.
const std::array<cv::Vec3d, shared::DIFFUSION_TAPS>& diffusion_taps();

/// Light that a ball returns where its normal and the direction of the light enclose this cosine, over
/// bend_gain() and what a plane that faces the light returns. `turn`: width / radius, radians; above .25 it
/// counts as .25.
double received_bent(double cosine, double turn);

/// What a ball returns of even light, over what a plane does; below 1 for a hollow, turn < 0. Beyond +-.25
/// turn counts as that.
double bend_gain(double albedo, double turn);

/// What a shadow's edge becomes when light spreads under it. `visibility`: by a filter of half width
/// `filter`, of which it is taken for a linear ramp. Exactly 0 and 1 where the filter ends.
double softened(double visibility, double width, double filter);

/// Share of the light that passes tissue of this thickness; in the unit of the width.
double passed(double thickness, double width);

/// Of even light from all around: what comes through a slab that it lights on both sides, beyond what a half space returns,
/// over that. In the unit of the width.
double surroundings_passed(double albedo, double thickness, double width);

/// What leaves of the surroundings' even light, over it and the albedo. `seen`: share of it that reaches the point. What
/// bends much is also thin: of what a bend adds (bend_gain()) and what passes, the larger counts.
base::Color surroundings_left(const Shading& shading, const ShadedPoint& point, const base::Color& seen);

/// Transport `oren-nayar`, over Lambert's value for the same albedo: the layered base of Y. Gotanda 2012, "Beyond
/// a simple physically based Blinn-Phong model in real-time". The course's own layer equations are not public; this
/// is our reading: M. Oren & S. Nayar 1994, "Generalization of Lambert's reflectance model", eq. (30) with the
/// .57 of its footnote, times (1 - F(i)) (1 - F(o)) of the gloss, each over its cosine-weighted mean, so that
/// smooth facets return all of even light. i, o: unit, to light and viewer, in the normal's frame; 0 for a light
/// below the horizon. sigma: rad, standard deviation of the facets' tilt.
double layered_oren_nayar(const cv::Vec3d& i, const cv::Vec3d& o, double sigma);

/// Share of a normal map's detail that is left after diffusion. Metres.
double detail_left(double width_m);

/// The diffuse light that leaves, over the strength of the light. `incident`: unit, to the light, in the
/// frame of the shaded normal.
base::Color leaving(const Shading& shading, const ShadedPoint& point, const cv::Vec3d& to_light,
                    const cv::Vec3d& incident, double visibility, const ShadowMap& map);

} // namespace optics
