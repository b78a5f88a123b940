#include "stage/truth_error.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/interrupt.hpp"
#include "base/tone_curve.hpp"

namespace stage {
namespace {

constexpr std::uint32_t supersampling = 4; // of our picture, per axis

/// Our picture as the truth is sampled: the mean of many places in each pixel. Premultiplied radiance.
cv::Mat4f supersampled(Renderer& renderer, const Stage& stage, const scene::Shot& shot)
{
    DrawOptions drawing;
    for (std::size_t axis = 0; axis < 2; ++axis)
        drawing.size[axis] = supersampling * stage.scene().size[axis];
    drawing.transparent = drawing.radiance = true;
    const cv::Mat4f large = draw(renderer, stage, shot, drawing).radiance;
    cv::Mat4f mean;
    cv::resize(large, mean, large.size() / int(supersampling), 0, 0, cv::INTER_AREA);
    return mean;
}

base::Lab shown_lab(const cv::Vec4f& radiance, double exposure_stops, double height)
{
    base::Color seen =
        base::on_backdrop({radiance[0], radiance[1], radiance[2]}, radiance[3], exposure_stops, height);
    for (double& channel : seen.val)
        channel = std::clamp(channel, 0.0, 1.0);
    return base::lab_from_linear(seen);
}

PixelErrors errors_of(const cv::Mat4f& ours, const cv::Mat4f& truth, const cv::Mat1f& noise, double exposure)
{
    PixelErrors errors{cv::Mat1f(ours.size(), 0.f), noise, cv::Mat3f(ours.size(), cv::Vec3f::all(0))};
    for (int y = 0; y < ours.rows; ++y)
        for (int x = 0; x < ours.cols; ++x) {
            const double height = (y + .5) / ours.rows;
            const base::Lab a = shown_lab(ours(y, x), exposure, height),
                            b = shown_lab(truth(y, x), exposure, height);
            errors.de(y, x) = float(base::delta_e2000(a, b));
            errors.lab(y, x) = {float(a.l - b.l), float(a.a - b.a), float(a.b - b.b)};
        }
    return errors;
}

/// Pixels of a region that the head covers whole, in the picture and in the truth.
cv::Mat1b covered(const cv::Mat1b& region, const cv::Mat4f& ours, const cv::Mat4f& truth)
{
    cv::Mat1b inside = region.clone();
    for (int y = 0; y < inside.rows; ++y)
        for (int x = 0; x < inside.cols; ++x)
            if (ours(y, x)[3] < .999f || truth(y, x)[3] < .999f)
                inside(y, x) = 0;
    return inside;
}

} // namespace

RegionError error_in(const cv::Mat1b& region, const PixelErrors& errors)
{
    RegionError error;
    std::vector<float> values;
    cv::Vec3d lab(0, 0, 0);
    for (int y = 0; y < region.rows; ++y)
        for (int x = 0; x < region.cols; ++x)
            if (region(y, x)) {
                values.push_back(errors.de(y, x));
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
    std::ranges::sort(values);
    const auto quantile = [&](double share) { return double(values[std::size_t(share * (count - 1))]); };
    error.p95 = quantile(.95);
    error.p999 = quantile(.999);
    error.max = double(values.back());
    return error;
}

TruthError measure_truth_error(Renderer& renderer, const Stage& stage, const scene::Shot& shot,
                               const reference::Levels& levels, const reference::Until& until,
                               base::Progress& progress, std::vector<std::string>& notes)
{
    const reference::Request request{
        .camera = shot.camera, .size = stage.scene().size, .day = shot.day, .levels = levels};
    TruthError result{.traced = reference::find_truth(stage.loaded(), request, until, progress, notes)};
    if (result.traced.interrupted || result.traced.picture.passes() < 2)
        throw base::Interrupted();
    progress.show(shot.name);
    const double exposure = stage.scene().exposure_stops;
    result.ours = supersampled(renderer, stage, shot);
    result.truth = result.traced.picture.radiance();
    result.errors = errors_of(result.ours, result.truth, result.traced.picture.noise_map(exposure), exposure);
    result.regions = reference::find_regions(stage.loaded(), request);
    result.shown = cv::Mat1b(result.ours.size(), uchar(0));
    for (cv::Mat1b& region : result.regions) {
        region = covered(region, result.ours, result.truth);
        result.shown |= region;
    }
    return result;
}

} // namespace stage
