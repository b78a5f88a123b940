#include "tools/head/bake_skin.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "base/smoothstep.hpp"

namespace head_tool {
namespace {

constexpr float pore_spacing = 1.1f;   // mm
constexpr float furrow_spacing = 1.7f; // mm
constexpr float modulation = 0.03f;    // of the colour, root mean square
constexpr float mean_shade = 0.4f;     // of Detail on a cheek; subtracted, so that the mean colour is kept

std::uint32_t hash(int x, int y, int z)
{
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return h ^ h >> 15;
}

/// Smooth value noise, about -1 .. 1, features about one unit apart.
float noise(glm::vec3 p)
{
    const glm::vec3 cell = glm::floor(p), f = p - cell, t = f * f * (3.0f - 2.0f * f);
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y), z = static_cast<int>(cell.z);
    const auto at = [&](int i, int j, int k) {
        return static_cast<float>(hash(x + i, y + j, z + k) >> 8) / 8388608.0f - 1.0f;
    };
    const auto along_x = [&](int j, int k) { return glm::mix(at(0, j, k), at(1, j, k), t.x); };
    return glm::mix(glm::mix(along_x(0, 0), along_x(1, 0), t.y), glm::mix(along_x(0, 1), along_x(1, 1), t.y),
                    t.z);
}

/// Distances to the nearest and second-nearest of random points, one per unit cell (Worley 1996).
glm::vec2 cellular(glm::vec3 p)
{
    const glm::vec3 cell = glm::floor(p);
    glm::vec2 nearest(9.0f); // squared
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const glm::vec3 corner = cell + glm::vec3(i, j, k);
                const std::uint32_t h =
                    hash(static_cast<int>(corner.x), static_cast<int>(corner.y), static_cast<int>(corner.z));
                const glm::vec3 point =
                    corner + glm::vec3(h & 1023u, h >> 10 & 1023u, h >> 20 & 1023u) / 1024.0f;
                const float d = glm::dot(point - p, point - p);
                if (d < nearest.x)
                    nearest = {d, nearest.x};
                else if (d < nearest.y)
                    nearest.y = d;
            }
    return glm::sqrt(nearest);
}

float bump(glm::vec3 p, glm::vec3 middle, float radius)
{
    return std::exp(-glm::dot(p - middle, p - middle) / (radius * radius));
}

/// Centre of the left cheek; the right one is its mirror image. mm.
glm::vec3 cheek_of(const SkinPlaces& places)
{
    return places.nose_tip + glm::vec3(34, 2, -22);
}

/// Strength of the relief at a position: strongest on nose and inner cheeks, weak on neck and scalp, almost
/// none on the lips.
struct Relief
{
    float pores, furrows, creases; // relative depths
};

Relief relief_at(glm::vec3 p, const SkinPlaces& places, float lip)
{
    const float nose = bump(p, places.nose_tip, 22);
    const float cheeks = bump({std::abs(p.x), p.y, p.z}, cheek_of(places), 26);
    const float chin = bump(p, places.mouth + glm::vec3(0, -28, -4), 22);
    const float face = base::smoothstep(-95, -45, p.z) * base::smoothstep(-120, -85, p.y) *
                       (1 - base::smoothstep(55, 95, p.y));
    const float forehead =
        base::smoothstep(22, 36, p.y) * (1 - base::smoothstep(55, 75, p.y)) * base::smoothstep(-70, -30, p.z);
    const float dry = 1 - lip;
    return {dry * (0.15f + 0.35f * face + 0.8f * nose + 0.6f * cheeks + 0.4f * chin),
            dry * (0.6f + 0.3f * face), dry * forehead};
}

/// Skin detail at one position: relief height, darkening by pores and furrows, redness.
struct Detail
{
    float height; // mm
    float shade;  // 0 .. 1
    float blush;  // redness, about -1 .. 1
};

Detail detail_at(glm::vec3 p, const Relief& relief)
{
    // A small warp hides the regular lattice of the cells.
    const glm::vec3 warp =
        0.35f * glm::vec3(noise(p * 0.5f), noise(p * 0.5f + 31.0f), noise(p * 0.5f + 67.0f));
    const float pit = 1 - base::smoothstep(0.12f, 0.5f, cellular((p + warp) / pore_spacing).x);
    const glm::vec2 plates = cellular((p + warp) / furrow_spacing + 11.0f);
    const float furrow = 1 - base::smoothstep(0.0f, 0.22f, plates.y - plates.x);
    // Forehead creases are horizontal: noise stretched along x.
    const float crease = noise({p.x * 0.02f, p.y * 0.22f + 0.8f * noise(p * 0.03f), p.z * 0.02f});
    const float roll = noise(p * 0.35f) + 0.6f * noise(p * 0.8f + 5.0f);
    const float height = -0.075f * relief.pores * pit - 0.04f * relief.furrows * furrow +
                         0.03f * relief.furrows * roll + 0.2f * relief.creases * crease;
    const float blush =
        0.6f * noise(p * 0.12f) + 0.4f * noise(p * 0.33f + 9.0f) + 0.3f * noise(p * 0.9f + 3.0f);
    return {height, std::min(1.0f, relief.pores * pit + 0.35f * relief.furrows * furrow), blush};
}

/// Share of lip in the paint, 0..1: near the mouth, where red / green is above that of skin.
float lip_at(const cv::Vec3b& paint, glm::vec3 p, const SkinPlaces& places)
{
    const float red = static_cast<float>(paint[0]) / std::max(1.0f, static_cast<float>(paint[1]));
    return base::smoothstep(1.28f, 1.5f, red) * bump(p, places.mouth, 30);
}

glm::vec3 place(const cv::Mat3f& positions, int y, int x)
{
    const cv::Vec3f& p =
        positions(std::clamp(y, 0, positions.rows - 1), std::clamp(x, 0, positions.cols - 1));
    return {p[0], p[1], p[2]};
}

/// Shifts the colour of the whole painting so that the cheeks have the measured mean colour.
cv::Mat3b match_cheeks(const cv::Mat3b& painted, const SkinPlaces& places)
{
    // Xiao et al. 2017, Skin Research and Technology 23: Caucasians, cheek, spectrophotometer, CIELAB.
    const cv::Scalar measured(59.6, 11.8, 14.6);
    constexpr float radius = 15; // mm
    cv::Mat3f lab;
    painted.convertTo(lab, CV_32F, 1.0 / 255);
    cv::cvtColor(lab, lab, cv::COLOR_RGB2Lab);
    cv::Mat1b cheeks(painted.size());
    for (int y = 0; y < painted.rows; ++y)
        for (int x = 0; x < painted.cols; ++x) {
            const glm::vec3 p = place(places.position, y, x);
            cheeks(y, x) = glm::distance({std::abs(p.x), p.y, p.z}, cheek_of(places)) < radius ? 255 : 0;
        }
    if (cv::countNonZero(cheeks) == 0)
        return painted;
    lab += measured - cv::mean(lab, cheeks);
    cv::cvtColor(lab, lab, cv::COLOR_Lab2RGB);
    cv::Mat3b matched;
    lab.convertTo(matched, CV_8U, 255);
    return matched;
}

/// Normals of the height field, scaled by the size of each texel on the head.
cv::Mat3b normals_of(const cv::Mat1f& height, const cv::Mat3f& positions)
{
    cv::Mat3b normals(height.size());
    cv::parallel_for_(cv::Range(0, height.rows), [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < height.cols; ++x) {
                const int left = std::max(x - 1, 0), right = std::min(x + 1, height.cols - 1);
                const int above = std::max(y - 1, 0), below = std::min(y + 1, height.rows - 1);
                constexpr float least = 0.1f; // mm over two texels, lower bound
                const float run_u =
                    std::max(least, glm::distance(place(positions, y, left), place(positions, y, right)));
                const float run_v =
                    std::max(least, glm::distance(place(positions, above, x), place(positions, below, x)));
                // y points up, opposite to v.
                const glm::vec3 n =
                    glm::normalize(glm::vec3((height(y, left) - height(y, right)) / run_u,
                                             (height(below, x) - height(above, x)) / run_v, 1.0f));
                for (int c = 0; c < 3; ++c)
                    normals(y, x)[c] = cv::saturate_cast<uchar>(127.5f + 127.5f * n[c]);
            }
    });
    return normals;
}

} // namespace

SkinPictures detail_skin(const cv::Mat3b& painting, const SkinPlaces& places)
{
    const cv::Mat3b painted = match_cheeks(painting, places);
    // Small dark marks of the painting (stubble, pores) also become pits.
    cv::Mat1b gray;
    cv::cvtColor(painted, gray, cv::COLOR_RGB2GRAY);
    cv::Mat1f marks, around;
    gray.convertTo(marks, CV_32F);
    cv::GaussianBlur(marks, around, {}, 4.0);
    marks -= around;

    cv::Mat1f height(painted.size());
    SkinPictures pictures{cv::Mat4b(painted.size()), {}};
    cv::parallel_for_(cv::Range(0, painted.rows), [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < painted.cols; ++x) {
                const glm::vec3 p = place(places.position, y, x);
                const cv::Vec3b& paint = painted(y, x);
                const float lip = lip_at(paint, p, places);
                const Detail detail = detail_at(p, relief_at(p, places, lip));
                height(y, x) = detail.height + 0.004f * std::clamp(marks(y, x), -20.0f, 10.0f);
                const float light = 1 + modulation * (2 * (mean_shade - detail.shade) + 0.3f * detail.blush);
                const glm::vec3 tint =
                    light * glm::vec3(1, 1 - modulation * detail.blush, 1 - 0.8f * modulation * detail.blush);
                cv::Vec4b& color = pictures.color(y, x);
                for (int c = 0; c < 3; ++c)
                    color[c] = cv::saturate_cast<uchar>(static_cast<float>(paint[c]) * tint[c]);
                color[3] = 255;
            }
    });
    pictures.normal = normals_of(height, places.position);
    return pictures;
}

} // namespace head_tool
