// How the cost grows: the same frame with one quantity in steps, everything else fixed, and the power law
// that fits.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/measurement.hpp"
#include "apps/scene.hpp"
#include "apps/statistics.hpp"

namespace app {

/// "size", "triangles", "wounds", "points", "lut".
std::vector<std::string> sweep_names();

/// What one thing costs at every step.
struct SweepSeries
{
    std::string name;            // a pass (of all wounds together), "frame", or work of the CPU
    std::vector<double> x;       // of the steps at which it was done
    std::vector<Spread> ms;      // the same
    std::optional<PowerLaw> law; // through the medians; none with fewer than three steps
};

struct Sweep
{
    std::string kind, x_label;
    std::string fixed; // what stayed the same, and what a step is
    std::vector<SweepSeries> series;
};

/// Measures one kind. Throws cicatrix::InputError when the scene has no wound and the kind needs one.
Sweep measure_sweep(const std::string& kind, const Scene& scene, const engine::Device& device,
                    const engine::ShaderLibrary& library, const Rounds& rounds,
                    const std::function<void(int)>& progress);

std::string to_text(const Sweep& sweep);
nlohmann::json to_json(const Sweep& sweep);
/// Both axes logarithmic, RGB.
cv::Mat3b draw_sweep(const Sweep& sweep, const engine::DeviceInfo& device);

} // namespace app
