// Where on a head a wound sits: the face's own coordinates and the wound's frame on the skin.
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

/// The face's coordinates, found from the mesh: origin at the tip of the nose, y up, x to the right of
/// somebody who looks at the face; the unit is the height from the tip of the nose to the crown (about 0.14
/// m).
struct FaceFrame
{
    glm::dvec3 nose_tip{0.0};
    double unit_m = 1.0;
};
FaceFrame find_face(const Model& head);

/// A named place, face coordinates, or a point in the head's own metres.
struct FacePoint
{
    double x = 0, y = 0;
    bool operator==(const FacePoint&) const = default;
};
using Place = std::variant<std::string, FacePoint, glm::dvec3>;

/// The named places and their face coordinates.
struct NamedPlace
{
    const char* name;
    FacePoint at;
};
std::vector<NamedPlace> named_places();
/// The face coordinates of a place that can be told without the head; none for a point in metres or an
/// unknown name.
std::optional<FacePoint> known_face_point(const Place& place);

/// An orthonormal frame on the skin. The patch's texel (u right, v down) maps to centre + half_width (u right
/// + v down).
struct Anchor
{
    /// How far from the patch's plane skin may lie and still receive the wound, in half widths: a nose's
    /// flank, not the far cheek.
    static constexpr double reach = 0.9;

    glm::dvec3 centre{0.0}, right{1, 0, 0}, down{0, -1, 0}, normal{0, 0, 1};
    double half_width_m = 0.02; // of the patch
    FacePoint face;             // the centre in face coordinates
    bool operator==(const Anchor&) const = default;
};

/// Puts a patch of `patch_width_mm` at `place`, turned by `roll_deg` counter-clockwise as the viewer sees it.
/// The normal is the mean over the footprint, so that the patch lies on the skin rather than on one triangle
/// of it. `solid`: the hierarchy of the head's solid triangles. Throws base::InputError (naming `where`) when
/// the place is not on the head.
Anchor anchor_wound(const Model& head, const Bvh& solid, const FaceFrame& face, const Place& place,
                    double patch_width_mm, double roll_deg, const std::string& where);

/// Puts a patch where it lies beside `first` in one photograph: `offset_m` (right, down) from the first's
/// centre, projected along its normal onto the head, and turned as the first. Throws base::InputError
/// (naming `where`) when there is no skin.
Anchor anchor_beside(const Model& head, const Bvh& solid, const FaceFrame& face, const Anchor& first,
                     const glm::dvec2& offset_m, double patch_width_mm, const std::string& where);

/// A point of the head in the anchor's frame: x along `right`, y along `down`, z above the patch's plane, in
/// half widths.
glm::dvec3 in_frame(const Anchor& anchor, const glm::dvec3& point);

/// True when the triangle can receive the anchor's projection: it overlaps the patch's box and faces it.
bool receives(const Anchor& anchor, const std::array<glm::vec3, 3>& corners);

} // namespace head
