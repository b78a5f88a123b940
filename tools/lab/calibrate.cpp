// `cicatrix-lab calibrate`: fits the calibrated model to the photon walk on one half of a set of skin-like
// stacks and reports its error on the other half.
#include <cmath>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <opencv2/core/optim.hpp>
#include <random>

#include "base/file.hpp"
#include "base/progress.hpp"
#include "tools/lab/reflectance.hpp"

namespace lab {

using nlohmann::ordered_json;

namespace {

using Coefficients = std::array<double, 4>;

/// Stacks like intact and wounded skin. Those with an even index are for the fit.
std::vector<optics::Stack> calibration_stacks()
{
    std::mt19937 random(5);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    const auto logarithmic = [&](double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    };
    std::vector<optics::Stack> stacks;
    for (int i = 0; i < 96; ++i) {
        optics::Stack stack;
        const bool epidermis = i % 4 != 3, bloody = i % 4 == 2;
        if (epidermis)
            stack.layers.push_back({logarithmic(.02, 8), uniform(3, 14), uniform(.2, .85), uniform(1.38, 1.5),
                                    logarithmic(.03, .25)});
        stack.layers.push_back(
            {logarithmic(.005, bloody ? 20 : 2), uniform(1.5, 9), uniform(.7, .85), 1.4, logarithmic(.3, 4)});
        stack.layers.push_back(
            {logarithmic(.01, 2), uniform(1.5, 7), uniform(.7, .85), uniform(1.38, 1.46), logarithmic(1, 9)});
        stack.n_below = stack.layers.back().n;
        stacks.push_back(stack);
    }
    return stacks;
}

struct Walked
{
    std::vector<optics::Stack> stacks;
    std::vector<double> truth; // reflectance without specular reflection
};

/// Over every second stack, from `first` on.
double rms_error(const Walked& walked, std::size_t first, optics::ReflectanceModel model,
                 const optics::ReflectanceOptions& options = {})
{
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = first; i < walked.stacks.size(); i += 2, ++count)
        sum += std::pow(
            optics::reflectance(walked.stacks[i], model, options).r_without_specular - walked.truth[i], 2);
    return std::sqrt(sum / static_cast<double>(count));
}

class FitError final : public cv::MinProblemSolver::Function
{
  public:
    explicit FitError(const Walked& walked) : walked_(walked) {}
    int getDims() const override { return 4; }
    double calc(const double* x) const override
    {
        const Coefficients c{x[0], x[1], x[2], x[3]};
        if (std::ranges::min(c) < 0 || c[2] < c[3])
            return 1; // larger than any error of a reflectance
        return rms_error(walked_, 0, optics::ReflectanceModel::Calibrated, {.calibration = c});
    }

  private:
    const Walked& walked_;
};

/// Downhill simplex from Eddington's coefficients; restarts from the result until the error no longer falls.
Coefficients fit(const Walked& walked)
{
    cv::Mat1d x = (cv::Mat1d(1, 4) << .75, .3, 2, .1);
    const cv::Mat1d step = (cv::Mat1d(1, 4) << .2, .8, .4, .4);
    const cv::TermCriteria until(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 2000, 1e-9);
    double last = 1;
    for (int round = 0; round < 20; ++round) {
        const auto solver = cv::DownhillSolver::create(cv::makePtr<FitError>(walked), step, until);
        const double error = solver->minimize(x);
        if (error > last - 1e-7)
            break;
        last = error;
    }
    return {x(0), x(1), x(2), x(3)};
}

ordered_json errors(const Walked& walked, optics::ReflectanceModel model,
                    const optics::ReflectanceOptions& options = {})
{
    return {{"fitted_rms", rms_error(walked, 0, model, options)},
            {"held_out_rms", rms_error(walked, 1, model, options)}};
}

} // namespace

ordered_json calibrate(const TableOptions& options, std::ostream& out)
{
    Walked walked{calibration_stacks(), {}};
    base::Progress progress;
    progress.expect(walked.stacks.size());
    double variance = 0;
    for (const optics::Stack& stack : walked.stacks) {
        progress.show("photon walks");
        optics::ReflectanceOptions walk = options.reflectance_options;
        walk.seed += walked.truth.size();
        const optics::Response response =
            optics::reflectance(stack, optics::ReflectanceModel::MonteCarlo, walk);
        walked.truth.push_back(response.r_without_specular);
        variance += response.standard_error * response.standard_error;
        progress.step();
    }
    progress.clear();
    const Coefficients found = fit(walked);
    const ordered_json json{
        {"photons", options.reflectance_options.photons},
        {"stacks", walked.stacks.size()},
        {"walk_standard_error", std::sqrt(variance / static_cast<double>(walked.stacks.size()))},
        {"coefficients", found},
        {"fit", errors(walked, optics::ReflectanceModel::Calibrated, {.calibration = found})},
        {"calibrated", errors(walked, optics::ReflectanceModel::Calibrated)},
        {"two-stream", errors(walked, optics::ReflectanceModel::TwoStream)}};
    fmt::print(out, "coefficients {:.4f}\n", fmt::join(found, " "));
    fmt::print(out, "{:36} {:>18} {:>18}\n", "rms error against the photon walk", "stacks of the fit",
               "others");
    for (const auto& [key, label] : {std::pair{"fit", "calibrated, with these"},
                                     {"calibrated", "calibrated, as built in"},
                                     {"two-stream", "two-stream"}})
        fmt::print(out, "{:36} {:18.4f} {:18.4f}\n", label, json[key]["fitted_rms"].get<double>(),
                   json[key]["held_out_rms"].get<double>());
    base::make_folder(options.out);
    base::write_json(options.out / "calibration.json", json);
    return json;
}

} // namespace lab
