#include "wound/warp_ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace wound {

namespace {

constexpr int kTexels = 512;
constexpr int kSamples = 96; // a side, of the lattices on which maps are compared and timed

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

/// CPU time, which other programs' work hardly changes.
template <typename Work>
double cpu_ms(Work work)
{
    const std::clock_t start = std::clock();
    work();
    return 1000. * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Day-0 points of a lattice of kSamples x kSamples over the square of half the side `reach` about `center`.
cv::Mat2d lattice(const Warp& warp, cv::Point2d center, double reach)
{
    cv::Mat2d map(kSamples, kSamples);
    for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i)
            map(j, i) = warp.apply(
                center + reach * cv::Point2d((i + .5) * 2 / kSamples - 1, (j + .5) * 2 / kSamples - 1));
    return map;
}

/// Largest distance within the patch, texels. Both maps are lattices over the square about `center`.
double largest_distance(const cv::Mat2d& a, const cv::Mat2d& b, cv::Point2d center, double reach)
{
    double largest = 0;
    for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i) {
            const cv::Point2d p =
                center + reach * cv::Point2d((i + .5) * 2 / kSamples - 1, (j + .5) * 2 / kSamples - 1);
            if (std::max(std::abs(p.x), std::abs(p.y)) < 1)
                largest = std::max(largest, cv::norm(a(j, i) - b(j, i)) * kTexels / 2);
        }
    return largest;
}

/// Every rung at one ratio, timed in turn, the least of kRounds; cheap maps are timed more often.
std::vector<LadderRow> measure(const LadderShape& shape, const ContractionFlow& flow, double ratio)
{
    constexpr int kRounds = 5;
    constexpr std::size_t kCount = std::size(kLadderRungs);
    std::array<Warp, kCount> warps;
    std::array<cv::Mat2d, kCount> maps;
    std::vector<LadderRow> rows;
    for (const WarpRung rung : kLadderRungs)
        rows.push_back({shape.name, rung, ratio, 0, 0, 0, 0, 0, 1e300, 1e300});
    for (int round = 0; round < kRounds; ++round)
        for (std::size_t i = 0; i < kCount; ++i) {
            LadderRow& row = rows[i];
            row.make_ms =
                std::min(row.make_ms, cpu_ms([&] { warps[i] = make_warp(flow, ratio, kLadderRungs[i]); }));
            for (double spent_ms = 0; spent_ms < 10;) {
                const double once_ms = cpu_ms([&] { maps[i] = lattice(warps[i], {}, 1); });
                row.ms_per_megatexel = std::min(row.ms_per_megatexel, once_ms * 1e6 / (kSamples * kSamples));
                spent_ms += once_ms;
            }
        }

    // Two lattices: the whole patch, and the neighbourhood of today's wound, which may be a few texels wide.
    double reach = 0;
    for (cv::Point2d p : shape.border)
        reach = std::max(reach, cv::norm(p - shape.centroid));
    reach *= 2 * std::sqrt(ratio);
    static_assert(kLadderRungs[kCount - 1] == WarpRung::composed);
    const cv::Mat2d reference = maps.back(), near = lattice(warps.back(), shape.centroid, reach);
    for (std::size_t i = 0; i < kCount; ++i) {
        LadderRow& row = rows[i];
        row.near_error_texels =
            largest_distance(lattice(warps[i], shape.centroid, reach), near, shape.centroid, reach);
        row.error_texels = std::max(largest_distance(maps[i], reference, {}, 1), row.near_error_texels);
        row.area_error =
            signed_area(outline_today(warps[i], shape.border)) / (ratio * signed_area(shape.border)) - 1;
        // The thin-plate rungs cost seconds per check at full size; a quarter of it finds the same folds.
        const bool slow = row.rung == WarpRung::dense || row.rung == WarpRung::composed;
        const FoldCheck check = check_folds(warps[i], slow ? kTexels / 4 : kTexels);
        row.folded_texels = check.folded_texels * (slow ? 16 : 1);
        row.least_jacobian = check.least_jacobian;
    }
    return rows;
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

std::vector<LadderRow> measure_ladder(const LadderShape& shape)
{
    const auto points =
        control_points(shape.border, shape.centroid, spacing_from_curvature(shape.border, shape.centroid));
    const ContractionFlow flow = prepare_flow(shape.border, points, shape.centroid);
    std::vector<LadderRow> rows;
    for (double ratio : kLadderRatios)
        for (const LadderRow& row : measure(shape, flow, ratio))
            rows.push_back(row);
    return rows;
}

} // namespace wound
