#include "wound/warp/warp.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "wound/warp/thin_plate.hpp"

namespace wound {

namespace {

constexpr int hull_angles = 256;
constexpr int hull_reach = 32;       // half-width, in angles, of the hull's widening and smoothing
constexpr double hull_margin = 1.05; // keeps a blurred border inside the hull
// Control points nearer than half a texel of 512 count as one: the system would be near-singular.
constexpr double coincident = .002;

double cross(cv::Point2d a, cv::Point2d b)
{
    return a.x * b.y - a.y * b.x;
}

/// Distance from the centroid to the patch's frame along `direction` (a unit vector).
double distance_to_frame(cv::Point2d centroid, cv::Point2d direction)
{
    const double x = direction.x > 0   ? (1 - centroid.x) / direction.x
                     : direction.x < 0 ? (-1 - centroid.x) / direction.x
                                       : 1e9;
    const double y = direction.y > 0   ? (1 - centroid.y) / direction.y
                     : direction.y < 0 ? (-1 - centroid.y) / direction.y
                                       : 1e9;
    return std::min(x, y);
}

/// Radii of a smooth star-shaped hull: at every angle at least the border's radius and 70 % of its largest
/// radius, so that a direction without border (a crescent's hollow) is contracted too.
std::vector<double> star_hull(const std::vector<cv::Point2d>& border, cv::Point2d centroid)
{
    constexpr double full_turn = 2 * std::numbers::pi;
    std::vector<double> farthest(hull_angles, 0.);
    for (std::size_t i = 0; i < border.size(); ++i) {
        const cv::Point2d a = border[i] - centroid;
        const cv::Point2d b = border[(i + 1) % border.size()] - centroid;
        const int samples = 1 + static_cast<int>(cv::norm(b - a) / .002);
        for (int k = 0; k < samples; ++k) {
            const cv::Point2d p = a + (b - a) * (static_cast<double>(k) / samples);
            const double turn = (std::atan2(p.y, p.x) + std::numbers::pi) / full_turn * hull_angles;
            const int bin = static_cast<int>(turn) % hull_angles;
            for (int bin_beside : {bin, (bin + 1) % hull_angles})
                farthest[bin_beside] = std::max(farthest[bin_beside], cv::norm(p));
        }
    }
    const double least = .7 * *std::max_element(farthest.begin(), farthest.end());
    // A maximum and then a mean over the same window keep the hull outside the border.
    std::vector<double> hull(hull_angles, 0.);
    const auto wrapped = [](int i) { return (i + hull_angles) % hull_angles; };
    std::vector<double> widened(hull_angles);
    for (int i = 0; i < hull_angles; ++i) {
        widened[i] = least;
        for (int k = -hull_reach; k <= hull_reach; ++k)
            widened[i] = std::max(widened[i], farthest[wrapped(i + k)]);
    }
    for (int i = 0; i < hull_angles; ++i)
        for (int k = -hull_reach; k <= hull_reach; ++k)
            hull[i] += hull_margin * widened[wrapped(i + k)] / (2 * hull_reach + 1);
    return hull;
}

/// Inside the contracted hull a uniform scaling; from there to the frame the radius is mapped linearly. The
/// determinant is (radius / today's radius) x (slope along the ray) > 0 for any hull, so the map cannot fold.
cv::Point2d apply_radial(const Warp& warp, cv::Point2d p)
{
    const cv::Point2d offset = p - warp.centroid;
    const double radius = cv::norm(offset);
    if (radius == 0 || warp.radii.empty())
        return p;
    const int count = static_cast<int>(warp.radii.size());
    const double turn = (std::atan2(offset.y, offset.x) + std::numbers::pi) / (2 * std::numbers::pi) * count;
    const int index = static_cast<int>(std::floor(turn));
    const double hull = std::lerp(warp.radii[index % count], warp.radii[(index + 1) % count], turn - index);
    const double frame = distance_to_frame(warp.centroid, offset / radius);
    // If today's hull reached the frame, there would be no skin between them to stretch.
    const double day0 = std::min(hull, .95 * frame / std::max(warp.scale, 1.));
    const double today = warp.scale * day0;
    if (radius >= frame)
        return p;
    const double moved =
        radius <= today ? radius / warp.scale : day0 + (radius - today) * (frame - day0) / (frame - today);
    return warp.centroid + offset * (moved / radius);
}

/// Node positions along one axis from frame to frame, spaced by sinh, densest at the centroid.
double node_position(int index, int half, double centroid, double epsilon)
{
    const double t = static_cast<double>(index - half) / half;
    const double reach = t < 0 ? 1 + centroid : 1 - centroid;
    if (std::abs(index - half) == half)
        return t;
    return centroid + epsilon * std::sinh(t * std::asinh(reach / epsilon));
}

/// Index of the cell of nodes that contains `coordinate`, in closed form as in the shader.
int node_cell(double coordinate, int half, double centroid, double epsilon)
{
    const double offset = coordinate - centroid;
    const double reach = offset < 0 ? 1 + centroid : 1 - centroid;
    const double t =
        std::copysign(std::asinh(std::abs(offset) / epsilon) / std::asinh(reach / epsilon), offset);
    return std::clamp(static_cast<int>(std::floor((t + 1) * half)), 0, 2 * half - 1);
}

/// Number of nodes on each side of the centroid: a strongly contracted wound bends the map more.
int half_nodes(double scale)
{
    return scale >= .6 ? 40 : scale >= .15 ? 80 : 112;
}

/// The sinh spacing's width, chosen so that the contracted wound, about scale x half a patch wide, gets as
/// many nodes as its surroundings.
double grid_epsilon(double scale)
{
    return .5 * scale;
}

cv::Point2d apply_grid(const Warp& warp, cv::Point2d p)
{
    const double epsilon = grid_epsilon(warp.scale);
    const int half = static_cast<int>(warp.nodes.size()) / 2;
    const int i = node_cell(p.x, half, warp.centroid.x, epsilon);
    const int j = node_cell(p.y, half, warp.centroid.y, epsilon);
    const double u = (p.x - warp.nodes[i].x) / (warp.nodes[i + 1].x - warp.nodes[i].x);
    const double v = (p.y - warp.nodes[j].y) / (warp.nodes[j + 1].y - warp.nodes[j].y);
    const cv::Vec2d above = warp.grid(j, i) * (1 - u) + warp.grid(j, i + 1) * u;
    const cv::Vec2d below = warp.grid(j + 1, i) * (1 - u) + warp.grid(j + 1, i + 1) * u;
    return cv::Point2d(above * (1 - v) + below * v);
}

cv::Point2d apply_steps(const std::vector<ThinPlate>& steps, cv::Point2d p)
{
    for (const ThinPlate& step : steps)
        p = step.apply(p);
    return p;
}

/// The steps from `scale` back to 1: a partial step to the next whole power of step_scale, then whole ones.
std::vector<ThinPlate> composed_steps(const ContractionFlow& flow, double scale)
{
    int whole = 0;
    double reached = 1;
    while (whole < static_cast<int>(flow.steps.size()) && reached * step_scale >= scale) {
        reached *= step_scale;
        ++whole;
    }
    std::vector<ThinPlate> steps;
    if (scale != reached)
        steps.push_back(contraction_step(flow.control_points, flow.centroid, scale, reached));
    for (int k = whole - 1; k >= 0; --k)
        steps.push_back(flow.steps[k]);
    return steps;
}

void fill_grid(Warp& warp, const std::vector<ThinPlate>& steps, double share)
{
    const double epsilon = grid_epsilon(warp.scale);
    const int half = int(std::lround(share * half_nodes(warp.scale)));
    const int count = 2 * half + 1;
    for (int i = 0; i < count; ++i)
        warp.nodes.emplace_back(node_position(i, half, warp.centroid.x, epsilon),
                                node_position(i, half, warp.centroid.y, epsilon));
    warp.grid.create(count, count);
    cv::parallel_for_({0, count}, [&](const cv::Range& rows) {
        for (int j = rows.start; j < rows.end; ++j) {
            std::vector<float> x(count), y(count, static_cast<float>(warp.nodes[j].y));
            for (int i = 0; i < count; ++i)
                x[i] = static_cast<float>(warp.nodes[i].x);
            for (const ThinPlate& step : steps)
                apply_in_place(step, x, y);
            for (int i = 0; i < count; ++i)
                warp.grid(j, i) = {x[i], y[i]};
        }
    });
}

} // namespace

cv::Point2d Warp::apply(cv::Point2d p) const
{
    switch (model) {
    case WarpModel::Radial:
        return apply_radial(*this, p);
    case WarpModel::Grid:
        return apply_grid(*this, p);
    case WarpModel::Dense:
    case WarpModel::Composed:
        return apply_steps(steps, p);
    }
    return p;
}

ContractionFlow prepare_flow(const std::vector<cv::Point2d>& border,
                             const std::vector<cv::Point2d>& control_points, cv::Point2d centroid)
{
    ContractionFlow flow{centroid, {}, star_hull(border, centroid), {}};
    // The centroid is also a control point; it moves by D (1 - sqrt r) = 0.
    std::vector<cv::Point2d> candidates = control_points;
    candidates.push_back(centroid);
    for (cv::Point2d candidate : candidates) {
        const auto coincides = [candidate](cv::Point2d p) { return cv::norm(p - candidate) < coincident; };
        if (std::none_of(flow.control_points.begin(), flow.control_points.end(), coincides))
            flow.control_points.push_back(candidate);
    }
    const int count = static_cast<int>(std::ceil(std::log(smallest_scale) / std::log(step_scale))) - 1;
    flow.steps.resize(count);
    cv::parallel_for_({0, count}, [&](const cv::Range& range) {
        for (int k = range.start; k < range.end; ++k)
            flow.steps[k] = contraction_step(flow.control_points, centroid, std::pow(step_scale, k + 1),
                                             std::pow(step_scale, k));
    });
    return flow;
}

Warp make_warp(const ContractionFlow& flow, double area_ratio, WarpModel model)
{
    Warp warp;
    warp.model = model;
    warp.scale = std::max(std::sqrt(area_ratio), smallest_scale);
    warp.centroid = flow.centroid;
    switch (model) {
    case WarpModel::Radial:
        warp.radii = flow.radii;
        break;
    case WarpModel::Grid:
        fill_grid(warp, composed_steps(flow, warp.scale), flow.grid_share);
        break;
    case WarpModel::Dense:
        warp.steps = {contraction_step(flow.control_points, flow.centroid, warp.scale, 1)};
        break;
    case WarpModel::Composed:
        warp.steps = composed_steps(flow, warp.scale);
        break;
    }
    return warp;
}

shared::WarpHeader pack(const Warp& warp, std::vector<shared::vec2>& values)
{
    const auto put = [&values](cv::Point2d p) {
        values.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
    };
    shared::WarpHeader header{};
    header.center = {static_cast<float>(warp.centroid.x), static_cast<float>(warp.centroid.y)};
    header.scale = static_cast<float>(warp.scale);
    header.grid_epsilon = static_cast<float>(grid_epsilon(warp.scale));
    header.model = static_cast<shared::uint>(warp.model);
    header.first = static_cast<shared::uint>(values.size());
    header.steps = static_cast<shared::uint>(warp.steps.size());
    switch (warp.model) {
    case WarpModel::Radial:
        header.count = static_cast<shared::uint>(warp.radii.size());
        for (double radius : warp.radii)
            put({radius, 0});
        break;
    case WarpModel::Grid:
        header.count = static_cast<shared::uint>(warp.nodes.size());
        for (cv::Point2d node : warp.nodes)
            put(node);
        for (const cv::Vec2d& node : warp.grid)
            put(cv::Point2d(node));
        break;
    case WarpModel::Dense:
    case WarpModel::Composed:
        header.count = warp.steps.empty() ? 0 : static_cast<shared::uint>(warp.steps.front().centers.size());
        for (const ThinPlate& step : warp.steps) {
            for (cv::Point2d coefficient : step.affine)
                put(coefficient);
            for (std::size_t i = 0; i < step.centers.size(); ++i) {
                put(step.centers[i]);
                put(step.weights[i]);
            }
        }
        break;
    }
    return header;
}

cv::Mat2d backward_map(const Warp& warp, int size)
{
    cv::Mat2d map(size, size);
    cv::parallel_for_({0, size}, [&](const cv::Range& rows) {
        for (int j = rows.start; j < rows.end; ++j)
            for (int i = 0; i < size; ++i)
                map(j, i) = warp.apply({(i + .5) * 2 / size - 1, (j + .5) * 2 / size - 1});
    });
    return map;
}

cv::Mat warp_image(const cv::Mat& image, const Warp& warp)
{
    CV_Assert(image.rows == image.cols && !image.empty());
    cv::Mat2f texels;
    backward_map(warp, image.rows).convertTo(texels, CV_32F, image.rows / 2., image.rows / 2. - .5);
    cv::Mat warped;
    cv::remap(image, warped, texels, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return warped;
}

FoldCheck check_folds(const Warp& warp, int size)
{
    cv::Mat2d corners(size + 1, size + 1);
    cv::parallel_for_({0, size + 1}, [&](const cv::Range& rows) {
        for (int j = rows.start; j < rows.end; ++j)
            for (int i = 0; i <= size; ++i)
                corners(j, i) = warp.apply({i * 2. / size - 1, j * 2. / size - 1});
    });
    FoldCheck check{0, 1e300};
    const double texel_area = 4. / size / size;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const cv::Point2d a(corners(j, i)), b(corners(j, i + 1)), c(corners(j + 1, i)),
                d(corners(j + 1, i + 1));
            const double determinant = std::min({cross(b - a, c - a), cross(b - a, d - b),
                                                 cross(d - c, c - a), cross(d - c, d - b)}) /
                                       texel_area;
            check.folded_texels += determinant <= 0;
            check.least_jacobian = std::min(check.least_jacobian, determinant);
        }
    return check;
}

namespace {

/// The forward map, inverse of `warp`, of a day-0 point, by Newton's method that starts at the scaled point.
cv::Point2d today_of(const Warp& warp, cv::Point2d day0)
{
    cv::Point2d p = warp.centroid + (day0 - warp.centroid) * warp.scale;
    const double h = 1e-5 * warp.scale;
    for (int i = 0; i < 20; ++i) {
        const cv::Point2d miss = warp.apply(p) - day0;
        if (cv::norm(miss) < 1e-9)
            break;
        const cv::Point2d u =
            (warp.apply(p + cv::Point2d(h, 0)) - warp.apply(p - cv::Point2d(h, 0))) / (2 * h);
        const cv::Point2d v =
            (warp.apply(p + cv::Point2d(0, h)) - warp.apply(p - cv::Point2d(0, h))) / (2 * h);
        const double determinant = u.x * v.y - u.y * v.x;
        if (std::abs(determinant) < 1e-12)
            break;
        p -= cv::Point2d(miss.x * v.y - miss.y * v.x, u.x * miss.y - u.y * miss.x) / determinant;
    }
    return p;
}

} // namespace

Polyline outline_today(const Warp& warp, const Polyline& day0)
{
    Polyline today;
    for (cv::Point2d p : day0)
        today.push_back(today_of(warp, p));
    return today;
}

const char* name_of(WarpModel model)
{
    switch (model) {
    case WarpModel::Radial:
        return "radial";
    case WarpModel::Grid:
        return "grid";
    case WarpModel::Dense:
        return "dense";
    case WarpModel::Composed:
        return "composed";
    }
    return "";
}

} // namespace wound
