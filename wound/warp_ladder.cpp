#include "wound/warp_ladder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace wound {

namespace {

constexpr int kTexels = 512;
constexpr WarpRung kRungs[] = {WarpRung::radial, WarpRung::grid, WarpRung::dense, WarpRung::composed};

template <typename Radius>
Polyline polar(Radius radius, cv::Point2d center = {})
{
    constexpr int kPoints = 720;
    Polyline curve;
    for (int i = 0; i < kPoints; ++i) {
        const double angle = -2 * std::numbers::pi * i / kPoints; // counter-clockwise on screen
        curve.push_back(center + radius(angle) * cv::Point2d(std::cos(angle), std::sin(angle)));
    }
    return curve;
}

Polyline crescent()
{
    Polyline curve;
    const auto arc = [&curve](double radius, double shift, double from, double to) {
        constexpr int kPoints = 300;
        for (int i = 0; i <= kPoints; ++i) {
            const double angle = std::lerp(from, to, static_cast<double>(i) / kPoints);
            curve.emplace_back(shift + radius * std::cos(angle), radius * std::sin(angle));
        }
    };
    arc(.45, 0, 2.2, -2.2);
    arc(.30, .05, -2.2, 2.2);
    return curve;
}

/// A superellipse, so that its long sides are straight.
Polyline cut()
{
    return polar([](double angle) {
        const double c = std::abs(std::cos(angle)) / .45, s = std::abs(std::sin(angle)) / .0225;
        return std::pow(c * c * c * c + s * s * s * s, -.25);
    });
}

/// A disk that the photograph's edge cuts in half.
Polyline half_disk()
{
    constexpr int kPoints = 300;
    Polyline curve;
    for (int i = 0; i <= kPoints; ++i) {
        const double angle = std::numbers::pi * (.5 - static_cast<double>(i) / kPoints);
        curve.emplace_back(.45 * std::cos(angle) - .19, .45 * std::sin(angle));
    }
    for (int i = 1; i < kPoints; ++i)
        curve.emplace_back(-.19, -.45 + .9 * i / kPoints);
    return curve;
}

cv::Point2d centroid_of(const Polyline& curve)
{
    cv::Point2d sum;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const cv::Point2d a = curve[i], b = curve[(i + 1) % curve.size()];
        sum += (a + b) * (b.x * a.y - a.x * b.y);
    }
    return sum / (6 * signed_area(curve));
}

/// Where the forward map, the inverse of `warp`, takes a day-0 point: by Newton's method from the scaled
/// point.
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

double milliseconds(std::chrono::steady_clock::time_point since)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
}

LadderRow measure(const LadderShape& shape, const ContractionFlow& flow, WarpRung rung, double ratio)
{
    constexpr int kSamples = 96;
    LadderRow row{shape.name, rung, ratio};
    const Warp reference = make_warp(flow, ratio, WarpRung::composed);
    auto start = std::chrono::steady_clock::now();
    const Warp warp = make_warp(flow, ratio, rung);
    row.make_ms = milliseconds(start);
    cv::Mat2d map(kSamples, kSamples);
    double least_ms =
        1e300; // a cheap map takes less than a turn of the machine's other work: the least of five
    for (int repeat = 0; repeat < 5 && (repeat == 0 || least_ms < 20); ++repeat) {
        start = std::chrono::steady_clock::now();
        for (int j = 0; j < kSamples; ++j)
            for (int i = 0; i < kSamples; ++i)
                map(j, i) = warp.apply({(i + .5) * 2 / kSamples - 1, (j + .5) * 2 / kSamples - 1});
        least_ms = std::min(least_ms, milliseconds(start));
    }
    row.ms_per_megatexel = least_ms * 1e6 / (kSamples * kSamples);

    // Two lattices: the whole patch, and the neighbourhood of today's wound, which may be a few texels wide.
    double reach = 0;
    for (cv::Point2d p : shape.border)
        reach = std::max(reach, cv::norm(p - shape.centroid));
    reach *= 2 * warp.scale;
    for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i) {
            const cv::Point2d unit((i + .5) * 2 / kSamples - 1, (j + .5) * 2 / kSamples - 1);
            const cv::Point2d near = shape.centroid + reach * unit;
            row.error_texels = std::max(
                row.error_texels, cv::norm(cv::Point2d(map(j, i)) - reference.apply(unit)) * kTexels / 2);
            if (std::max(std::abs(near.x), std::abs(near.y)) < 1)
                row.wound_error_texels = std::max(
                    row.wound_error_texels, cv::norm(warp.apply(near) - reference.apply(near)) * kTexels / 2);
        }
    row.error_texels = std::max(row.error_texels, row.wound_error_texels);

    row.area_error = signed_area(outline_today(warp, shape.border)) / (ratio * signed_area(shape.border)) - 1;
    // The thin-plate rungs cost seconds per check at full size; a quarter of it finds the same folds.
    const bool slow = rung == WarpRung::dense || rung == WarpRung::composed;
    const FoldCheck check = check_folds(warp, slow ? kTexels / 4 : kTexels);
    row.folded_texels = check.folded_texels * (slow ? 16 : 1);
    row.least_jacobian = check.least_jacobian;
    return row;
}

/// The worst of several rows.
LadderRow worst(const std::vector<LadderRow>& rows)
{
    LadderRow all = rows.front();
    for (const LadderRow& row : rows) {
        all.error_texels = std::max(all.error_texels, row.error_texels);
        all.wound_error_texels = std::max(all.wound_error_texels, row.wound_error_texels);
        all.area_error = std::max(std::abs(all.area_error), std::abs(row.area_error));
        all.folded_texels = std::max(all.folded_texels, row.folded_texels);
        all.least_jacobian = std::min(all.least_jacobian, row.least_jacobian);
        all.make_ms = std::max(all.make_ms, row.make_ms);
        all.ms_per_megatexel = std::max(all.ms_per_megatexel, row.ms_per_megatexel);
    }
    return all;
}

template <typename Keep>
std::string line(const std::vector<LadderRow>& rows, const std::string& first, Keep keep)
{
    std::vector<LadderRow> kept;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept), keep);
    if (kept.empty())
        return "";
    const LadderRow row = worst(kept);
    return fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.2f} | {} | {:.3f} | {:.0f} | {:.0f} |\n",
                       name_of(row.rung), first, row.error_texels, row.wound_error_texels,
                       100 * row.area_error, row.folded_texels, row.least_jacobian, row.make_ms,
                       row.ms_per_megatexel);
}

std::string header(std::string_view second)
{
    return fmt::format("| rung | {} | error, texels | near the wound | area, % | folded texels | least "
                       "Jacobian | make, ms | CPU ms/megatexel |\n"
                       "|---|---|---|---|---|---|---|---|---|\n",
                       second);
}

} // namespace

Polyline outline_today(const Warp& warp, const Polyline& day0)
{
    Polyline today;
    for (cv::Point2d p : day0)
        today.push_back(today_of(warp, p));
    return today;
}

const char* name_of(WarpRung rung)
{
    switch (rung) {
    case WarpRung::radial:
        return "radial";
    case WarpRung::grid:
        return "grid";
    case WarpRung::dense:
        return "dense";
    case WarpRung::composed:
        return "composed";
    }
    return "";
}

std::vector<LadderShape> ladder_shapes()
{
    std::vector<LadderShape> shapes{{"circle", polar([](double) { return .45; }), {}},
                                    {"star", polar([](double a) { return .32 + .12 * std::cos(5 * a); }), {}},
                                    {"ragged",
                                     polar([](double a) {
                                         return .36 + .05 * std::sin(3 * a + 1) + .03 * std::sin(7 * a) +
                                                .015 * std::sin(17 * a + 2);
                                     }),
                                     {}},
                                    {"crescent", crescent(), {}},
                                    {"cut 20:1", cut(), {}},
                                    {"at the photo's edge", half_disk(), {}},
                                    {"near the frame", polar([](double) { return .28; }, {.6, .1}), {}}};
    for (LadderShape& shape : shapes)
        shape.centroid = centroid_of(shape.border);
    return shapes;
}

std::vector<LadderRow> measure_ladder(const std::vector<LadderShape>& shapes)
{
    std::vector<LadderRow> rows;
    for (const LadderShape& shape : shapes) {
        const auto points = control_points(shape.border, shape.centroid,
                                           spacing_from_curvature(shape.border, shape.centroid));
        const ContractionFlow flow = prepare_flow(shape.border, points, shape.centroid);
        for (WarpRung rung : kRungs)
            for (double ratio : kLadderRatios)
                rows.push_back(measure(shape, flow, rung, ratio));
    }
    return rows;
}

std::string ladder_markdown(const std::vector<LadderRow>& rows)
{
    std::string text = header("r");
    for (WarpRung rung : kRungs)
        for (double ratio : kLadderRatios)
            text += line(rows, fmt::format("{}", ratio),
                         [&](const LadderRow& row) { return row.rung == rung && row.ratio == ratio; });
    text += '\n';
    text += header("shape");
    for (WarpRung rung : kRungs) {
        std::vector<std::string> named;
        for (const LadderRow& row : rows)
            if (std::find(named.begin(), named.end(), row.shape) == named.end()) {
                named.push_back(row.shape);
                text += line(rows, row.shape, [&](const LadderRow& other) {
                    return other.rung == rung && other.shape == row.shape;
                });
            }
    }
    return text;
}

} // namespace wound
