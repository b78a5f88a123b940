// How far a picture is from its path-traced truth, for each region of the picture apart.
#pragma once
#include <opencv2/core.hpp>

#include "base/progress.hpp"
#include "reference/regions.hpp"
#include "scene/shots.hpp"
#include "stage/renderer.hpp"

namespace stage {

/// CIEDE2000 between a picture and the truth in one region; pixels = 0 when the picture does not show it.
struct RegionError
{
    std::size_t pixels = 0;
    double mean = 0, p95 = 0, p999 = 0, max = 0;
    double l = 0, a = 0, b = 0; // means of picture - truth, CIELAB
    double noise = 0;           // mean difference that two such truths would have
};

/// Per pixel; all of one size.
struct PixelErrors
{
    cv::Mat1f de, noise; // CIEDE2000
    cv::Mat3f lab;       // picture - truth
};
RegionError error_in(const cv::Mat1b& region, const PixelErrors& errors);

/// The truth of a shot, for any number of pictures of it.
struct ShotTruth
{
    reference::Truth traced;
    cv::Mat4f radiance;         // of it
    cv::Mat1f noise;            // CIEDE2000 between two such truths
    reference::Regions regions; // of the shot
    double exposure_stops = 0;
};
/// Asks for the truth. Throws base::InputError, and base::Interrupted after Ctrl-C.
ShotTruth find_shot_truth(const scene::LoadedScene& scene, const scene::Shot& shot,
                          const reference::Levels& levels, const reference::Until& until,
                          base::Progress& progress, std::vector<std::string>& notes);

/// The shot as the truth is sampled: drawn larger and averaged. Premultiplied linear radiance.
cv::Mat4f supersampled(Renderer& renderer, const Stage& stage, const scene::Shot& shot);

struct TruthError
{
    cv::Mat4f ours,
        truth; // premultiplied linear radiance; ours is drawn larger and averaged, as the truth is
    PixelErrors errors;
    reference::Regions regions; // without pixels that the head covers in part
    cv::Mat1b shown;            // all regions
};
/// `ours`: premultiplied linear radiance of the truth's size.
TruthError error_of(const cv::Mat4f& ours, const ShotTruth& truth);

/// Draws the shot and asks for its truth. Throws base::InputError, and base::Interrupted after Ctrl-C.
std::pair<TruthError, reference::Truth>
measure_truth_error(Renderer& renderer, const Stage& stage, const scene::Shot& shot,
                    const reference::Levels& levels, const reference::Until& until, base::Progress& progress,
                    std::vector<std::string>& notes);

} // namespace stage
