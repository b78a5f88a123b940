// Places wounds on a head: face coordinates and the wound's frame on the skin.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "head/bvh.hpp"
#include "head/model.hpp"

namespace head {

/// The face coordinates of a mesh: origin at the tip of the nose, y up, x to the viewer's right; the unit is
/// the height from the tip of the nose to the crown (about 0.14 m).
struct FaceFrame
{
    glm::dvec3 nose_tip{0.0};
    double unit_m = 1.0;
};
FaceFrame find_face(const Model& head);

/// A point in face coordinates.
struct FacePoint
{
    double x = 0, y = 0;
    bool operator==(const FacePoint&) const = default;
};
/// The name of a place, face coordinates, or a point in the head's coordinates (metres).
using Place = std::variant<std::string, FacePoint, glm::dvec3>;

/// The named places and their face coordinates.
struct NamedPlace
{
    const char* name;
    FacePoint at;
};
std::vector<NamedPlace> named_places();
/// The face coordinates of a place, if they do not depend on the head; none for a point in metres or an
/// unknown name.
std::optional<FacePoint> known_face_point(const Place& place);

/// An orthonormal frame on the skin. The patch's texel (u right, v down) maps to centre + half_width (u right
/// + v down).
struct Anchor
{
    /// Largest distance from the patch's plane, in half widths, at which skin still receives the wound: it
    /// includes the side of the nose but not the opposite cheek.
    static constexpr double reach = 0.9;

    glm::dvec3 centre{0.0}, right{1, 0, 0}, down{0, -1, 0}, normal{0, 0, 1};
    double half_width_m = 0.02; // of the patch
    FacePoint face;             // the centre in face coordinates
    bool operator==(const Anchor&) const = default;
};

/// Places a patch of `patch_width_mm` at `place`, rotated by `roll_deg` counter-clockwise as seen by the
/// viewer. The patch's normal is the mean normal of the skin around `place`, not that of one triangle.
/// `solid`: the hierarchy of the head's solid triangles. Throws base::InputError (naming `where`) when the
/// place is not on the head.
Anchor anchor_wound(const Model& head, const Bvh& solid, const FaceFrame& face, const Place& place,
                    double patch_width_mm, double roll_deg, const std::string& where);

/// Places a further wound of the same photograph: `offset_m` (right, down) from the centre of `first`,
/// projected onto the head along the normal of `first`, with the same rotation. Throws base::InputError
/// (naming `where`) when there is no skin.
Anchor anchor_beside(const Model& head, const Bvh& solid, const FaceFrame& face, const Anchor& first,
                     const glm::dvec2& offset_m, double patch_width_mm, const std::string& where);

/// Transforms a point of the head to the anchor's frame: x along `right`, y along `down`, z above the patch's
/// plane, in half widths.
glm::dvec3 in_frame(const Anchor& anchor, const glm::dvec3& point);

/// True when the triangle may receive the anchor's projection: its bounds overlap the patch's box.
bool receives(const Anchor& anchor, const std::array<glm::vec3, 3>& corners);

} // namespace head
