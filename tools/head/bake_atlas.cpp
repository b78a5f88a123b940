#include "tools/head/bake_atlas.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tools/head/bake_texture.hpp"

namespace head_tool {
namespace {

struct Box
{
    glm::dvec2 low{1e9}, high{-1e9};
};

Box uv_box(const CutMesh& mesh, const std::vector<CutMesh::Triangle>& triangles)
{
    Box box;
    for (const CutMesh::Triangle& triangle : triangles)
        for (const CutMesh::Corner& corner : triangle) {
            box.low = glm::min(box.low, mesh.uvs[corner.uv]);
            box.high = glm::max(box.high, mesh.uvs[corner.uv]);
        }
    return box;
}

/// Draws the painting, mapped by `placement`, into columns `from` to `to` - 1 of `picture`.
void place(const cv::Mat3b& painting, const Placement& placement, int from, int to, cv::Mat3b& picture)
{
    const glm::dmat2 back = glm::inverse(placement.linear);
    const auto painted_at =
        [&](glm::dvec2 texel) { // the centre of texel x is (x + .5) / size in both pictures
            const glm::dvec2 uv =
                back * ((texel + 0.5) / glm::dvec2(picture.cols, picture.rows) - placement.offset);
            return glm::dvec2(uv.x, 1 - uv.y) * glm::dvec2(painting.cols, painting.rows) - 0.5;
        };
    const glm::dvec2 origin = painted_at({from, 0});
    const glm::dvec2 x = painted_at({from + 1, 0}) - origin, y = painted_at({from, 1}) - origin;
    const cv::Matx23d affine(x.x, y.x, origin.x, x.y, y.y, origin.y);
    cv::Mat target = picture(cv::Rect(from, 0, to - from, picture.rows));
    cv::warpAffine(painting, target, affine, target.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
}

/// Fills blank areas: texels surrounded by the colour of the painting's first corner, with a tolerance for
/// ringing from the enlargement.
void fill_blank(cv::Mat3b& picture, const cv::Vec3b& blank)
{
    constexpr int tolerance = 3, surroundings = 9; // of 255; px
    const cv::Scalar value(blank[0], blank[1], blank[2]), off = cv::Scalar::all(tolerance);
    cv::Mat1b is_blank;
    cv::inRange(picture, value - off, value + off, is_blank);
    const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(surroundings, surroundings));
    cv::morphologyEx(is_blank, is_blank, cv::MORPH_OPEN, disc);
    cv::dilate(is_blank, is_blank, disc); // also removes the frayed edge of the paint
    cv::Mat3f filled;
    picture.convertTo(filled, CV_32F);
    fill_uncovered(filled, ~is_blank);
    filled.convertTo(picture, CV_8U);
}

/// Skin always reflects less blue than red. Paint with too much blue keeps its luma and gets the colour of
/// skin.
void tone_down_blue(cv::Mat3b& picture)
{
    constexpr float skin[] = {1.21f, 0.96f, 0.82f}; // sRGB relative to luma
    constexpr float first = 0.76f, last = 0.87f;    // blue / red where toning begins and is complete
    for (cv::Vec3b& texel : picture) {
        const float red = texel[0], green = texel[1], blue = texel[2];
        const float share = std::clamp((blue / std::max(red, 1.0f) - first) / (last - first), 0.0f, 1.0f);
        const float luma = 0.299f * red + 0.587f * green + 0.114f * blue;
        for (int c = 0; c < 3; ++c)
            texel[c] = cv::saturate_cast<uchar>((1 - share) * texel[c] + share * luma * skin[c]);
    }
}

} // namespace

SkinAtlas lay_out_skin(const CutMesh& bust, int size)
{
    const Box head = uv_box(bust, bust.head), torso = uv_box(bust, bust.torso);
    const double margin = 6.0 / size;
    const double scale = (1 - 2 * margin) / std::max(head.high.y - head.low.y, torso.high.x - torso.low.x);
    SkinAtlas atlas;
    atlas.size = size;
    atlas.head.linear = scale * glm::dmat2(1, 0, 0, -1);
    atlas.head.offset = glm::dvec2(margin) - scale * glm::dvec2(head.low.x, -head.high.y);
    atlas.border = 2 * margin + scale * (head.high.x - head.low.x);
    atlas.bust.linear = scale * glm::dmat2(0, 1, 1, 0); // x grows with v (up), y with u: a quarter turn
    atlas.bust.offset =
        glm::dvec2(atlas.border + margin, margin) - scale * glm::dvec2(torso.low.y, torso.low.x);
    return atlas;
}

cv::Mat3b paint_skin(const SkinAtlas& atlas, const cv::Mat3b& painting)
{
    cv::Mat3b picture(atlas.size, atlas.size);
    const int border = static_cast<int>(atlas.border * atlas.size);
    place(painting, atlas.head, 0, border, picture);
    place(painting, atlas.bust, border, atlas.size, picture);
    fill_blank(picture, painting(0, 0));
    tone_down_blue(picture);
    return picture;
}

} // namespace head_tool
