// The skin's pictures: the figure's painted skin enlarged, with pores, furrows and mottling that no painted
// skin has.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

namespace head_tool {

/// The place of each texel on the head, in millimetres from between the eyes, x to the figure's left; and
/// where the face's features are.
struct SkinPlaces
{
    cv::Mat3f position; // filled beyond the charts too
    glm::vec3 nose_tip{0.0f}, mouth{0.0f};
};

struct SkinPictures
{
    cv::Mat4b color;  // RGBA, sRGB, opaque
    cv::Mat3b normal; // RGB, tangent space
};

/// `painting`: RGB, sRGB, of the size of the places. Its overall tone is moved to that measured on cheeks.
SkinPictures detail_skin(const cv::Mat3b& painting, const SkinPlaces& places);

} // namespace head_tool
