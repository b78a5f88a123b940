#include "wound/photo/grab_cut.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wound/photo/segmentation.hpp"

namespace wound {

namespace {

constexpr int cluster_count = 8;
constexpr int iterations = 4;

/// A disk around the seed, certain to be wound.
cv::Mat1b seed_disk(const CutProblem& problem)
{
    cv::Mat1b disk = cv::Mat1b::zeros(problem.srgb.size());
    const int radius = std::max(2, std::min(problem.rect.width, problem.rect.height) / 12);
    cv::circle(disk, problem.seed, radius, 255, cv::FILLED);
    return disk & problem.picture;
}

/// Certain to be skin: what lies outside the rectangle.
cv::Mat1b surroundings(const CutProblem& problem)
{
    cv::Mat1b outside = problem.picture.clone();
    outside(problem.rect).setTo(0);
    return outside;
}

/// 255 where a pixel's colour cluster is more frequent near the seed than in the surroundings.
cv::Mat1b likely_wound(const CutProblem& problem, const cv::Mat1b& outside)
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
    const int clusters = std::min(cluster_count, samples.rows);
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

/// 255 where a pixel is too far from the guess to be wound.
cv::Mat1b far_from(const cv::Mat1b& guess)
{
    const int reach = std::max(3, static_cast<int>(.15 * std::sqrt(cv::countNonZero(guess))));
    cv::Mat1b near;
    cv::dilate(guess, near, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
    return near == 0;
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

} // namespace

cv::Mat1b solve(const CutProblem& problem)
{
    const cv::Mat1b outside = surroundings(problem);
    const cv::Mat1b seed = seed_disk(problem);
    const cv::Mat1b likely = problem.guess.empty() ? likely_wound(problem, outside) : problem.guess;
    cv::Mat1b labels(problem.srgb.size(), static_cast<uchar>(cv::GC_BGD));
    labels(problem.rect).setTo(cv::GC_PR_BGD);
    cv::Mat1b candidates = cv::Mat1b::zeros(labels.size());
    likely(problem.rect).copyTo(candidates(problem.rect));
    labels.setTo(cv::GC_PR_FGD, candidates);
    if (!problem.guess.empty())
        labels.setTo(cv::GC_BGD, far_from(problem.guess));
    labels.setTo(cv::GC_FGD, seed);
    labels.setTo(cv::GC_BGD, problem.picture == 0);
    if (cv::countNonZero(seed) == 0 || cv::countNonZero(outside) == 0)
        return cv::Mat1b::zeros(labels.size());

    cv::theRNG().state = 1; // GrabCut uses it; the same photograph always gives the same mask
    cv::Mat background, foreground;
    cv::grabCut(problem.srgb, labels, {}, background, foreground, iterations, cv::GC_INIT_WITH_MASK);
    cv::Mat1b mask = (labels == cv::GC_FGD) | (labels == cv::GC_PR_FGD);
    const cv::Mat brush = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
    cv::morphologyEx(mask, mask, cv::MORPH_OPEN, brush);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, brush);
    return main_component(mask, problem.seed);
}

BorderContrast border_contrast(const CutProblem& problem, const cv::Mat1b& mask)
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

CutProblem pose(const cv::Mat3b& srgb, const cv::Rect& rect, cv::Point seed, int working_size)
{
    CutProblem problem;
    problem.frame =
        cv::Rect(rect.x - rect.width / 2, rect.y - rect.height / 2, 2 * rect.width, 2 * rect.height) &
        cv::Rect(cv::Point(), srgb.size());
    const double scale =
        std::min(1., working_size / static_cast<double>(std::max(problem.frame.width, problem.frame.height)));
    cv::Mat3b small;
    cv::resize(srgb(problem.frame), small, {}, scale, scale, cv::INTER_AREA);
    cv::medianBlur(small, problem.srgb, 5); // removes hairs and specular highlights
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

} // namespace wound
