#include "wound/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace wound {

namespace {

/// Arc length along a closed polyline: at every vertex, and in total.
struct ArcLength
{
    std::vector<double> at;
    double total = 0;

    explicit ArcLength(const Polyline& curve)
    {
        for (std::size_t i = 0; i < curve.size(); ++i) {
            at.push_back(total);
            total += cv::norm(curve[(i + 1) % curve.size()] - curve[i]);
        }
    }

    cv::Point2d point(const Polyline& curve, double length) const
    {
        length -= total * std::floor(length / total);
        const auto next = std::upper_bound(at.begin(), at.end(), length);
        const std::size_t i = static_cast<std::size_t>(next - at.begin()) - 1;
        const cv::Point2d a = curve[i];
        const cv::Point2d b = curve[(i + 1) % curve.size()];
        const double step = cv::norm(b - a);
        return step > 0 ? a + (b - a) * ((length - at[i]) / step) : a;
    }
};

/// Arc lengths at which lines axis = origin + k spacing cross the curve.
void add_crossings(const Polyline& curve, const ArcLength& arc, double cv::Point2d::*axis, double origin,
                   double spacing, std::vector<double>& lengths)
{
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const cv::Point2d p = curve[i];
        const cv::Point2d q = curve[(i + 1) % curve.size()];
        const double a = (p.*axis - origin) / spacing;
        const double b = (q.*axis - origin) / spacing;
        // Half-open in the coordinate, so that a vertex exactly on a line counts once.
        for (double line = std::ceil(std::min(a, b)); line < std::max(a, b); ++line)
            lengths.push_back(arc.at[i] + (line - a) / (b - a) * cv::norm(q - p));
    }
}

/// Merges runs of crossings of a closed curve that are closer than `nearest` into their middle.
std::vector<double> merge_near(std::vector<double> lengths, double total, double nearest)
{
    std::sort(lengths.begin(), lengths.end());
    std::vector<double> merged;
    if (lengths.empty())
        return merged;
    // Start after the widest gap, so that no run straddles the start.
    std::size_t start = 0;
    double widest = lengths.front() + total - lengths.back();
    for (std::size_t i = 1; i < lengths.size(); ++i)
        if (lengths[i] - lengths[i - 1] > widest) {
            widest = lengths[i] - lengths[i - 1];
            start = i;
        }
    std::rotate(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(start), lengths.end());
    for (double& length : lengths)
        if (length < lengths.front())
            length += total;
    double first = lengths.front();
    double last = first;
    for (std::size_t i = 1; i <= lengths.size(); ++i) {
        // A run also ends when it is 2 * nearest long.
        if (i < lengths.size() && lengths[i] - last < nearest && lengths[i] - first < 2 * nearest) {
            last = lengths[i];
            continue;
        }
        merged.push_back(.5 * (first + last));
        if (i < lengths.size())
            first = last = lengths[i];
    }
    return merged;
}

Polyline crossings(const Polyline& border, cv::Point2d centroid, double spacing)
{
    const ArcLength arc(border);
    std::vector<double> lengths;
    add_crossings(border, arc, &cv::Point2d::x, centroid.x, spacing, lengths);
    add_crossings(border, arc, &cv::Point2d::y, centroid.y, spacing, lengths);
    Polyline points;
    for (double length : merge_near(lengths, arc.total, .25 * spacing))
        points.push_back(arc.point(border, length));
    return points;
}

double distance_to_segment(cv::Point2d p, cv::Point2d a, cv::Point2d b)
{
    const cv::Point2d along = b - a;
    const double squared = along.dot(along);
    const double t = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0., 1.) : 0;
    return cv::norm(p - a - t * along);
}

/// The largest distance of the border from the closed polygon of its control points.
double largest_deviation(const Polyline& border, const Polyline& points)
{
    double farthest = 0;
    for (cv::Point2d p : border) {
        double nearest = 1e300;
        for (std::size_t i = 0; i < points.size(); ++i)
            nearest = std::min(nearest, distance_to_segment(p, points[i], points[(i + 1) % points.size()]));
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

double widest_extent(const Polyline& border)
{
    const auto [left, right] =
        std::minmax_element(border.begin(), border.end(), [](auto a, auto b) { return a.x < b.x; });
    const auto [top, bottom] =
        std::minmax_element(border.begin(), border.end(), [](auto a, auto b) { return a.y < b.y; });
    return std::max(right->x - left->x, bottom->y - top->y);
}

} // namespace

std::vector<Polyline> level_curves(const cv::Mat1f& coverage, float level)
{
    // Cells lie between texel centres, with a ring of zeros around them. A lattice edge is named by its low
    // end and direction.
    const int width = coverage.cols + 2;
    const auto value = [&](int x, int y) {
        const bool inside = x >= 1 && y >= 1 && x <= coverage.cols && y <= coverage.rows;
        return inside ? coverage(y - 1, x - 1) : 0.F;
    };
    const auto edge_name = [width](int x, int y, int direction) { return (y * width + x) * 2 + direction; };
    const auto crossing = [&](int name) {
        const int direction = name % 2, x = name / 2 % width, y = name / 2 / width;
        const float a = value(x, y), b = direction == 0 ? value(x + 1, y) : value(x, y + 1);
        const double t = (level - a) / static_cast<double>(b - a);
        const double column = x - 1 + (direction == 0 ? t : 0), row = y - 1 + (direction == 1 ? t : 0);
        return cv::Point2d((column + .5) * 2 / coverage.cols - 1, (row + .5) * 2 / coverage.rows - 1);
    };
    // In each cell the curve runs from one crossed edge to another, with the inside on its left on screen.
    std::unordered_map<int, int> next;
    for (int y = 0; y <= coverage.rows; ++y)
        for (int x = 0; x < width - 1; ++x) {
            const bool tl = value(x, y) >= level, tr = value(x + 1, y) >= level;
            const bool bl = value(x, y + 1) >= level, br = value(x + 1, y + 1) >= level;
            const int top = edge_name(x, y, 0), left = edge_name(x, y, 1), bottom = edge_name(x, y + 1, 0),
                      right = edge_name(x + 1, y, 1);
            const std::array<std::array<int, 3>, 4> sides{
                {{top, tl, tr}, {right, tr, br}, {bottom, br, bl}, {left, bl, tl}}};
            // Clockwise around the cell, `next` links a side from outside to inside to the following side
            // from inside to outside. This also separates the two inside corners of a saddle.
            for (int i = 0; i < 4; ++i)
                if (sides[i][1] == 0 && sides[i][2] == 1)
                    for (int k = 1; k < 4; ++k)
                        if (const auto& side = sides[(i + k) % 4]; side[1] == 1 && side[2] == 0) {
                            next[sides[i][0]] = side[0];
                            break;
                        }
        }
    std::vector<int> starts;
    for (const auto& [from, to] : next)
        starts.push_back(from);
    std::sort(starts.begin(), starts.end()); // gives the same order of curves on every machine
    std::vector<Polyline> curves;
    for (int start : starts) {
        Polyline curve;
        for (auto it = next.find(start); it != next.end(); it = next.find(start)) {
            curve.push_back(crossing(start));
            start = it->second;
            next.erase(it);
        }
        if (curve.size() >= 3)
            curves.push_back(std::move(curve));
    }
    return curves;
}

Polyline border_of(const cv::Mat1f& coverage)
{
    std::vector<Polyline> curves = level_curves(coverage);
    if (curves.empty())
        throw std::invalid_argument("border_of: the mask is empty");
    return *std::max_element(curves.begin(), curves.end(),
                             [](const auto& a, const auto& b) { return signed_area(a) < signed_area(b); });
}

double signed_area(const Polyline& curve)
{
    double twice = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const cv::Point2d a = curve[i], b = curve[(i + 1) % curve.size()];
        twice += b.x * a.y - a.x * b.y; // y points down
    }
    return .5 * twice;
}

Moments moments_of(const cv::Mat1f& coverage)
{
    double mass = 0, x = 0, y = 0;
    for (int j = 0; j < coverage.rows; ++j)
        for (int i = 0; i < coverage.cols; ++i) {
            const double m = coverage(j, i);
            mass += m;
            x += m * (i + .5);
            y += m * (j + .5);
        }
    if (!(mass > 0))
        throw std::invalid_argument("moments_of: the mask is empty");
    const double texel = 2. / coverage.cols;
    return {mass * texel * texel, {x / mass * texel - 1, y / mass * texel - 1}};
}

Polyline control_points(const Polyline& border, cv::Point2d centroid, double spacing)
{
    CV_Assert(border.size() >= 3 && spacing > 0);
    spacing = std::max(spacing, widest_extent(border) /
                                    most_control_points); // a finer spacing would give too many points
    Polyline points = crossings(border, centroid, spacing);
    constexpr int tries = 40; // each changes the spacing by a fifth or a quarter
    for (int i = 0; i < tries && static_cast<int>(points.size()) < fewest_control_points; ++i)
        points = crossings(border, centroid, spacing *= .8);
    for (int i = 0; i<tries&& static_cast<int>(points.size())> most_control_points; ++i)
        points = crossings(border, centroid, spacing *= 1.25);
    return points;
}

double spacing_from_curvature(const Polyline& border, cv::Point2d centroid, double tolerance)
{
    const double allowed = tolerance * std::sqrt(std::abs(signed_area(border)));
    double spacing = widest_extent(border) / 12;
    for (const double finest = spacing / 4; spacing > finest; spacing *= .8)
        if (largest_deviation(border, control_points(border, centroid, spacing)) <= allowed)
            break;
    return spacing;
}

} // namespace wound
