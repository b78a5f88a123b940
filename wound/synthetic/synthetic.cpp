#include "wound/synthetic/synthetic.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "wound/synthetic/synthetic_outline.hpp"
#include "wound/synthetic/synthetic_tissue.hpp"

namespace wound {
namespace {

using cv::Vec3f;

const Vec3f to_light{-.45f, -.55f, .70f}; // length 1 within .01; the camera looks along -z, y points down

struct Surface
{
    cv::Mat3f reflectance;
    cv::Mat1f layer, height_mm, wetness;
};

/// The slow fields at every `slow_step`th pixel, one more row and column than needed to interpolate; sets the
/// painter's shares.
constexpr int slow_step = 4;
cv::Mat_<SlowFields> slow_grid(TissuePainter& painter, const cv::Mat1f& distance)
{
    const int n = distance.rows, nodes = (n + slow_step - 1) / slow_step + 1;
    cv::Mat_<SlowFields> grid(nodes, nodes);
    std::vector<SlowFields> bed;
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i) {
            const int x = std::min(i * slow_step, n - 1), y = std::min(j * slow_step, n - 1);
            grid(j, i) = painter.slow_fields(
                synthetic_position_mm(float(i * slow_step), float(j * slow_step), n), distance(y, x));
            if (distance(y, x) > 0)
                bed.push_back(grid(j, i));
        }
    painter.set_shares(bed);
    return grid;
}

Surface paint(const WoundKind& kind, const SyntheticWound& wound, const Noise& noise,
              const cv::Mat1f& distance)
{
    const int n = wound.size;
    TissuePainter painter(kind, wound, noise);
    const cv::Mat_<SlowFields> grid = slow_grid(painter, distance);
    Surface surface{cv::Mat3f(n, n), cv::Mat1f(n, n), cv::Mat1f(n, n), cv::Mat1f(n, n)};
    cv::parallel_for_({0, n}, [&](const cv::Range& rows) {
        std::vector<SlowFields> row(std::size_t(grid.cols));
        for (int y = rows.start; y < rows.end; ++y) {
            const float v = float(y % slow_step) / slow_step;
            for (int i = 0; i < grid.cols; ++i)
                row[i] = grid(y / slow_step, i) * (1 - v) + grid(y / slow_step + 1, i) * v;
            for (int x = 0; x < n; ++x) {
                const float u = float(x % slow_step) / slow_step;
                const SlowFields slow = row[x / slow_step] * (1 - u) + row[x / slow_step + 1] * u;
                const Tissue tissue =
                    painter.at({synthetic_position_mm(float(x), float(y), n), distance(y, x), slow});
                surface.reflectance(y, x) = tissue.reflectance;
                surface.layer(y, x) = tissue.layer;
                surface.height_mm(y, x) = tissue.height_mm;
                surface.wetness(y, x) = tissue.wetness;
            }
        }
    });
    return surface;
}

/// x^40.
float lobe(float x)
{
    const float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
    return x16 * x16 * x8;
}

/// Shades the relief weakly, as with a ring flash, because the renderer shades it again.
void light(Surface& surface)
{
    const int n = surface.height_mm.rows;
    const float px_per_mm = float(n) / float(synthetic_width_mm);
    cv::Mat1f around;
    cv::boxFilter(surface.height_mm, around, -1, cv::Size(1, 1) * (2 * int(px_per_mm) + 1));
    cv::parallel_for_({1, n - 1}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 1; x < n - 1; ++x) {
                const float slope_x =
                    (surface.height_mm(y, x + 1) - surface.height_mm(y, x - 1)) * px_per_mm / 2;
                const float slope_y =
                    (surface.height_mm(y + 1, x) - surface.height_mm(y - 1, x)) * px_per_mm / 2;
                const float scale = 1 / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
                const float cosine = (to_light[2] - slope_x * to_light[0] - slope_y * to_light[1]) * scale;
                const float hollow = around(y, x) - surface.height_mm(y, x);
                const float shade = 1 + .22f * (std::max(cosine, 0.f) / to_light[2] - 1) -
                                    std::clamp(.22f * hollow, -.08f, .2f);
                // Blinn-Phong lobe around the half vector of light and eye: weak highlights on wet knobs.
                const float half =
                    (to_light[2] + 1 - slope_x * to_light[0] - slope_y * to_light[1]) * scale / 1.844f;
                const float wet = surface.wetness(y, x);
                const float highlight = wet > 0 ? .09f * wet * lobe(std::clamp(half, 0.f, 1.f)) : 0;
                surface.reflectance(y, x) = surface.reflectance(y, x) * shade + Vec3f::all(highlight);
            }
    });
}

/// Simulates the camera: slight blur, 8 bits, a little sensor noise.
cv::Mat3b develop(cv::Mat3f reflectance, std::uint32_t seed)
{
    cv::GaussianBlur(reflectance, reflectance, {3, 3}, .55);
    constexpr int steps = 4096;
    std::array<float, steps + 1> codes;
    for (int i = 0; i <= steps; ++i)
        codes[i] = 255 * base::linear_to_srgb(float(i) / steps);
    cv::Mat3b srgb(reflectance.size());
    cv::parallel_for_({0, reflectance.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < reflectance.cols; ++x) {
                const std::uint32_t bits = hash(seed, x, y);
                for (int c = 0; c < 3; ++c) {
                    const float code = codes[int(std::clamp(reflectance(y, x)[c], 0.f, 1.f) * steps)];
                    const float grain = float(bits >> (8 * c) & 255) / 255 * 3 - 1.5f;
                    srgb(y, x)[c] = cv::saturate_cast<uchar>(code + grain);
                }
            }
    });
    return srgb;
}

} // namespace

Photograph synthesize(const SyntheticWound& wound)
{
    CV_Assert(wound.size >= 64);
    const WoundKind& kind = kind_named(wound.kind);
    const Noise noise(hash(wound.seed, int(&kind - wound_kinds().data()), 0));
    const cv::Mat1f distance = outline_distance(kind, wound, noise);
    Surface surface = paint(kind, wound, noise, distance);
    light(surface);
    return {develop(surface.reflectance, wound.seed + 9), distance > 0, {}, surface.layer};
}

} // namespace wound
