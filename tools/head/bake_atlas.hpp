// Where the parts of the figure's skin lie in the head's own picture, and the painting of that picture.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "tools/head/bake_bust.hpp"

namespace head_tool {

/// An affine map from the figure's texture coordinates (v up) to a picture of ours (0..1, v down).
struct Placement
{
    glm::dmat2 linear{1.0};
    glm::dvec2 offset{0.0};
    glm::dvec2 operator()(glm::dvec2 uv) const { return linear * uv + offset; }
};

/// The figure's own pictures, kept as they are.
inline const Placement as_painted{glm::dmat2(1, 0, 0, -1), glm::dvec2(0, 1)};

/// The head's chart fills the picture's height on the left, the bust's, turned upright, the right; both at
/// the same scale.
struct SkinAtlas
{
    int size = 0; // px, both ways
    Placement head, bust;
    double border = 0; // u between the two
};

SkinAtlas lay_out_skin(const CutMesh& bust, int size);

/// Draws the parts of the figure's painted skin that the atlas shows. What the painter left blank is filled
/// in from around, and paint on the lids that no skin has is toned down.
cv::Mat3b paint_skin(const SkinAtlas& atlas, const cv::Mat3b& painting);

} // namespace head_tool
