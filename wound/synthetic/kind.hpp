// A kind of generated wound. Each kind is one file beside this one, which defines the function that makes it;
// kinds.cpp holds the table of all kinds.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "wound/depth.hpp"
#include "wound/healing/healing.hpp"
#include "wound/synthetic/noise.hpp"

namespace wound {

/// How a kind closes when a scene does not say it.
struct Course
{
    Healing healing;          // of a wound `width_mm` wide on soft tissue
    double width_mm = 30;     // longer side
    double size_exponent = 0; // healing takes (width / width_mm)^size_exponent times as long
    double over_bone = 1;     // factor on the time where little soft tissue lies over the bone
};

class TissuePainter;
struct Place;
struct Tissue;

struct WoundKind
{
    const char* name;
    float raggedness; // factor on the border's deviation from a smooth line; 1: torn, 0: cut with a knife
    /// Signed distance to the smooth shape, before its border is bent and torn, at `p` mm from the middle;
    /// mm, positive inside. Must stay within 20 mm of the middle.
    float (*shape)(std::uint32_t seed, cv::Point2f p);
    /// The open bed at a place.
    Tissue (*bed)(const TissuePainter& painter, const Place& place);
    /// Changes the skin beside the wound, in addition to `inflamed` and `smeared`; null: not at all.
    void (*beside)(const TissuePainter& painter, Tissue& skin, const Place& place) = nullptr;
    float clot = 0, fibrin = 0; // shares of the bed for TissuePainter::lay_clot() and lay_fibrin(), 0..1
    float inflamed = 1;         // strength of the red halo
    float swollen_mm = .3f;     // height of the swollen rim
    float smeared = 0;          // strength of blood that ran or was wiped over the skin beside it
    Course course;
};

/// All kinds.
const std::vector<WoundKind>& wound_kinds();
/// Their names, in the same order.
const std::vector<std::string>& kind_names();
/// The kind of that name, which must be one of kind_names().
const WoundKind& kind_named(std::string_view name);
/// The kind's course for a wound of that longer side (mm, > 0) in that tissue.
Healing usual_healing(const WoundKind& kind, double width_mm, const TissueThickness& tissue);

// ---- For the kinds' files
// ----------------------------------------------------------------------------------

/// A number from `low` to `high` that depends on the seed and on `index`, a different one for each use.
float vary(std::uint32_t seed, int index, float low, float high);
/// Turned counter-clockwise in the plane (x right, y up); angle in radians.
cv::Point2f turned(cv::Point2f p, float angle);
/// Distance to an ellipse about the origin, mm, positive inside; exact on the outline, first order near it.
float ellipse(cv::Point2f p, float a, float b);
/// Distance to a tear from `from` to `to` whose half-width falls from `wide` to `narrow`, mm, positive
/// inside.
float tear(cv::Point2f p, cv::Point2f from, cv::Point2f to, float wide, float narrow);
/// Union with the inner corner rounded over about k mm (Quilez 2013, polynomial smooth maximum).
float merge(float a, float b, float k);

} // namespace wound
