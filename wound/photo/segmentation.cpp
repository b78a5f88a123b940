#include "wound/photo/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "base/input_error.hpp"
#include "wound/photo/grab_cut.hpp"
#include "wound/photo/wound_candidates.hpp"

namespace wound {

namespace {

constexpr int working_size = 400;    // pixels on the longer side
constexpr double least_contrast = 5; // CIELAB distance across a wound's border, on average
constexpr int least_side = 16;       // pixels of a photograph

/// Of several rectangles around the seed, the one in which the border found has the highest contrast.
cv::Rect best_rectangle(const cv::Mat3b& srgb, const cv::Rect& bounds, cv::Point seed)
{
    constexpr int trial_size = 192;
    cv::Rect best = bounds;
    double sharpest = -1;
    for (double size : {.75, .6, .48, .38, .3, .24}) {
        const cv::Size half(static_cast<int>(.5 * size * bounds.width),
                            static_cast<int>(.5 * size * bounds.height));
        const cv::Rect inner(bounds.x + bounds.width / 16, bounds.y + bounds.height / 16,
                             bounds.width * 7 / 8, bounds.height * 7 / 8);
        const cv::Rect rect =
            cv::Rect(seed.x - half.width, seed.y - half.height, 2 * half.width, 2 * half.height) & inner;
        if (rect.width < 8 || rect.height < 8)
            continue;
        const CutProblem problem = pose(srgb, rect, seed, trial_size);
        const double contrast = border_contrast(problem, solve(problem)).wound_like;
        if (contrast > sharpest) {
            sharpest = contrast;
            best = rect;
        }
    }
    return best;
}

/// The bounding box of picture_area(), computed at reduced size.
cv::Rect picture_bounds(const cv::Mat3b& srgb)
{
    const double scale = std::min(1., 1024. / std::max(srgb.cols, srgb.rows));
    cv::Mat3b small;
    cv::resize(srgb, small, {}, scale, scale, cv::INTER_AREA);
    const cv::Rect found = cv::boundingRect(picture_area(small));
    return cv::Rect(cvFloor(found.x / scale), cvFloor(found.y / scale), cvCeil(found.width / scale),
                    cvCeil(found.height / scale)) &
           cv::Rect(cv::Point(), srgb.size());
}

/// `mask`, resampled from the maps of `from` to those of `to`.
cv::Mat1b moved(const cv::Mat1b& mask, const CutProblem& from, const CutProblem& to)
{
    const double there = double(from.srgb.cols) / from.frame.width; // map pixels per photograph pixel
    const double here = double(to.frame.width) / to.srgb.cols;
    const cv::Point2d offset = cv::Point2d(to.frame.tl() - from.frame.tl()) * there;
    const double half = .5 * here * there - .5; // aligns the pixels' centres
    const cv::Matx23d inverse(here * there, 0, offset.x + half, 0, here * there, offset.y + half);
    cv::Mat1b result;
    cv::warpAffine(mask, result, inverse, to.srgb.size(), cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
    return result;
}

/// Excludes other wounds from the picture and paints them in skin colour, so GrabCut does not learn them.
void leave_out(CutProblem& problem, const cv::Mat1b& others)
{
    problem.picture.setTo(0, others);
    cv::Mat1b around = problem.picture.clone();
    around(problem.rect).setTo(0);
    problem.srgb.setTo(cv::mean(problem.srgb, around), others);
}

/// The problem of a candidate found in `field`: its bounds with a margin of 15 % and 2 pixels on each side.
CutProblem pose_around(const cv::Mat3b& srgb, const CutProblem& field, const WoundCandidate& candidate)
{
    const double scale = double(field.frame.width) / field.srgb.cols;
    const cv::Rect& b = candidate.bounds;
    const cv::Point margin(b.width * 3 / 20 + 2, b.height * 3 / 20 + 2);
    const auto in_photograph = [&](cv::Point p) {
        return cv::Point(cv::Point2d(p) * scale) + field.frame.tl();
    };
    const cv::Rect rect(in_photograph(b.tl() - margin), in_photograph(b.br() + margin));
    return pose(srgb, rect & field.frame, in_photograph(candidate.deepest), working_size);
}

/// One problem for every wound that the hints select; none if nothing looks like a wound.
std::vector<CutProblem> problems(const cv::Mat3b& srgb, const SegmentationHints& hints,
                                 const cv::Rect& bounds)
{
    const cv::Rect rect = hints.rect.value_or(bounds);
    const cv::Point seed = hints.seed.value_or((rect.tl() + rect.br()) / 2);
    const CutProblem field = pose(srgb, rect, seed, working_size);
    if (hints.rect && hints.seed)
        return {field};
    std::vector<WoundCandidate> candidates =
        wound_candidates(field.lab, field.picture, hints.seed ? std::optional(field.seed) : std::nullopt);
    std::erase_if(candidates, [&](const WoundCandidate& c) {
        return 5 * (c.bounds & field.rect).area() < 4 * c.bounds.area();
    });
    if (hints.rect && candidates.size() < 2) // the user's rectangle is better than a single candidate
        return {field};
    if (hints.seed && candidates.empty())
        return {pose(srgb, best_rectangle(srgb, bounds, seed), seed, working_size)};
    cv::Mat1b all = cv::Mat1b::zeros(field.srgb.size());
    for (const WoundCandidate& candidate : candidates)
        all |= candidate.region;
    std::vector<CutProblem> result;
    for (const WoundCandidate& candidate : candidates) {
        CutProblem problem = pose_around(srgb, field, candidate);
        problem.guess = moved(candidate.region, field, problem);
        if (candidates.size() > 1)
            leave_out(problem, moved(all & ~candidate.region, field, problem));
        result.push_back(std::move(problem));
    }
    return result;
}

[[noreturn]] void no_wound(std::string_view where, std::string_view why)
{
    throw NoWound(where, fmt::format("no wound found: {}", why),
                  "give a seed inside it or a rectangle around it (--seed, --rect; "
                  "\"segmentation\" in a scene), or a mask");
}

} // namespace

cv::Mat1b fill_holes(const cv::Mat1b& mask)
{
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::Mat1b filled = cv::Mat1b::zeros(mask.size());
    cv::drawContours(filled, outlines, -1, 255, cv::FILLED);
    return filled;
}

cv::Mat1b picture_area(const cv::Mat3b& srgb)
{
    cv::Mat1b dark(srgb.size());
    std::transform(srgb.begin(), srgb.end(), dark.begin(), [](const cv::Vec3b& p) -> uchar {
        return std::max({p[0], p[1], p[2]}) < 12 ? 255 : 0;
    });
    cv::Mat1i labels;
    const int count = cv::connectedComponents(dark, labels);
    std::vector<bool> touches(count, false);
    for (int x = 0; x < dark.cols; ++x)
        touches[labels(0, x)] = touches[labels(dark.rows - 1, x)] = true;
    for (int y = 0; y < dark.rows; ++y)
        touches[labels(y, 0)] = touches[labels(y, dark.cols - 1)] = true;
    cv::Mat1b inside(srgb.size(), 255);
    for (int y = 0; y < dark.rows; ++y)
        for (int x = 0; x < dark.cols; ++x)
            if (dark(y, x) && touches[labels(y, x)])
                inside(y, x) = 0;
    return inside;
}

cv::Mat1b segment(const cv::Mat3b& srgb, const SegmentationHints& hints, std::string_view where)
{
    const cv::Rect whole(0, 0, srgb.cols, srgb.rows);
    if (srgb.cols < least_side || srgb.rows < least_side)
        throw base::InputError(where, fmt::format("{}x{} pixels are too few", srgb.cols, srgb.rows),
                               "give a larger photograph");
    if (hints.rect &&
        ((*hints.rect & whole) != *hints.rect || hints.rect->width < 8 || hints.rect->height < 8))
        throw base::InputError(where, "the rectangle reaches outside the photograph or is under 8 pixels",
                               "give X,Y,W,H in pixels inside it");
    if (hints.seed && !whole.contains(*hints.seed))
        throw base::InputError(where, "the seed lies outside the photograph", "give X,Y in pixels inside it");

    const cv::Rect bounds = picture_bounds(srgb);
    if (bounds.width < least_side || bounds.height < least_side)
        no_wound(where, "the photograph is black");
    cv::Mat1b result = cv::Mat1b::zeros(srgb.size());
    std::string_view why = "no region stands out from the skin around it as a wound does";
    for (const CutProblem& problem : problems(srgb, hints, bounds)) {
        const cv::Mat1b mask = solve(problem);
        if (cv::countNonZero(mask) < 16) {
            why = "nothing near the seed differs from its surroundings";
        } else if (border_contrast(problem, mask).distance < least_contrast) {
            why = "the region found has nearly the colour of its surroundings";
        } else {
            cv::Mat1f coverage;
            mask.convertTo(coverage, CV_32F, 1 / 255.);
            cv::resize(coverage, coverage, problem.frame.size(), 0, 0, cv::INTER_LINEAR);
            result(problem.frame).setTo(255, coverage > .5);
        }
    }
    if (cv::countNonZero(result) == 0)
        no_wound(where, why);
    return result;
}

std::vector<cv::Mat1b> components(const cv::Mat1b& mask, std::size_t most)
{
    cv::Mat1i labels;
    cv::Mat stats, centroids;
    const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8);
    const auto area = [&stats](int label) { return stats.at<int>(label, cv::CC_STAT_AREA); };
    std::vector<int> order(std::max(count - 1, 0));
    std::iota(order.begin(), order.end(), 1);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area(a) > area(b); });
    std::vector<cv::Mat1b> result;
    cv::Mat1b taken = cv::Mat1b::zeros(mask.size());
    for (int label : order) {
        if (result.size() == most || 20 * area(label) < area(order.front()))
            break;
        const cv::Mat1b component = labels == label;
        if (cv::countNonZero(component & taken) > 0)
            continue;
        result.push_back(fill_holes(component));
        taken |= result.back();
    }
    return result;
}

cv::Mat1b checked_mask(const cv::Mat1b& mask, cv::Size photograph, std::string_view where)
{
    if (mask.size() != photograph)
        throw base::InputError(where,
                               fmt::format("the mask is {}x{}, the photograph {}x{}", mask.cols, mask.rows,
                                           photograph.width, photograph.height),
                               "give a mask of the photograph's size");
    const cv::Mat1b binary = mask > 127;
    if (cv::countNonZero(binary) == 0)
        throw base::InputError(where, "the mask is empty", "paint the wound white on black");
    if (std::min(mask.cols, mask.rows) < least_side &&
        cv::countNonZero(binary) == static_cast<int>(binary.total()))
        throw base::InputError(
            where, fmt::format("{}x{} pixels, all of them wound, are too few", mask.cols, mask.rows),
            "give a larger photograph");
    return components(binary, 1).front();
}

double intersection_over_union(const cv::Mat1b& a, const cv::Mat1b& b)
{
    const int either = cv::countNonZero(a | b);
    return either == 0 ? 1 : static_cast<double>(cv::countNonZero(a & b)) / either;
}

} // namespace wound
