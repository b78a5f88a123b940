// The skin's pictures: the figure's painted skin with added pores, furrows and mottling.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

namespace head_tool {

/// Position of each texel and of facial features in mm from the point between the eyes; x to the figure's
/// left.
struct SkinPlaces
{
    cv::Mat3f position; // also filled outside the charts
    glm::vec3 nose_tip{0.0f}, mouth{0.0f};
};

struct SkinPictures
{
    cv::Mat4b color;  // RGBA, sRGB, opaque
    cv::Mat3b normal; // RGB, tangent space
};

/// `painting`: RGB, sRGB, of the size of `places`. Shifts its mean colour to that measured on cheeks.
SkinPictures detail_skin(const cv::Mat3b& painting, const SkinPlaces& places);

} // namespace head_tool
