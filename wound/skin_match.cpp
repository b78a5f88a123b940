#include "wound/skin_match.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "base/color.hpp"
#include "base/smoothstep.hpp"
#include "wound/membrane.hpp"
#include "wound/photo/healthy_skin.hpp"
#include "wound/photo/specular_highlights.hpp"

namespace wound {
namespace {

using cv::Vec3f;

constexpr int skin_grid = healthy_skin_grid;
constexpr float darkest = .002f; // reflectance; keeps logarithms finite

bool is_finite(const Vec3f& v)
{
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

cv::Mat1f coarse(const cv::Mat1f& fine)
{
    cv::Mat1f result;
    cv::resize(fine, result, {skin_grid, skin_grid}, 0, 0,
               fine.rows > skin_grid ? cv::INTER_AREA : cv::INTER_LINEAR);
    return result;
}

cv::Mat3f coarse(const cv::Mat3f& fine)
{
    cv::Mat3f result;
    cv::resize(fine, result, {skin_grid, skin_grid}, 0, 0,
               fine.rows > skin_grid ? cv::INTER_AREA : cv::INTER_LINEAR);
    return result;
}

/// The photograph's maps, finite and clamped.
struct Source
{
    cv::Mat3f color;
    cv::Mat1f coverage, valid; // 0..1
    float radius = 0;          // of the circle with the wound's area, texels
    float reach = 0; // width of the surroundings that are used, texels; grows with the wound's length and
                     // area
};

Source checked(const Patch& patch)
{
    const int n = patch.color.rows;
    CV_Assert(n >= 8 && patch.color.cols == n && patch.mask.size() == patch.color.size());
    CV_Assert(patch.opacity.empty() || patch.opacity.size() == patch.color.size());
    Source source{cv::Mat3f(n, n), cv::Mat1f(n, n), cv::Mat1f(n, n), 0, 0};
    double area = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const Vec3f color = patch.color(y, x);
            const bool known = is_finite(color) && (patch.opacity.empty() || patch.opacity(y, x) > 0);
            const float coverage = patch.mask(y, x);
            source.valid(y, x) = known ? 1 : 0;
            source.coverage(y, x) = std::isfinite(coverage) ? std::clamp(coverage, 0.f, 1.f) : 0;
            area += source.coverage(y, x);
            for (int k = 0; k < 3; ++k)
                source.color(y, x)[k] = known ? std::clamp(color[k], darkest, 1.f) : darkest;
        }
    source.radius = float(std::sqrt(area / CV_PI));
    const cv::Rect box = cv::boundingRect(cv::Mat1b(source.coverage > .5f));
    source.reach = .4f * source.radius + .1f * float(box.width + box.height);
    return source;
}

/// Log correction of a colour cast: minus 70 % of the part of `cast` beyond +-`tolerance`, within +-.5.
float correction(float cast, float tolerance)
{
    return -std::clamp(.7f * (cast - std::clamp(cast, -tolerance, tolerance)), -.5f, .5f);
}

/// Median log(blue / green) of the wound's red parts; nullopt if there is little red. About -.05 for blood
/// over pale dermis.
std::optional<float> blue_of_blood(const cv::Mat3f& log_photo, const cv::Mat1f& coverage)
{
    std::vector<float> blues;
    for (int y = 0; y < skin_grid; ++y)
        for (int x = 0; x < skin_grid; ++x)
            if (const Vec3f& c = log_photo(y, x); coverage(y, x) > .9f && c[0] - c[1] > 1)
                blues.push_back(c[2] - c[1]);
    if (float(blues.size()) < .2f * float(cv::sum(coverage)[0]) || blues.empty())
        return std::nullopt;
    const auto middle = blues.begin() + std::ptrdiff_t(blues.size() / 2);
    std::nth_element(blues.begin(), middle, blues.end());
    return *middle;
}

/// Log gains for the open bed that correct the photo's white balance and exposure, estimated from healthy
/// skin and blood; partial and limited, because the true colours of the patient's skin and wound are unknown.
/// Human skin lies near a line in (log r/g, log b/g) from light to dark.
Vec3f bed_gain(const Vec3f& log_skin, std::optional<float> blood)
{
    const cv::Point2f light{.40f, -.24f}, dark{.87f, -.54f},
        line = dark - light; // sRGB (233,196,176) and (92,60,45)
    const cv::Point2f seen{log_skin[0] - log_skin[1], log_skin[2] - log_skin[1]};
    const float tone = std::clamp((seen - light).dot(line) / line.dot(line), 0.f, 1.f);
    const cv::Point2f cast = seen - (light + tone * line);
    const float red = correction(cast.x, .1f);
    const float blue = blood ? correction(*blood + .05f, .1f) : correction(cast.y, .1f);

    const Vec3f linear{std::exp(log_skin[0]), std::exp(log_skin[1]), std::exp(log_skin[2])};
    // Only light skin has a pale hue; browner hues occur in all but the lightest skin.
    const float least = std::lerp(std::log(.30f), std::log(.05f), tone),
                most = std::lerp(std::log(.65f), std::log(.35f), tone);
    const float seen_light = std::log(base::luminance(linear));
    const float exposure = std::clamp(.6f * (std::clamp(seen_light, least, most) - seen_light), -.45f, .45f);
    const float even = exposure - (red + blue) / 3; // the white balance must not change the exposure
    return {even + red, even, even + blue};
}

/// The face's skin on the coarse grid.
struct Face
{
    cv::Mat3f log_color;
    cv::Mat1f weight;               // 0 where unknown; small where the colour is unusual (brow, lip, nostril)
    std::optional<float> log_green; // median; measures how light the face is
};

Face coarse_face(const cv::Mat3f& skin)
{
    Face face{cv::Mat3f(skin_grid, skin_grid, Vec3f::all(0)), cv::Mat1f(skin_grid, skin_grid, 0.f),
              std::nullopt};
    if (skin.empty())
        return face;
    cv::Mat3f known_color(skin.size());
    cv::Mat1f known(skin.size());
    for (int y = 0; y < skin.rows; ++y)
        for (int x = 0; x < skin.cols; ++x) {
            const Vec3f color = skin(y, x);
            known(y, x) = is_finite(color) ? 1 : 0;
            known_color(y, x) = is_finite(color) ? color : Vec3f::all(0);
        }
    known_color = coarse(known_color);
    known = coarse(known);
    std::vector<float> lightness;
    for (int y = 0; y < skin_grid; ++y)
        for (int x = 0; x < skin_grid; ++x)
            if (known(y, x) > .5f) {
                for (int k = 0; k < 3; ++k)
                    face.log_color(y, x)[k] =
                        std::log(std::clamp(known_color(y, x)[k] / known(y, x), darkest, 1.f));
                face.weight(y, x) = known(y, x);
                lightness.push_back(face.log_color(y, x)[1]);
            }
    if (lightness.empty())
        return face;
    const auto middle = lightness.begin() + std::ptrdiff_t(lightness.size() / 2);
    std::nth_element(lightness.begin(), middle, lightness.end());
    face.log_green = *middle;
    for (int y = 0; y < skin_grid; ++y)
        for (int x = 0; x < skin_grid; ++x) {
            const float off = (face.log_color(y, x)[1] - *face.log_green) / .45f;
            face.weight(y, x) *= std::exp(-.5f * off * off);
        }
    return face;
}

/// For a photograph without healthy skin: the face's skin colour, or else average_skin, with health 0
/// everywhere.
HealthySkin assumed_skin(const Face& face)
{
    HealthySkin skin;
    skin.outwardness = cv::Mat1f(skin_grid, skin_grid, 1.f);
    skin.health = cv::Mat1f(skin_grid, skin_grid, 0.f);
    skin.foreignness = cv::Mat1f(skin_grid, skin_grid, 0.f);
    skin.rawness = cv::Mat1f(skin_grid, skin_grid, 1.f);
    const cv::Scalar mean = cv::mean(face.log_color, face.weight > .5f);
    if (face.log_green)
        skin.log_color = {float(mean[0]), float(mean[1]), float(mean[2])};
    else
        cv::log(Vec3f(base::linear_from_lab(average_skin)), skin.log_color);
    return skin;
}

/// Log gain of the bed for a photo whose skin is much darker than the face: .4 may be the patient's skin
/// tone, 80 % of the rest counts as underexposure. 0..0.5: it never darkens, because blood is as red on dark
/// skin.
float lift(const HealthySkin& skin, const Face& face)
{
    return face.log_green ? std::clamp(.8f * (*face.log_green - skin.log_color[1] - .4f), 0.f, .5f) : 0;
}

/// The part of a log ratio that is equal in all channels, after subtracting the effect of blood: a shadow or
/// a fold, which belongs to the photo's light and not to the wound. Least squares of -amount *
/// blood_absorbance + even * (1,1,1).
float even_part(const Vec3f& log_ratio)
{
    const Vec3f& blood = blood_absorbance;
    const float bb = blood.dot(blood), b1 = blood[0] + blood[1] + blood[2];
    const float rb = log_ratio.dot(blood), r1 = log_ratio[0] + log_ratio[1] + log_ratio[2];
    return (r1 * bb - rb * b1) / (3 * bb - b1 * b1);
}

/// Added to the photo's log colour around the wound: changes its skin to the face's and removes its shadows.
cv::Mat3f skin_gain(const cv::Mat3f& log_photo, const HealthySkin& skin, const Face& face)
{
    cv::Mat3f difference = face.log_color - log_photo;
    cv::Mat3f gain = membrane(difference, skin.health.mul(face.weight));
    const cv::Mat3f healthy = membrane(log_photo, skin.health);
    cv::Mat1f shade(skin_grid, skin_grid);
    for (int y = 0; y < skin_grid; ++y)
        for (int x = 0; x < skin_grid; ++x) {
            const float even = even_part(log_photo(y, x) - healthy(y, x));
            const float beyond = even - std::clamp(even, -.05f, .05f); // .05 is the variation between pores
            shade(y, x) = std::clamp(beyond, -2.f, 2.f) * base::smoothstep(.05f, .5f, skin.outwardness(y, x));
        }
    cv::GaussianBlur(shade, shade, {7, 7}, 1.5);
    for (int y = 0; y < skin_grid; ++y)
        for (int x = 0; x < skin_grid; ++x)
            gain(y, x) -= Vec3f::all(shade(y, x));
    return gain;
}

/// 1 in the patch, falling to 0 at its frame and where the photo has no data.
float present(const cv::Mat1f& valid_around, int x, int y)
{
    const int n = valid_around.rows;
    const int to_frame = std::min({x, y, n - 1 - x, n - 1 - y});
    return base::smoothstep(0, .05f * float(n), float(to_frame)) *
           base::smoothstep(.6f, 1, valid_around(y, x));
}

template <class Map>
Map enlarged(const Map& map, int n)
{
    Map result;
    cv::resize(map, result, {n, n}, 0, 0, cv::INTER_LINEAR);
    return result;
}

/// Added to the log colour of the photo's healthy skin: replaces its pores, hairs and stubble, which the
/// coarse grid does not resolve, by the face's; 0 where the face is unknown.
cv::Mat3f detail_change(const cv::Mat3f& face_skin, const Face& face, const cv::Mat3f& log_photo,
                        const cv::Mat3f& log_coarse)
{
    const int n = log_photo.rows;
    cv::Mat3f change(n, n, Vec3f::all(0)), skin;
    if (face_skin.rows < n / 2)
        return change; // too coarse to resolve them
    cv::resize(face_skin, skin, {n, n}, 0, 0, face_skin.rows > n ? cv::INTER_AREA : cv::INTER_LINEAR);
    const cv::Mat3f smooth_face = enlarged(face.log_color, n), smooth_photo = enlarged(log_coarse, n);
    cv::Mat1f known;
    cv::Mat1b(face.weight > 0).convertTo(known, CV_32F, 1 / 255.);
    known = enlarged(known, n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (int k = 0; k < 3 && known(y, x) > .99f && is_finite(skin(y, x)); ++k) {
                const float own = std::log(std::clamp(skin(y, x)[k], darkest, 1.f)) - smooth_face(y, x)[k];
                change(y, x)[k] = std::clamp(own, -1.5f, .5f) - (log_photo(y, x)[k] - smooth_photo(y, x)[k]);
            }
    return change;
}

cv::Mat1f blurred(const cv::Mat1f& map, float sigma)
{
    cv::Mat1f result;
    cv::GaussianBlur(map, result, {0, 0}, sigma);
    return result;
}

} // namespace

Patch match_to_skin(const Patch& patch, const cv::Mat3f& face_skin)
{
    Source source = checked(patch);
    const int n = source.color.rows;
    Patch result{cv::Mat3f(n, n), cv::Mat1f(n, n), patch.mask, patch.depth_mm, patch.width_mm, true,
                 patch.layer};

    remove_highlights(source.color, source.coverage, source.radius);
    cv::Mat3f log_photo;
    cv::log(source.color, log_photo);

    const cv::Mat3f log_coarse = coarse(log_photo);
    const cv::Mat1f covered = coarse(source.coverage);
    const float reach = source.reach * skin_grid / float(n);
    const Face face = coarse_face(face_skin);
    HealthySkin skin =
        patch.shows_skin ? find_healthy_skin(log_coarse, covered, coarse(source.valid), std::max(reach, 3.f))
                         : HealthySkin{};
    if (!skin.found)
        skin = assumed_skin(face);
    result.shows_skin = skin.found;
    const Vec3f bed =
        bed_gain(skin.log_color, blue_of_blood(log_coarse, covered)) + Vec3f::all(lift(skin, face));

    const cv::Mat3f gain =
        skin.found ? enlarged(skin_gain(log_coarse, skin, face), n) : cv::Mat3f(n, n, Vec3f::all(0));
    const cv::Mat3f detail = detail_change(face_skin, face, log_photo, log_coarse);
    const cv::Mat1f outwardness = enlarged(skin.outwardness, n), health = enlarged(skin.health, n);
    const cv::Mat1f rawness = enlarged(skin.rawness, n), foreignness = enlarged(skin.foreignness, n);
    const cv::Mat1f border = blurred(source.coverage, std::max(.8f, .012f * source.radius));
    const cv::Mat1f valid_around = blurred(source.valid, 2);

    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const float in_bed = base::smoothstep(.1f, .9f, border(y, x));
            const float around = skin.found ? 1 - base::smoothstep(.22f, .90f, outwardness(y, x)) : 0;
            result.opacity(y, x) = std::max(in_bed, around) * present(valid_around, x, y);
            const float raw = in_bed * rawness(y, x) + (1 - in_bed) * foreignness(y, x);
            log_photo(y, x) += (gain(y, x) + detail(y, x) * health(y, x)) * (1 - raw) + bed * raw;
        }
    cv::exp(log_photo, result.color);
    cv::min(result.color, cv::Scalar::all(1), result.color);
    return result;
}

} // namespace wound
