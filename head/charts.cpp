#include "head/charts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "head/flat_triangles.hpp"
#include "head/packing.hpp"
#include "head/weld.hpp"

namespace head {
namespace {

constexpr double cone_while_growing =
    .64;                    // cosine of the largest angle to the chart's mean normal: 50 degrees
constexpr double cone = .5; // to the final mean normal: the density is at least sqrt(.5)
constexpr std::size_t growth_per_triangle = 8; // how often a triangle may be tried, in the mean
constexpr int directions_tried = 24;           // for the smallest box around a chart, in 90 degrees
constexpr double widest_gutter = 2, narrowest_gutter = 1. / 16; // units
constexpr std::uint32_t none = ~0u;

struct ChartMesh
{
    std::vector<std::array<glm::dvec3, 3>> corners;       // m
    std::vector<glm::dvec3> area_normal;                  // normal times area, m^2
    std::vector<std::array<std::uint32_t, 3>> neighbours; // across its edges; none at borders
};

struct Chart
{
    std::vector<std::uint32_t> triangles;
    std::vector<FlatTriangle> flat; // m, from (0, 0) to `size`
    glm::dvec2 size{0};             // m, upright: height >= width
};

/// Two triangles are neighbours if they alone share an edge, by position, in opposite directions.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const Model& model,
                                                        std::span<const std::uint32_t> triangles)
{
    const std::vector<std::uint32_t> place = weld<3>(model.vertices.size(), [&](std::size_t v) {
        const glm::vec3& p = model.vertices[v].position;
        return Key<3>{{bits_of(p.x), bits_of(p.y), bits_of(p.z)}};
    });
    const auto edge = [&](std::uint32_t t, std::size_t k, bool forth) {
        const std::uint64_t a = place[model.indices[triangles[t] + k]],
                            b = place[model.indices[triangles[t] + (k + 1) % 3]];
        return forth ? a << 32 | b : b << 32 | a;
    };
    std::unordered_map<std::uint64_t, std::uint32_t> owner; // none: of several
    owner.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto [at, added] = owner.try_emplace(edge(t, k, true), t); !added)
                at->second = none;
    std::vector<std::array<std::uint32_t, 3>> neighbours(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = owner.find(edge(t, k, false));
            const bool alone = owner.at(edge(t, k, true)) != none && found != owner.end();
            neighbours[t][k] = alone ? found->second : none;
        }
    return neighbours;
}

ChartMesh chart_mesh(const Model& model, std::span<const std::uint32_t> triangles)
{
    ChartMesh mesh;
    for (const std::uint32_t first : triangles) {
        const auto c = corners_of(model, first);
        mesh.corners.push_back({c[0], c[1], c[2]});
        const auto& [p, q, r] = mesh.corners.back();
        mesh.area_normal.push_back(glm::cross(q - p, r - p) / 2.);
    }
    mesh.neighbours = neighbours_of(model, triangles);
    return mesh;
}

/// The triangles on the plane with this normal; m.
std::vector<FlatTriangle> flattened(const ChartMesh& mesh, std::span<const std::uint32_t> triangles,
                                    const glm::dvec3& normal)
{
    const glm::dvec3 helper = std::abs(normal.y) < .9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(helper, normal)), y = glm::cross(normal, x);
    std::vector<FlatTriangle> flat(triangles.size());
    for (std::size_t i = 0; i < flat.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& p = mesh.corners[triangles[i]][k];
            flat[i][k] = {glm::dot(p, x), glm::dot(p, y)};
        }
    return flat;
}

Box2 box_of(std::span<const FlatTriangle> flat)
{
    Box2 box;
    for (const FlatTriangle& triangle : flat)
        for (const glm::dvec2& p : triangle)
            box.add(p);
    return box;
}

class ChartGrower
{
  public:
    explicit ChartGrower(const ChartMesh& mesh)
        : mesh_(mesh), seen_(mesh.corners.size(), none), charted_(mesh.corners.size(), 0),
          work_left_(growth_per_triangle * mesh.corners.size())
    {
    }

    std::vector<Chart> charts()
    {
        std::vector<double> area(mesh_.corners.size());
        std::ranges::transform(mesh_.area_normal, area.begin(),
                               [](const glm::dvec3& n) { return glm::length(n); });
        std::vector<std::uint32_t> order(area.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, std::ranges::greater(), [&](std::uint32_t t) { return area[t]; });
        std::vector<Chart> charts;
        for (const std::uint32_t seed : order)
            while (charted_[seed] == 0) { // a chart may lose the triangle from which it grew
                charts.push_back(without_overlap(grown_from(seed, std::uint32_t(charts.size()))));
                for (const std::uint32_t t : charts.back().triangles)
                    charted_[t] = 1;
            }
        return charts;
    }

  private:
    /// Breadth first, over triangles that have no chart yet.
    std::vector<std::uint32_t> grown_from(std::uint32_t seed, std::uint32_t number)
    {
        std::vector<std::uint32_t> chart, queue{seed};
        seen_[seed] = number;
        glm::dvec3 sum(0.);
        for (std::size_t next = 0; next < queue.size() && (next == 0 || work_left_ > 0); ++next) {
            const glm::dvec3& normal = mesh_.area_normal[queue[next]];
            work_left_ -= work_left_ > 0;
            if (next > 0 &&
                glm::dot(normal, sum) < cone_while_growing * glm::length(normal) * glm::length(sum))
                continue;
            chart.push_back(queue[next]);
            sum += normal;
            for (const std::uint32_t t : mesh_.neighbours[queue[next]])
                if (t != none && charted_[t] == 0 && std::exchange(seen_[t], number) != number)
                    queue.push_back(t);
        }
        return chart;
    }

    /// Drops the triangles that are too steep for the chart's plane, or overlap earlier ones. Keeps at least
    /// one.
    Chart without_overlap(const std::vector<std::uint32_t>& grown)
    {
        glm::dvec3 sum(0.);
        for (const std::uint32_t t : grown)
            sum += mesh_.area_normal[t];
        const auto fits = [&](std::uint32_t t) {
            const glm::dvec3& n = mesh_.area_normal[t];
            return glm::dot(n, sum) >= cone * glm::length(n) * glm::length(sum);
        };
        const std::vector<FlatTriangle> flat = flattened(mesh_, grown, glm::normalize(sum));
        FlatLayer layer(box_of(flat), flat.size());
        Chart chart;
        for (std::size_t i = 0; i < flat.size(); ++i)
            if (fits(grown[i]) && layer.add(flat[i])) {
                chart.triangles.push_back(grown[i]);
                chart.flat.push_back(flat[i]);
            }
        return chart.triangles.empty() ? single(grown.front()) : chart;
    }

    Chart single(std::uint32_t triangle) const
    {
        const std::array one{triangle};
        return {{triangle}, flattened(mesh_, one, glm::normalize(mesh_.area_normal[triangle])), {}};
    }

    const ChartMesh& mesh_;
    std::vector<std::uint32_t> seen_;   // by triangle: the last chart that tried it
    std::vector<std::uint8_t> charted_; // by triangle
    std::size_t work_left_;
};

/// Turns the chart so that its box is small and upright, with its corner at the origin.
void straighten(Chart& chart)
{
    const auto turned = [](double angle, const glm::dvec2& p) {
        const double c = std::cos(angle), s = std::sin(angle);
        return glm::dvec2(c * p.x + s * p.y, c * p.y - s * p.x);
    };
    const auto box_at = [&](double angle) {
        const glm::dvec2 x = turned(angle, {1, 0}), y = turned(angle, {0, 1}); // of the axes
        Box2 box;
        for (const FlatTriangle& triangle : chart.flat)
            for (const glm::dvec2& p : triangle)
                box.add(p.x * x + p.y * y);
        return box;
    };
    double best = 0, smallest = 1e300;
    for (int i = 0; i < 2 * directions_tried; ++i) {
        const double angle = glm::half_pi<double>() * i / directions_tried;
        const Box2 box = box_at(angle);
        const glm::dvec2 size = box.high - box.low;
        if (size.y >= size.x * (1 - 1e-9) && size.x * size.y < smallest) {
            smallest = size.x * size.y;
            best = angle;
        }
    }
    const glm::dvec2 x = turned(best, {1, 0}), y = turned(best, {0, 1});
    const Box2 box = box_at(best);
    for (FlatTriangle& triangle : chart.flat)
        for (glm::dvec2& p : triangle)
            p = p.x * x + p.y * y - box.low;
    chart.size = box.high - box.low;
}

struct Packing
{
    double units_per_m = 0, gutter = 0; // gutter: units
    std::vector<glm::dvec2> corners;    // of the charts, units; empty: they do not fit
};

/// By column: what the chart and half a gutter around it cover, units. `column`: its width, units.
void set_outline(std::vector<Horizon::Span>& outline, const Chart& chart, const Packing& packing,
                 double column)
{
    const double half = packing.gutter / 2, width = chart.size.x * packing.units_per_m + packing.gutter;
    outline.assign(std::max<std::size_t>(std::size_t(std::ceil(width / column)), 1), {});
    for (const FlatTriangle& triangle : chart.flat)
        for (std::size_t k = 0; k < 3; ++k) {
            glm::dvec2 a = triangle[k] * packing.units_per_m + half,
                       b = triangle[(k + 1) % 3] * packing.units_per_m + half;
            if (a.x > b.x)
                std::swap(a, b);
            const double slope = b.x - a.x > 1e-9 ? (b.y - a.y) / (b.x - a.x) : 0;
            const std::size_t last = std::min(std::size_t((b.x + half) / column), outline.size() - 1);
            for (auto i = std::min(std::size_t(std::max(a.x - half, 0.) / column), last); i <= last; ++i) {
                const double x0 = std::clamp(double(i) * column - half, a.x, b.x),
                             x1 = std::clamp(double(i + 1) * column + half, a.x, b.x);
                const double y0 = slope == 0 ? a.y : a.y + slope * (x0 - a.x),
                             y1 = slope == 0 ? b.y : a.y + slope * (x1 - a.x);
                outline[i].bottom = std::min(outline[i].bottom, std::min(y0, y1) - half);
                outline[i].top = std::max(outline[i].top, std::max(y0, y1) + half);
            }
        }
}

/// Charts in the order of their height. Beyond some hundred charts, fewer columns are tried for each.
Packing packed(std::span<const Chart> charts, double side, double units_per_m, double gutter)
{
    const auto columns = std::size_t(std::clamp(4 * std::sqrt(double(charts.size())), 256., 1024.));
    const double column = side / double(columns);
    const std::size_t positions = 100'000 / charts.size() + 32;
    Packing packing{units_per_m, gutter, {}};
    Horizon horizon(columns);
    std::vector<Horizon::Span> outline;
    for (const Chart& chart : charts) {
        set_outline(outline, chart, packing, column);
        const auto place = horizon.put(outline, positions);
        if (!place || place->height + chart.size.y * units_per_m + gutter > side)
            return {};
        packing.corners.emplace_back(double(place->column) * column + gutter / 2, place->height + gutter / 2);
    }
    return packing;
}

/// The densest that fits, by bisection.
Packing densest_packing(std::span<const Chart> charts, double side)
{
    double area = 0;
    for (const Chart& chart : charts)
        for (const FlatTriangle& triangle : chart.flat)
            area += std::abs(signed_area(triangle));
    double gutter =
        std::clamp(.15 * side / std::sqrt(double(charts.size())), narrowest_gutter, widest_gutter);
    double high = side / std::sqrt(area), low = high / 2;
    Packing best = packed(charts, side, low, gutter);
    while (best.corners.empty()) {
        high = low;
        best = packed(charts, side, low /= 1.5, gutter /= 1.5);
    }
    for (int step = charts.size() > 10'000 ? 3 : 0; step < 6; ++step) { // many are costly to pack
        const double middle = (low + high) / 2;
        Packing packing = packed(charts, side, middle, gutter);
        (packing.corners.empty() ? high : low) = middle;
        if (!packing.corners.empty())
            best = std::move(packing);
    }
    return best;
}

} // namespace

void chart_anew(AtlasTile& tile, const Model& model, std::span<const std::uint32_t> triangles,
                std::uint32_t side)
{
    const ChartMesh mesh = chart_mesh(model, triangles);
    std::vector<Chart> charts = ChartGrower(mesh).charts();
    std::ranges::for_each(charts, straighten);
    std::ranges::stable_sort(charts, std::ranges::greater(), [](const Chart& c) { return c.size.y; });
    const Packing packing = densest_packing(charts, side);
    tile.size = glm::uvec2(side);
    tile.gutter = packing.gutter;
    tile.home.resize(triangles.size());
    for (std::size_t c = 0; c < charts.size(); ++c)
        for (std::size_t i = 0; i < charts[c].triangles.size(); ++i) {
            AtlasTriangle& triangle = tile.home[charts[c].triangles[i]];
            triangle.first = triangles[charts[c].triangles[i]];
            for (std::size_t k = 0; k < 3; ++k)
                triangle.at[k] = glm::vec2(packing.corners[c] + packing.units_per_m * charts[c].flat[i][k]);
        }
}

} // namespace head
