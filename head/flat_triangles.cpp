#include "head/flat_triangles.hpp"

#include <algorithm>

namespace head {
namespace {

constexpr std::uint32_t no_link = ~0u;
constexpr std::size_t steps_per_triangle = 64, links_per_triangle = 16;

/// Whether an edge of `a`, which is counter-clockwise, separates `b` from `a`.
bool separates(const FlatTriangle& a, const FlatTriangle& b, double slack)
{
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 edge = a[(k + 1) % 3] - a[k];
        const double limit = slack * (std::abs(edge.x) + std::abs(edge.y));
        if (cross(edge, b[0] - a[k]) <= limit && cross(edge, b[1] - a[k]) <= limit &&
            cross(edge, b[2] - a[k]) <= limit)
            return true;
    }
    return false;
}

} // namespace

double weighted_quantile(std::vector<Weighted> values, double q)
{
    std::ranges::sort(values, {}, &Weighted::value);
    double sum = 0;
    for (const Weighted& v : values)
        sum += v.weight;
    double below = 0;
    for (const Weighted& v : values)
        if ((below += v.weight) >= q * sum)
            return v.value;
    return values.empty() ? 0 : values.back().value;
}

FlatLayer::FlatLayer(const Box2& box, std::size_t most_triangles)
    : low_(box.low), steps_left_(1000 + steps_per_triangle * most_triangles),
      links_left_(1000 + links_per_triangle * most_triangles)
{
    const glm::dvec2 size = glm::max(box.high - box.low, glm::dvec2(1e-12));
    const double cells = double(std::clamp<std::size_t>(most_triangles, 1, 1 << 20)) / 2;
    const double width = std::sqrt(size.x * size.y / cells);
    cells_ = glm::ivec2(glm::clamp(size / width, glm::dvec2(1), glm::dvec2(cells + 1)));
    cells_per_length_ = glm::dvec2(cells_) / size;
    slack_ = 1e-9 * std::max(size.x, size.y);
    first_.assign(std::size_t(cells_.x) * cells_.y, no_link);
}

glm::ivec2 FlatLayer::cell(const glm::dvec2& at) const
{
    return glm::clamp(glm::ivec2((at - low_) * cells_per_length_), glm::ivec2(0), cells_ - 1);
}

bool FlatLayer::add(FlatTriangle triangle)
{
    const double area = signed_area(triangle);
    if (area < 0)
        std::swap(triangle[1], triangle[2]);
    if (!(std::abs(area) > slack_ * slack_))
        return false;
    Box2 box;
    for (const glm::dvec2& p : triangle)
        box.add(p);
    const glm::ivec2 from = cell(box.low), to = cell(box.high);
    const std::size_t links = std::size_t(to.x - from.x + 1) * (to.y - from.y + 1);
    if (links > std::min(links_left_, steps_left_))
        return false;
    steps_left_ -= links;
    ++calls_;
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
            for (std::uint32_t l = first_[std::size_t(y) * cells_.x + x]; l != no_link; l = links_[l].next) {
                if (steps_left_-- <= 1)
                    return steps_left_ = 0, false;
                const std::uint32_t other = links_[l].triangle;
                if (std::exchange(tested_[other], calls_) != calls_ &&
                    !separates(triangle, triangles_[other], slack_) &&
                    !separates(triangles_[other], triangle, slack_))
                    return false;
            }
    links_left_ -= links;
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            std::uint32_t& first = first_[std::size_t(y) * cells_.x + x];
            links_.push_back({std::uint32_t(triangles_.size()), first});
            first = std::uint32_t(links_.size() - 1);
        }
    triangles_.push_back(triangle);
    tested_.push_back(0);
    return true;
}

} // namespace head
