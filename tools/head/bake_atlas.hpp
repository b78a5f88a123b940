// Layout of the figure's skin charts in the head's skin picture, and the painting of that picture.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "tools/head/bake_bust.hpp"

namespace head_tool {

/// An affine map from the figure's texture coordinates (v up) to those of our picture (0..1, v down).
struct Placement
{
    glm::dmat2 linear{1.0};
    glm::dvec2 offset{0.0};
    glm::dvec2 operator()(glm::dvec2 uv) const { return linear * uv + offset; }
};

/// For the figure's own pictures: only flips v.
inline const Placement as_painted{glm::dmat2(1, 0, 0, -1), glm::dvec2(0, 1)};

/// The head's chart fills the picture's height on the left, the bust's chart, turned upright, the right part.
/// Both have the same scale.
struct SkinAtlas
{
    int size = 0; // px, width and height
    Placement head, bust;
    double border = 0; // u between the two charts
};

SkinAtlas lay_out_skin(const CutMesh& bust, int size);

/// Draws the parts of the figure's painted skin that the atlas contains. Fills blank areas from their
/// surroundings and reduces the blue of painted lids.
cv::Mat3b paint_skin(const SkinAtlas& atlas, const cv::Mat3b& painting);

} // namespace head_tool
