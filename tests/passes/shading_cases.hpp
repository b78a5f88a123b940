// Evaluates the shaders' formulas on the device, for tests that compare them with their double twins.
#pragma once
#include "tests/shaders/shading_case.h"

#include <cmath>
#include <vector>

#include "passes/shading.hpp"
#include "case_results.hpp"

namespace shading_cases {

using shared::ShadingCase;

inline constexpr double tiny = 1e-30; // below it floats may flush to 0

inline std::vector<glm::vec3> evaluate(const std::vector<ShadingCase>& cases)
{
    std::vector<glm::vec3> out;
    for (const cv::Vec4f& v : gpu_test::case_results("shading_test.comp", cases.size(), [&](graph::ComputePass& pass) {
             pass.buffer<ShadingCase>("CaseBlock", cases);
         }))
        out.emplace_back(v[0], v[1], v[2]);
    return out;
}

inline bool is_color(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

inline cv::Vec3d to_double(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

inline double max_difference(const glm::vec3& a, const cv::Vec3d& b)
{
    return cv::norm(to_double(a) - b, cv::NORM_INF);
}

inline glm::vec3 direction(double z, double phi)
{
    const double across = std::sqrt(std::max(0.0, 1 - z * z));
    return glm::vec3(glm::dvec3(across * std::cos(phi), across * std::sin(phi), z));
}

} // namespace shading_cases
