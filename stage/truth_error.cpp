#include "stage/truth_error.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "base/interrupt.hpp"
#include "base/statistics.hpp"
#include "base/tone_curve.hpp"

namespace stage {
namespace {

constexpr std::uint32_t supersampling = 4; // of our picture, per axis

PixelErrors errors_of(const cv::Mat4f& ours, const cv::Mat4f& truth, const cv::Mat1f& noise, double exposure)
{
    PixelErrors errors{cv::Mat1f(ours.size(), 0.f), noise, cv::Mat3f(ours.size(), cv::Vec3f::all(0))};
    for (int y = 0; y < ours.rows; ++y)
        for (int x = 0; x < ours.cols; ++x) {
            const double height = (y + .5) / ours.rows;
            const auto lab = [&](const cv::Vec4f& p) {
                return base::shown_lab({p[0], p[1], p[2]}, p[3], exposure, height);
            };
            const base::Lab a = lab(ours(y, x)), b = lab(truth(y, x));
            errors.de(y, x) = float(base::delta_e2000(a, b));
            errors.lab(y, x) = {float(a.l - b.l), float(a.a - b.a), float(a.b - b.b)};
        }
    return errors;
}

/// 255 where the head covers the pixel whole, in the picture and in the truth.
cv::Mat1b covered_whole(const cv::Mat4f& ours, const cv::Mat4f& truth)
{
    std::array<cv::Mat1f, 2> alpha;
    cv::extractChannel(ours, alpha[0], 3);
    cv::extractChannel(truth, alpha[1], 3);
    return (alpha[0] >= .999f) & (alpha[1] >= .999f);
}

} // namespace

RegionError error_in(const cv::Mat1b& region, const PixelErrors& errors)
{
    RegionError error;
    std::vector<double> values;
    cv::Vec3d lab(0, 0, 0);
    for (int y = 0; y < region.rows; ++y)
        for (int x = 0; x < region.cols; ++x)
            if (region(y, x)) {
                values.push_back(double(errors.de(y, x)));
                error.noise += double(errors.noise(y, x));
                error.mean += double(errors.de(y, x));
                lab += cv::Vec3d(errors.lab(y, x));
            }
    error.pixels = values.size();
    if (values.empty())
        return error;
    const double count = double(values.size());
    error.noise /= count;
    error.mean /= count;
    error.l = lab[0] / count;
    error.a = lab[1] / count;
    error.b = lab[2] / count;
    error.p95 = base::quantile(values, .95);
    error.p999 = base::quantile(values, .999);
    error.max = *std::ranges::max_element(values);
    return error;
}

ShotTruth find_shot_truth(const scene::LoadedScene& scene, const scene::Shot& shot,
                          const reference::Levels& levels, const reference::Until& until,
                          base::Progress& progress, std::vector<std::string>& notes)
{
    const reference::Request request{
        .camera = shot.camera, .size = scene.scene.size, .day = shot.day, .levels = levels};
    ShotTruth truth{.traced = reference::find_truth(scene, request, until, progress, notes)};
    if (truth.traced.interrupted || truth.traced.picture.passes() < 2)
        throw base::Interrupted();
    truth.exposure_stops = scene.scene.exposure_stops;
    truth.radiance = truth.traced.picture.radiance();
    truth.noise = truth.traced.picture.noise_map(truth.exposure_stops);
    truth.regions = reference::find_regions(scene, request);
    return truth;
}

cv::Mat4f supersampled(Renderer& renderer, const Stage& stage, const scene::Shot& shot)
{
    DrawOptions drawing;
    for (std::size_t axis = 0; axis < 2; ++axis)
        drawing.size[axis] = supersampling * stage.scene().size[axis];
    drawing.transparent = drawing.radiance = true;
    drawing.areas = false;
    const cv::Mat4f large = draw(renderer, stage, shot, drawing).radiance;
    cv::Mat4f mean;
    cv::resize(large, mean, large.size() / int(supersampling), 0, 0, cv::INTER_AREA);
    return mean;
}

TruthError error_of(const cv::Mat4f& ours, const ShotTruth& truth)
{
    TruthError result{.ours = ours, .truth = truth.radiance};
    result.errors = errors_of(ours, truth.radiance, truth.noise, truth.exposure_stops);
    result.shown = cv::Mat1b(ours.size(), uchar(0));
    const cv::Mat1b whole = covered_whole(ours, truth.radiance);
    for (std::size_t i = 0; i < truth.regions.size(); ++i) {
        result.regions[i] = truth.regions[i] & whole;
        result.shown |= result.regions[i];
    }
    return result;
}

std::pair<TruthError, reference::Truth>
measure_truth_error(Renderer& renderer, const Stage& stage, const scene::Shot& shot,
                    const reference::Levels& levels, const reference::Until& until, base::Progress& progress,
                    std::vector<std::string>& notes)
{
    ShotTruth truth = find_shot_truth(stage.loaded(), shot, levels, until, progress, notes);
    progress.show(shot.name);
    TruthError error = error_of(supersampled(renderer, stage, shot), truth);
    return {std::move(error), std::move(truth.traced)};
}

} // namespace stage
