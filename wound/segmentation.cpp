#include "wound/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "wound/input_error.hpp"

namespace wound {

namespace {

constexpr int kWorkingSize = 400; // pixels on the longer side
constexpr int kClusters = 8;
constexpr int kGrabCutIterations = 4;
constexpr double kLeastContrast = 5; // CIELAB distance across a wound's border, on average
constexpr int kLeastSide = 16;       // pixels of a photograph

cv::Mat1b fill_holes(const cv::Mat1b& mask)
{
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::Mat1b filled = cv::Mat1b::zeros(mask.size());
    cv::drawContours(filled, outlines, -1, 255, cv::FILLED);
    return filled;
}

/// The wound and its surroundings as GrabCut is told about them, at working resolution.
struct Problem
{
    cv::Rect frame; // of the photograph, its pixels
    cv::Mat3b srgb;
    cv::Mat3f lab;
    cv::Mat1b picture; // 255 where there is a picture
    cv::Rect rect;     // the wound lies inside
    cv::Point seed;
};

/// A disk around the seed, certain to be wound.
cv::Mat1b seed_disk(const Problem& problem)
{
    cv::Mat1b disk = cv::Mat1b::zeros(problem.srgb.size());
    const int radius = std::max(2, std::min(problem.rect.width, problem.rect.height) / 12);
    cv::circle(disk, problem.seed, radius, 255, cv::FILLED);
    return disk & problem.picture;
}

/// Certain to be skin: what lies outside the rectangle.
cv::Mat1b surroundings(const Problem& problem)
{
    cv::Mat1b outside = problem.picture.clone();
    outside(problem.rect).setTo(0);
    return outside;
}

/// 255 where a pixel's colour cluster is more at home near the seed than in the surroundings.
cv::Mat1b likely_wound(const Problem& problem, const cv::Mat1b& outside)
{
    std::vector<cv::Vec3f> colors;
    std::vector<cv::Point> places;
    for (int y = 0; y < problem.lab.rows; ++y)
        for (int x = 0; x < problem.lab.cols; ++x)
            if (problem.picture(y, x)) {
                cv::Vec3f color = problem.lab(y, x);
                color[0] *= .5F; // lightness varies with shading more than with tissue
                colors.push_back(color);
                places.emplace_back(x, y);
            }
    cv::Mat1i labels;
    const cv::Mat samples(static_cast<int>(colors.size()), 3, CV_32F, colors.data());
    const int clusters = std::min(kClusters, samples.rows);
    cv::theRNG().state = 1;
    cv::kmeans(samples, clusters, labels, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, .1}, 3,
               cv::KMEANS_PP_CENTERS);

    // Near the seed: the ellipse within the rectangle, weighted towards its middle.
    std::vector<double> near(clusters, 0.), away(clusters, 0.);
    double all_near = 0, all_away = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double dx = (places[i].x - problem.seed.x) / (.5 * problem.rect.width);
        const double dy = (places[i].y - problem.seed.y) / (.5 * problem.rect.height);
        const double weight = std::exp(-4 * (dx * dx + dy * dy));
        near[labels(static_cast<int>(i))] += weight;
        all_near += weight;
        if (outside(places[i])) {
            away[labels(static_cast<int>(i))] += 1;
            all_away += 1;
        }
    }
    cv::Mat1b likely = cv::Mat1b::zeros(problem.lab.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int cluster = labels(static_cast<int>(i));
        if (near[cluster] / all_near > away[cluster] / std::max(all_away, 1.))
            likely(places[i]) = 255;
    }
    return likely;
}

/// The component that holds the seed, or else the largest.
cv::Mat1b main_component(const cv::Mat1b& mask, cv::Point seed)
{
    cv::Mat1i labels;
    cv::Mat stats, centroids;
    const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8);
    int chosen = labels(seed);
    for (int i = 1; i < count && labels(seed) == 0; ++i)
        if (chosen == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(chosen, cv::CC_STAT_AREA))
            chosen = i;
    return chosen == 0 ? cv::Mat1b::zeros(mask.size()) : fill_holes(labels == chosen);
}

cv::Mat1b solve(const Problem& problem)
{
    const cv::Mat1b outside = surroundings(problem);
    const cv::Mat1b seed = seed_disk(problem);
    const cv::Mat1b likely = likely_wound(problem, outside);
    cv::Mat1b labels(problem.srgb.size(), static_cast<uchar>(cv::GC_BGD));
    labels(problem.rect).setTo(cv::GC_PR_BGD);
    cv::Mat1b candidates = cv::Mat1b::zeros(labels.size());
    likely(problem.rect).copyTo(candidates(problem.rect));
    labels.setTo(cv::GC_PR_FGD, candidates);
    labels.setTo(cv::GC_FGD, seed);
    labels.setTo(cv::GC_BGD, problem.picture == 0);
    if (cv::countNonZero(seed) == 0 || cv::countNonZero(outside) == 0)
        return cv::Mat1b::zeros(labels.size());

    cv::theRNG().state = 1; // GrabCut draws from it: the same photograph always gives the same mask
    cv::Mat background, foreground;
    cv::grabCut(problem.srgb, labels, {}, background, foreground, kGrabCutIterations, cv::GC_INIT_WITH_MASK);
    cv::Mat1b mask = (labels == cv::GC_FGD) | (labels == cv::GC_PR_FGD);
    const cv::Mat brush = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
    cv::morphologyEx(mask, mask, cv::MORPH_OPEN, brush);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, brush);
    return main_component(mask, problem.seed);
}

/// How wound and skin differ across the mask's border, CIELAB, averaged along it.
struct BorderContrast
{
    double distance = 0;   // of the colours just inside and just outside
    double wound_like = 0; // how much redder and darker the inside is; a limb before a dark background is not
};

/// A border that is the rectangle's own counts as none.
BorderContrast border_contrast(const Problem& problem, const cv::Mat1b& mask)
{
    const int area = cv::countNonZero(mask);
    if (area == 0)
        return {};
    const int step = std::max(2, static_cast<int>(.06 * std::sqrt(area)));
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::Mat1f soft, slope_x, slope_y;
    mask.convertTo(soft, CV_32F);
    cv::GaussianBlur(soft, soft, {}, step);
    cv::Sobel(soft, slope_x, CV_32F, 1, 0);
    cv::Sobel(soft, slope_y, CV_32F, 0, 1);
    cv::Mat3f colors;
    cv::GaussianBlur(problem.lab, colors, {}, .5 * step);
    const cv::Rect picture(cv::Point(), mask.size());
    const cv::Rect interior(problem.rect.tl() + cv::Point(2, 2), problem.rect.br() - cv::Point(2, 2));
    BorderContrast sum;
    for (cv::Point p : outlines.front()) {
        const cv::Point2f inward(slope_x(p), slope_y(p));
        const float length = std::hypot(inward.x, inward.y);
        if (!interior.contains(p) || length == 0)
            continue;
        const cv::Point2f unit = inward * (1.5F * static_cast<float>(step) / length);
        const cv::Point inside(cvRound(p.x + unit.x), cvRound(p.y + unit.y));
        const cv::Point outside(cvRound(p.x - unit.x), cvRound(p.y - unit.y));
        if (!picture.contains(inside) || !picture.contains(outside) || !problem.picture(outside))
            continue;
        const cv::Vec3f difference = colors(inside) - colors(outside);
        sum.distance += cv::norm(difference);
        sum.wound_like += std::max(difference[1] - .5F * difference[0], 0.F);
    }
    const auto points = static_cast<double>(outlines.front().size());
    return {sum.distance / points, sum.wound_like / points};
}

/// The rectangle and as much again around it, at most `working_size` pixels on the longer side.
Problem pose(const cv::Mat3b& srgb, const cv::Rect& rect, cv::Point seed, int working_size)
{
    Problem problem;
    problem.frame =
        cv::Rect(rect.x - rect.width / 2, rect.y - rect.height / 2, 2 * rect.width, 2 * rect.height) &
        cv::Rect(cv::Point(), srgb.size());
    const double scale =
        std::min(1., working_size / static_cast<double>(std::max(problem.frame.width, problem.frame.height)));
    cv::Mat3b small;
    cv::resize(srgb(problem.frame), small, {}, scale, scale, cv::INTER_AREA);
    cv::medianBlur(small, problem.srgb, 5); // hairs, glints
    cv::Mat3f unit;
    problem.srgb.convertTo(unit, CV_32F, 1 / 255.);
    cv::cvtColor(unit, problem.lab, cv::COLOR_RGB2Lab);
    problem.picture = picture_area(problem.srgb);
    const auto scaled = [&](cv::Point p) {
        return cv::Point(cvRound((p.x - problem.frame.x) * scale), cvRound((p.y - problem.frame.y) * scale));
    };
    problem.rect =
        cv::Rect(scaled(rect.tl()), scaled(rect.br())) & cv::Rect(cv::Point(), problem.srgb.size());
    problem.seed = scaled(seed);
    problem.seed = {std::clamp(problem.seed.x, 0, problem.srgb.cols - 1),
                    std::clamp(problem.seed.y, 0, problem.srgb.rows - 1)};
    return problem;
}

/// Without a rectangle, the one of several sizes around the seed in which the sharpest closed border is
/// found.
cv::Rect best_rectangle(const cv::Mat3b& srgb, const cv::Rect& bounds, cv::Point seed)
{
    constexpr int kTrialSize = 192;
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
        const Problem problem = pose(srgb, rect, seed, kTrialSize);
        const double contrast = border_contrast(problem, solve(problem)).wound_like;
        if (contrast > sharpest) {
            sharpest = contrast;
            best = rect;
        }
    }
    return best;
}

/// Of picture_area(), found at a size at which it costs little.
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

[[noreturn]] void no_wound(std::string_view where, std::string_view why)
{
    throw NoWound(where, fmt::format("no wound found: {}", why),
                  "give a seed inside it or a rectangle around it (--seed, --rect; "
                  "\"segmentation\" in a scene), or a mask");
}

} // namespace

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
    if (srgb.cols < kLeastSide || srgb.rows < kLeastSide)
        throw cicatrix::InputError(where, fmt::format("{}x{} pixels are too few", srgb.cols, srgb.rows),
                                   "give a larger photograph");
    if (hints.rect &&
        ((*hints.rect & whole) != *hints.rect || hints.rect->width < 8 || hints.rect->height < 8))
        throw cicatrix::InputError(where, "the rectangle reaches outside the photograph or is under 8 pixels",
                                   "give X,Y,W,H in pixels inside it");
    if (hints.seed && !whole.contains(*hints.seed))
        throw cicatrix::InputError(where, "the seed lies outside the photograph",
                                   "give X,Y in pixels inside it");

    const cv::Rect bounds = picture_bounds(srgb);
    if (bounds.width < kLeastSide || bounds.height < kLeastSide)
        no_wound(where, "the photograph is black");
    const cv::Rect rect =
        hints.rect ? *hints.rect
                   : best_rectangle(srgb, bounds, hints.seed.value_or((bounds.tl() + bounds.br()) / 2));
    const Problem problem = pose(srgb, rect, hints.seed.value_or((rect.tl() + rect.br()) / 2), kWorkingSize);
    const cv::Mat1b mask = solve(problem);
    if (cv::countNonZero(mask) < 16)
        no_wound(where, "nothing near the seed differs from its surroundings");
    if (border_contrast(problem, mask).distance < kLeastContrast)
        no_wound(where, "what was found has nearly its surroundings' colour");
    cv::Mat1f coverage;
    mask.convertTo(coverage, CV_32F, 1 / 255.);
    cv::resize(coverage, coverage, problem.frame.size(), 0, 0, cv::INTER_LINEAR);
    cv::Mat1b result = cv::Mat1b::zeros(srgb.size());
    cv::Mat1b(coverage > .5).copyTo(result(problem.frame));
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
        throw cicatrix::InputError(where,
                                   fmt::format("the mask is {}x{}, the photograph {}x{}", mask.cols,
                                               mask.rows, photograph.width, photograph.height),
                                   "give a mask of the photograph's size");
    const cv::Mat1b binary = mask > 127;
    if (cv::countNonZero(binary) == 0)
        throw cicatrix::InputError(where, "the mask is empty", "paint the wound white on black");
    if (std::min(mask.cols, mask.rows) < kLeastSide &&
        cv::countNonZero(binary) == static_cast<int>(binary.total()))
        throw cicatrix::InputError(
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
