#include "reference/texture.hpp"

#include <array>
#include <cmath>

#include "base/color.hpp"

namespace reference {
namespace {

/// Of four texels the first index, and how far the place is from it towards the second, along one axis.
struct Step
{
    int first, second;
    double share;
};

Step step_along(double coordinate, int size)
{
    const double place = (coordinate - std::floor(coordinate)) * size - 0.5;
    const double floor = std::floor(place);
    const int first = (int(floor) + size) % size;
    return {first, (first + 1) % size, place - floor};
}

template <class Value, class Read>
Value bilinear(const cv::Size& size, const glm::dvec2& uv, const Read& read)
{
    const Step x = step_along(uv.x, size.width), y = step_along(uv.y, size.height);
    const Value above = glm::mix(read(y.first, x.first), read(y.first, x.second), x.share),
                below = glm::mix(read(y.second, x.first), read(y.second, x.second), x.share);
    return glm::mix(above, below, y.share);
}

double decoded(std::uint8_t code)
{
    static const std::array<double, 256> table = [] {
        std::array<double, 256> made;
        for (int i = 0; i < 256; ++i)
            made[std::size_t(i)] = base::linear_from_srgb(i / 255.0);
        return made;
    }();
    return table[code];
}

} // namespace

glm::dvec4 sample_srgb(const cv::Mat4b& picture, const glm::dvec2& uv)
{
    if (picture.empty())
        return glm::dvec4(1);
    return bilinear<glm::dvec4>(picture.size(), uv, [&](int y, int x) {
        const cv::Vec4b& t = picture(y, x);
        return glm::dvec4(decoded(t[0]), decoded(t[1]), decoded(t[2]), t[3] / 255.0);
    });
}

glm::dvec3 sample_linear(const cv::Mat3b& picture, const glm::dvec2& uv)
{
    return bilinear<glm::dvec3>(picture.size(), uv, [&](int y, int x) {
        const cv::Vec3b& t = picture(y, x);
        return glm::dvec3(t[0], t[1], t[2]) / 255.0;
    });
}

} // namespace reference
