// Between the vectors of OpenCV, in which wounds and light are computed, and those of GLM.
#pragma once
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

namespace head {

inline cv::Vec3d to_cv(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

inline glm::dvec3 to_glm(const cv::Vec3d& v)
{
    return {v[0], v[1], v[2]};
}

} // namespace head
