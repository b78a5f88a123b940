#include "wound/photo/wound_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/smoothstep.hpp"
#include "wound/photo/segmentation.hpp"

namespace wound {

namespace {

using Outline = std::vector<cv::Point>;
using Outlines = std::vector<Outline>;

constexpr int level_count = 40;
constexpr double least_share = 1e-3, most_share = .4; // a wound's share of the picture's area
constexpr float uneven_skin = 2;                      // CIELAB units; contrast within healthy skin
constexpr float strongest = 30;                       // CIELAB units; larger contrast counts as this
constexpr double most_cut = .25;      // largest share of a wound's border near the picture's edge
constexpr double least_score = 1;     // plain skin on a limb reaches .9
constexpr double least_of_best = .15; // smallest score of a further wound, relative to the best
constexpr double nearly_best = .7;    // smallest score, relative to the best, of a region that votes on it
constexpr int least_of_largest = 20;  // a wound has at least 1/20 of the largest one's area, see components()

/// 0..1: whether skin can have the colour in some light: hue from rose to yellow, not grey.
float skin_likeness(const cv::Vec3f& lab)
{
    const float chroma = std::hypot(lab[1], lab[2]);
    const float hue_deg = std::atan2(lab[2], lab[1]) * 57.29578F;
    return base::smoothstep(4, 10, chroma) * base::smoothstep(-40, -10, hue_deg) *
           base::smoothstep(100, 80, hue_deg);
}

struct Picture
{
    cv::Mat3f lab;   // slightly blurred
    cv::Mat1b shown; // 255 where there is a picture, see picture_area()
    cv::Mat1f skin;  // 0..1, skin_likeness()
    cv::Mat1b body;  // 255 on skin and regions that skin encloses
    double area = 0; // number of pixels in `shown`
    int detail = 0;  // pixels; narrower features are ignored
};

/// 255 on regions of dense skin-like pixels that cover at least 1/50 of the picture.
cv::Mat1b body_of(const Picture& picture)
{
    cv::Mat1b close = picture.skin > .3F;
    close &= picture.shown;
    cv::morphologyEx(close, close, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {picture.detail, picture.detail}));
    Outlines outlines;
    cv::findContours(close, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    std::erase_if(outlines, [&](const Outline& o) { return cv::contourArea(o) < .02 * picture.area; });
    cv::Mat1b body = cv::Mat1b::zeros(close.size());
    cv::drawContours(body, outlines, -1, 255, cv::FILLED);
    return body & picture.shown;
}

Picture study(const cv::Mat3f& lab, const cv::Mat1b& shown)
{
    Picture picture;
    cv::GaussianBlur(lab, picture.lab, {}, 1.5);
    picture.shown = shown;
    picture.area = cv::countNonZero(shown);
    picture.detail = std::max(lab.cols, lab.rows) / 40 | 1;
    picture.skin = cv::Mat1f(lab.size());
    std::transform(picture.lab.begin(), picture.lab.end(), picture.skin.begin(), skin_likeness);
    if (cv::mean(picture.skin, shown)[0] < .25) // coloured light or pale skin: hue gives no information
        picture.skin.setTo(1);
    picture.body = body_of(picture);
    return picture;
}

/// Maps on which wounds stand out: redness, darkness, both, and darkness without redness (dead tissue).
std::array<cv::Mat1f, 4> maps_of(const cv::Mat3f& lab)
{
    cv::Mat1f lightness, redness;
    cv::extractChannel(lab, lightness, 0);
    cv::extractChannel(lab, redness, 1);
    return {redness, -lightness, redness - .5F * lightness, -redness - .5F * lightness};
}

/// Removes fine texture and keeps sharp borders.
cv::Mat3f coarse(const cv::Mat3f& lab, int size)
{
    std::array<cv::Mat, 3> channels;
    cv::Mat3f result(lab.size());
    for (int i = 0; i < 3; ++i) {
        cv::Mat bytes, smoothed;
        cv::extractChannel(lab, bytes, i);
        bytes.convertTo(bytes, CV_8U, 1.25, i == 0 ? 0 : 128);
        cv::medianBlur(bytes, bytes, size | 1);
        bytes.convertTo(smoothed, CV_32F, .8, i == 0 ? 0 : -.8 * 128);
        cv::insertChannel(smoothed, result, i);
    }
    return result;
}

/// Factor on the contrast beside skin of that lightness: in shade and on dark skin all differences of colour
/// shrink with the light that comes back.
float in_full_light(float lightness)
{
    constexpr float lit = 60, most = 1.5F; // CIELAB; noise does not shrink, so the factor has a limit
    return std::clamp(std::sqrt(lit / std::max(lightness, 1.F)), 1.F, most);
}

/// Mean contrast of a border times the cube of its closed share; 0 if the picture's edge is near more than
/// most_cut of it. Outside the border must be skin; points where the body ends (a wound at a limb's edge) are
/// neither closed nor open.
double border_score(const Picture& picture, const Outline& outline, double area)
{
    const double reach = std::max(2., .09 * std::sqrt(area));
    const int n = static_cast<int>(outline.size());
    const int span = std::min(static_cast<int>(reach), n / 3);
    const double turn = cv::contourArea(outline, true) > 0 ? 1 : -1;
    const cv::Rect frame(cv::Point(), picture.shown.size());
    double sum = 0;
    int cut = 0, beside_body = 0;
    std::vector<float> contrasts;
    for (int i = 0; i < n; ++i) {
        const cv::Point2d along = outline[(i + span) % n] - outline[(i + n - span) % n];
        const double length = std::hypot(along.x, along.y);
        if (length == 0)
            continue;
        const cv::Point2d inward = cv::Point2d(-along.y, along.x) * (turn * reach / length);
        const cv::Point in = cv::Point2d(outline[i]) + inward, out = cv::Point2d(outline[i]) - inward;
        const cv::Point beyond = cv::Point2d(outline[i]) - 2 * inward;
        if (!frame.contains(beyond) || !picture.shown(beyond))
            ++cut;
        else if (!picture.body(out))
            ++beside_body;
        else if (frame.contains(in)) {
            const cv::Vec3f step = picture.lab(in) - picture.lab(out);
            const float contrast =
                (std::max(step[1], 0.F) + .5F * std::max(-step[0], 0.F)) * in_full_light(picture.lab(out)[0]);
            contrasts.push_back(std::clamp(contrast - uneven_skin, 0.F, strongest) * picture.skin(out));
            sum += contrasts.back();
        }
    }
    if (cut > most_cut * n)
        return 0;
    const double mean = sum / n;
    const auto strong =
        std::count_if(contrasts.begin(), contrasts.end(), [&](float c) { return c > .4 * mean; });
    return mean * std::pow(strong / std::max(1., double(n - beside_body)), 3);
}

struct Scored
{
    Outline outline;
    double score = 0;
};

/// Score of a region: border_score(), higher for a larger and more compact region.
double score_of(const Picture& picture, const Outline& outline)
{
    const double area = cv::contourArea(outline);
    if (outline.size() < 12 || area < least_share * picture.area || area > most_share * picture.area)
        return 0;
    Outline hull;
    cv::convexHull(outline, hull);
    const double solidity = area / cv::contourArea(hull);
    return border_score(picture, outline, area) * solidity * solidity * std::cbrt(area / picture.area);
}

/// Scores every region on the body in which `map` is above one of level_count levels.
void score_levels(const Picture& picture, const cv::Mat1f& map, int brush_size, std::vector<Scored>& scored)
{
    if (cv::countNonZero(picture.body) == 0)
        return;
    double low = 0, high = 0;
    cv::minMaxLoc(map, &low, &high, nullptr, nullptr, picture.body);
    const cv::Mat brush = cv::getStructuringElement(cv::MORPH_ELLIPSE, {brush_size, brush_size});
    for (int level = 1; level < level_count; ++level) {
        cv::Mat1b above = map > low + (high - low) * level / level_count;
        above &= picture.body;
        cv::morphologyEx(above, above, cv::MORPH_OPEN, brush);
        Outlines outlines;
        cv::findContours(above, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
        for (Outline& outline : outlines)
            if (const double score = score_of(picture, outline); score > 0)
                scored.push_back({std::move(outline), score});
    }
}

cv::Mat1b filled(const Outline& outline, cv::Size size)
{
    cv::Mat1b region = cv::Mat1b::zeros(size);
    cv::drawContours(region, Outlines{outline}, 0, 255, cv::FILLED);
    return region;
}

/// Majority vote, weighted by score, of the regions that overlap `best` and score nearly as much: more stable
/// than `best` alone when a diffuse rim has several equally sharp borders. `scored`: the best first.
cv::Mat1b agreed(const std::vector<Scored>& scored, const Scored& best, cv::Size size)
{
    const cv::Mat1b region = filled(best.outline, size);
    cv::Mat1f votes = cv::Mat1f::zeros(size);
    double cast = 0;
    for (const Scored& one : scored) {
        if (one.score < nearly_best * best.score)
            break;
        if ((cv::boundingRect(one.outline) & cv::boundingRect(best.outline)).empty())
            continue;
        const cv::Mat1b other = filled(one.outline, size);
        if (intersection_over_union(other, region) < .5)
            continue;
        cv::add(votes, one.score, votes, other);
        cast += one.score;
    }
    return components(votes > .5 * cast, 1).front();
}

} // namespace

std::vector<WoundCandidate> wound_candidates(const cv::Mat3f& lab, const cv::Mat1b& shown,
                                             std::optional<cv::Point> seed)
{
    const Picture picture = study(lab, shown);
    std::vector<Scored> scored;
    for (const cv::Mat1f& map : maps_of(picture.lab))
        score_levels(picture, map, 3, scored);
    for (const cv::Mat1f& map : maps_of(coarse(lab, 2 * picture.detail)))
        score_levels(picture, map, picture.detail, scored);
    std::erase_if(scored, [&](const Scored& one) {
        return seed ? cv::pointPolygonTest(one.outline, *seed, false) < 0 : one.score < least_score;
    });
    std::stable_sort(scored.begin(), scored.end(),
                     [](const Scored& a, const Scored& b) { return a.score > b.score; });
    std::vector<WoundCandidate> result;
    cv::Mat1b taken = cv::Mat1b::zeros(lab.size());
    for (const Scored& one : scored) {
        if (one.score < least_of_best * scored.front().score)
            break;
        if (cv::countNonZero(filled(one.outline, lab.size()) & taken) > 0)
            continue;
        WoundCandidate candidate{agreed(scored, one, lab.size()) & ~taken, {}, {}, one.score};
        if (cv::countNonZero(candidate.region) == 0)
            continue;
        candidate.bounds = cv::boundingRect(candidate.region);
        taken |= candidate.region | filled(one.outline, lab.size());
        cv::Mat1f depth;
        cv::distanceTransform(candidate.region, depth, cv::DIST_L2, 3);
        cv::minMaxLoc(depth, nullptr, nullptr, nullptr, &candidate.deepest);
        result.push_back(std::move(candidate));
    }
    const auto area = [](const WoundCandidate& candidate) { return cv::countNonZero(candidate.region); };
    int largest = 0;
    for (const WoundCandidate& candidate : result)
        largest = std::max(largest, area(candidate));
    std::erase_if(result, [&](const WoundCandidate& one) { return least_of_largest * area(one) < largest; });
    return result;
}

} // namespace wound
