#include "apps/figure/figures.hpp"

#include <array>
#include <cctype>
#include <string_view>

namespace figure_command {
namespace {

constexpr std::array<Figure, 10> figures{{
    {"1", "Control points and warp",
     "The wound's image (a), its border with the control points where evenly spaced lines cross it (b), "
     "their "
     "shift towards the centre (c), and the warped wound (d).",
     "The same stages of one run, from the segmented photograph of a generated wound on, and what becomes of "
     "them: depth, reflectance and the shaded wound, all as published.",
     draw_control_points},
    {"2", "The phase function and its halves",
     "Light scattered out of and into a ray (a), and the phase function integrated over the forward and the "
     "backward half (b).",
     "Henyey and Greenstein's function at the three g of Table 1, and its halves by numerical integration, "
     "which agree with the closed form of P(g) that the program uses.",
     draw_phase_function},
    {"3", "Reflectance and transmission in layers",
     "A diagram of the light returned by scattering, R1 and R2, and by the bottom, Rdr, and of the "
     "transmitted "
     "T, in one layer (a) and in several (b).",
     "The same diagram with the numbers of eqs. (2) and (3) for Table 1; the totals below show how far the "
     "published sum is from radiative transfer, and that our default is near it.",
     draw_layers},
    {"4", "Scaling against warping",
     "A wound contracted by 60 % by scaling its image (a), and by the weighted warp (b), which keeps the "
     "border's shape and visibly pulls the skin.",
     "The same at r = 0.4 with the generated wound, with border, control points and the skin's grid: scaling "
     "shrinks the skin too, the warp only moves it.",
     draw_contraction},
    {"5", "Depth by day",
     "Cross-sections in which red dots and black lines mark the wound's depth, which shrinks from day 0 "
     "until "
     "the skin is normal.",
     "The profile through the centroid in millimetres on eight days, and its deepest point beside depth x "
     "sqrt r; the paper gives no scale, and a swollen rim is ours.",
     draw_depth},
    {"6", "Colour by recovery",
     "The colour alone, without the change of shape, as the recovery rate grows: it converges to the skin's.",
     "Eq. (4) as printed and in our form: the printed one stops short of the skin at r = 1, ours ends at it; "
     "the chart shows by how much.",
     draw_recovery},
    {"7", "The far side of the nose",
     "A face lit from the right by (a) Ward, (b) layered Oren-Nayar, (c) Chang's BSSRDF and (d) the proposed "
     "shading; the nose's far side, circled, is black in (a) and (b) and lit in (c) and (d).",
     "(a) and (d) by the published equations, and (e) our default, whose light there comes from the "
     "surroundings alone; (b) and (c) are other systems that Cicatrix does not have yet.",
     draw_shading},
    {"8", "Cheek and eyebrow on days 0, 10 and 12",
     "Wounds on the cheek (a) and above the eyebrow (b) on day 0 and after 10 and 12 days, with the light "
     "moved.",
     "The same places and days with generated wounds, as published and by our default under the same lights; "
     "the paper does not give its healing curve, and by ours, of a human face, 31 % is open on day 12.",
     draw_recovery_on_face},
    {"9", "Two wounds on the chin", "The healing of two wounds of different shape and colour on the chin.",
     "Two generated wounds on the chin on the days of Figure 8 under one light, as published and by our "
     "default.",
     draw_chin},
    {"frame-rate", "Frame rates, section 6.4",
     "Frames per second of seven systems on a GeForce GTX 580: the proposed one, 114, costs less than 2 % "
     "over "
     "Ward's, 115 to 116, and BSSRDF methods stay below 35.",
     "The published shading, Lambert and Ward alone, and our default, drawn in turn on this device; only "
     "their "
     "ratios can be compared with the paper's. The other systems are not in Cicatrix yet.",
     draw_frame_rate},
}};

} // namespace

std::string Figure::stem() const
{
    return std::string_view(name) == "frame-rate" ? "frame_rate" : std::string("figure_") + name;
}

std::string Figure::heading() const
{
    return std::isdigit(name[0]) ? std::string("Figure ") + name : "Frame rate";
}

std::span<const Figure> all_figures()
{
    return figures;
}

} // namespace figure_command
