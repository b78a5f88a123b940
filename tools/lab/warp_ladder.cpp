#include "tools/lab/warp_ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace lab {

namespace {

constexpr int patch_size = 512;  // texels per side
constexpr int sample_count = 96; // per side of the lattices on which maps are compared and timed

template <typename Radius>
wound::Polyline polar(Radius radius, cv::Point2d center = {})
{
    constexpr int point_count = 720;
    wound::Polyline curve;
    for (int i = 0; i < point_count; ++i) {
        const double angle = -2 * std::numbers::pi * i / point_count; // counter-clockwise on screen
        curve.push_back(center + radius(angle) * cv::Point2d(std::cos(angle), std::sin(angle)));
    }
    return curve;
}

wound::Polyline crescent()
{
    wound::Polyline curve;
    const auto arc = [&curve](double radius, double shift, double from, double to) {
        constexpr int point_count = 300;
        for (int i = 0; i <= point_count; ++i) {
            const double angle = std::lerp(from, to, static_cast<double>(i) / point_count);
            curve.emplace_back(shift + radius * std::cos(angle), radius * std::sin(angle));
        }
    };
    arc(.45, 0, 2.2, -2.2);
    arc(.30, .05, -2.2, 2.2);
    return curve;
}

/// A superellipse: its long sides are nearly straight.
wound::Polyline cut()
{
    return polar([](double angle) {
        const double c = std::abs(std::cos(angle)) / .45, s = std::abs(std::sin(angle)) / .0225;
        return std::pow(c * c * c * c + s * s * s * s, -.25);
    });
}

/// A disk that the photograph's edge cuts in half.
wound::Polyline half_disk()
{
    constexpr int point_count = 300;
    wound::Polyline curve;
    for (int i = 0; i <= point_count; ++i) {
        const double angle = std::numbers::pi * (.5 - static_cast<double>(i) / point_count);
        curve.emplace_back(.45 * std::cos(angle) - .19, .45 * std::sin(angle));
    }
    for (int i = 1; i < point_count; ++i)
        curve.emplace_back(-.19, -.45 + .9 * i / point_count);
    return curve;
}

cv::Point2d centroid_of(const wound::Polyline& curve)
{
    cv::Point2d sum;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const cv::Point2d a = curve[i], b = curve[(i + 1) % curve.size()];
        sum += (a + b) * (b.x * a.y - a.x * b.y);
    }
    return sum / (6 * wound::signed_area(curve));
}

/// CPU time, which depends little on other programs.
template <typename Work>
double cpu_ms(Work work)
{
    const std::clock_t start = std::clock();
    work();
    return 1000. * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Day-0 points of a lattice of sample_count x sample_count over a square of half side `reach` at `center`.
cv::Mat2d lattice(const wound::Warp& warp, cv::Point2d center, double reach)
{
    cv::Mat2d map(sample_count, sample_count);
    for (int j = 0; j < sample_count; ++j)
        for (int i = 0; i < sample_count; ++i)
            map(j, i) = warp.apply(center + reach * cv::Point2d((i + .5) * 2 / sample_count - 1,
                                                                (j + .5) * 2 / sample_count - 1));
    return map;
}

/// Largest distance within the patch, in texels. Both maps are lattices over the same square.
double largest_distance(const cv::Mat2d& a, const cv::Mat2d& b, cv::Point2d center, double reach)
{
    double largest = 0;
    for (int j = 0; j < sample_count; ++j)
        for (int i = 0; i < sample_count; ++i) {
            const cv::Point2d p = center + reach * cv::Point2d((i + .5) * 2 / sample_count - 1,
                                                               (j + .5) * 2 / sample_count - 1);
            if (std::max(std::abs(p.x), std::abs(p.y)) < 1)
                largest = std::max(largest, cv::norm(a(j, i) - b(j, i)) * patch_size / 2);
        }
    return largest;
}

/// Measures all models at one ratio. Times them alternately, keeps the minimum; cheap maps run more often.
std::vector<LadderRow> measure(const LadderShape& shape, const wound::ContractionFlow& flow, double ratio)
{
    constexpr int rounds = 5;
    constexpr std::size_t model_count = std::size(warp_models);
    std::array<wound::Warp, model_count> warps;
    std::array<cv::Mat2d, model_count> maps;
    std::vector<LadderRow> rows;
    for (const wound::WarpModel model : warp_models)
        rows.push_back({shape.name, model, ratio, 0, 0, 0, 0, 0, 1e300, 1e300});
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < model_count; ++i) {
            LadderRow& row = rows[i];
            row.make_ms =
                std::min(row.make_ms, cpu_ms([&] { warps[i] = make_warp(flow, ratio, warp_models[i]); }));
            for (double spent_ms = 0; spent_ms < 10;) {
                const double once_ms = cpu_ms([&] { maps[i] = lattice(warps[i], {}, 1); });
                row.ms_per_megatexel =
                    std::min(row.ms_per_megatexel, once_ms * 1e6 / (sample_count * sample_count));
                spent_ms += once_ms;
            }
        }

    // Two lattices: the whole patch, and around today's wound, which may be only a few texels wide.
    double reach = 0;
    for (cv::Point2d p : shape.border)
        reach = std::max(reach, cv::norm(p - shape.centroid));
    reach *= 2 * std::sqrt(ratio);
    static_assert(warp_models[model_count - 1] == wound::WarpModel::Composed);
    const cv::Mat2d reference = maps.back(), near = lattice(warps.back(), shape.centroid, reach);
    for (std::size_t i = 0; i < model_count; ++i) {
        LadderRow& row = rows[i];
        row.near_error_texels =
            largest_distance(lattice(warps[i], shape.centroid, reach), near, shape.centroid, reach);
        row.error_texels = std::max(largest_distance(maps[i], reference, {}, 1), row.near_error_texels);
        row.area_error = wound::signed_area(wound::outline_today(warps[i], shape.border)) /
                             (ratio * wound::signed_area(shape.border)) -
                         1;
        // The thin-plate models need seconds per full-size check; a quarter of the size finds the same folds.
        const bool slow = row.model == wound::WarpModel::Dense || row.model == wound::WarpModel::Composed;
        const wound::FoldCheck check = wound::check_folds(warps[i], slow ? patch_size / 4 : patch_size);
        row.folded_texels = check.folded_texels * (slow ? 16 : 1);
        row.least_jacobian = check.least_jacobian;
    }
    return rows;
}

} // namespace

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
    const auto points = wound::control_points(shape.border, shape.centroid,
                                              wound::spacing_from_curvature(shape.border, shape.centroid));
    const wound::ContractionFlow flow = wound::prepare_flow(shape.border, points, shape.centroid);
    std::vector<LadderRow> rows;
    for (double ratio : ladder_ratios)
        for (const LadderRow& row : measure(shape, flow, ratio))
            rows.push_back(row);
    return rows;
}

} // namespace lab
