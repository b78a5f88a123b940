#include "apps/compare/against_reference.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/compare/page.hpp"
#include "base/axis.hpp"
#include "base/file.hpp"
#include "base/flip.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/number_option.hpp"
#include "base/tone_curve.hpp"
#include "reference/command_line.hpp"
#include "scene/file.hpp"
#include "scene/shots.hpp"
#include "stage/renderer.hpp"

namespace compare_command {
namespace {
using nlohmann::json;

json json_of(const stage::RegionError& error)
{
    if (error.pixels == 0)
        return nullptr;
    return {{"pixels", error.pixels}, {"mean", error.mean}, {"p95", error.p95},
            {"p999", error.p999},     {"max", error.max},   {"l", error.l},
            {"a", error.a},           {"b", error.b},       {"noise", error.noise}};
}

cv::Mat3b regions_picture(const reference::Regions& regions, const cv::Mat3b& picture)
{
    const std::array<cv::Vec3b, reference::region_names.size()> colors{
        {{120, 120, 120}, {214, 39, 40}, {255, 152, 150}, {31, 119, 180}, {44, 160, 44}}};
    cv::Mat3b shown = picture / 3;
    for (std::size_t i = 0; i < regions.size(); ++i)
        for (int y = 0; y < shown.rows; ++y)
            for (int x = 0; x < shown.cols; ++x)
                if (regions[i](y, x))
                    shown(y, x) = colors[i] * .7 + picture(y, x) * .3;
    return shown;
}

class Comparison
{
  public:
    Comparison(const CompareOptions& options, const scene::Scene& scene)
        : options_(options), renderer_(stage::device_options(options)),
          stage_(renderer_.device, stage::Stage::prepare(scene))
    {
        if (!options_.reference.until.samples && !options_.reference.until.noise_de &&
            !options_.reference.until.seconds)
            until_.noise_de = .5;
        else
            until_ = options_.reference.until;
    }

    void run()
    {
        const std::vector<scene::Shot> shots =
            scene::shots_of_days(stage_.scene().days, scene::chosen_views(stage_.loaded(), options_.views));
        notes_ = stage_.loaded().notes;
        json days = json::array();
        for (const scene::Shot& shot : shots)
            days.push_back(compare(shot));
        progress_.clear();
        for (const std::string& note : notes_)
            fmt::print(stderr, "note: {}\n", note);
        write(days);
    }

  private:
    json compare(const scene::Shot& shot)
    {
        const stage::TruthError result = stage::measure_truth_error(
            renderer_, stage_, shot, options_.reference.levels, until_, progress_, notes_);
        const reference::Truth& traced = result.traced;
        json record{{"day", shot.day},
                    {"samples", traced.picture.samples()},
                    {"noise_de", traced.noise_de},
                    {"reference_cpu_seconds", traced.cpu_seconds}};
        if (!shot.view.empty())
            record["view"] = shot.view;
        std::string label;
        for (std::size_t i = 0; i < result.regions.size(); ++i) {
            const stage::RegionError error = stage::error_in(result.regions[i], result.errors);
            record["regions"][std::string(reference::region_names[i])] = json_of(error);
            if (error.pixels > 0)
                label += fmt::format("{}{} {:.2f}", label.empty() ? "" : ", ", reference::region_names[i],
                                     error.mean);
            pool(i, result.regions[i], result.errors);
        }
        const double exposure = stage_.scene().exposure_stops;
        const cv::Mat3b picture = base::encode_picture(result.ours, exposure),
                        truth_picture = base::encode_picture(result.truth, exposure);
        const cv::Mat1f flip = base::flip(truth_picture, picture);
        record["flip"] = {
            {"mean_on_head", cv::countNonZero(result.shown) ? cv::mean(flip, result.shown)[0] : 0.},
            {"pixels_per_degree", base::usual_pixels_per_degree}};
        write_maps(shot.name, {picture, truth_picture}, result.errors, flip, result.shown,
                   regions_picture(result.regions, picture));
        rows_.push_back({{picture, truth_picture},
                         fmt::format("day {:g}{}   mean dE2000: {}; noise of the truth {:.2f}", shot.day,
                                     shot.view.empty() ? "" : " " + shot.view, label, traced.noise_de)});
        errors_.push_back(result.errors);
        shown_.push_back(result.shown);
        return record;
    }

    void pool(std::size_t region, const cv::Mat1b& where, const stage::PixelErrors& errors)
    {
        for (int y = 0; y < where.rows; ++y)
            for (int x = 0; x < where.cols; ++x)
                if (where(y, x)) {
                    pooled_[region].de.push_back(errors.de(y, x));
                    pooled_[region].noise.push_back(errors.noise(y, x));
                    pooled_[region].lab.push_back(errors.lab(y, x));
                }
    }

    void write_maps(const std::string& name, const std::array<cv::Mat3b, 2>& pictures,
                    const stage::PixelErrors& errors, const cv::Mat1f& flip, const cv::Mat1b& shown,
                    const cv::Mat3b& regions) const
    {
        cv::Mat1f lightness;
        cv::extractChannel(errors.lab, lightness, 0);
        const auto put = [&](const char* what, const cv::Mat3b& picture) {
            base::write_png(options_.out / fmt::format("{}_{}.png", name, what), picture);
        };
        put("ours", pictures[0]);
        put("reference", pictures[1]);
        put("difference", color_mapped(errors.de, 10, shown));
        put("lightness", signed_color_mapped(lightness, 10, shown));
        put("flip", color_mapped(flip, 1, cv::Mat1b(flip.size(), uchar(255))));
        put("regions", regions);
    }

    void write(const json& days)
    {
        double top = 0;
        json regions;
        for (std::size_t i = 0; i < pooled_.size(); ++i) {
            const cv::Mat1b all(pooled_[i].de.size(), uchar(255));
            const stage::RegionError error =
                pooled_[i].de.empty() ? stage::RegionError{} : stage::error_in(all, pooled_[i]);
            regions[std::string(reference::region_names[i])] = json_of(error);
            top = std::max(top, error.p999);
            if (error.pixels > 0)
                fmt::print("{:13} mean {:5.2f}  95 % below {:5.2f}  99.9 % below {:5.2f}  at most {:5.2f}  "
                           "L* {:+.2f} a* {:+.2f} b* {:+.2f}  noise {:.2f}\n",
                           reference::region_names[i], error.mean, error.p95, error.p999, error.max, error.l,
                           error.a, error.b, error.noise);
        }
        top = std::min(10.0, base::round_up(std::max(top, .1)));
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            cv::Mat1f lightness;
            cv::extractChannel(errors_[i].lab, lightness, 0);
            rows_[i].cells.push_back(color_mapped(errors_[i].de, top, shown_[i]));
            rows_[i].cells.push_back(signed_color_mapped(lightness, 10, shown_[i]));
        }
        base::write_png(
            options_.out / "compare.png",
            draw_page({"ours", "reference", "difference, dE2000", "L*: blue -10, red +10"}, rows_, top));
        stage::fail_on_validation(renderer_.device);
        base::write_json(options_.out / "compare.json", {{"device", renderer_.device.info().name},
                                                         {"scene", scene::to_json(stage_.scene())},
                                                         {"regions", regions},
                                                         {"days", days}});
        fmt::print("compare.png, compare.json and the maps of {} in {}\n",
                   rows_.size() == 1 ? "one picture" : fmt::format("{} pictures", rows_.size()),
                   options_.out.string());
    }

    const CompareOptions& options_;
    reference::Until until_;
    stage::Renderer renderer_;
    stage::Stage stage_;
    base::Progress progress_;
    std::vector<std::string> notes_;
    std::vector<PageRow> rows_;
    std::vector<stage::PixelErrors> errors_; // of the rows
    std::vector<cv::Mat1b> shown_;
    std::array<stage::PixelErrors, reference::region_names.size()> pooled_; // a column per region
};

} // namespace

void add_reference_options(CLI::App& command, ReferenceOptions& options)
{
    command.add_flag("--reference", options.wanted,
                     "Compare with the scene's path-traced truth instead of with another scene");
    command
        .add_option("--noise", options.until.noise_de,
                    "With --reference: mean CIEDE2000 by which two such truths would differ; 0.5 without it")
        ->check(base::number_from(0.01, 100))
        ->type_name("DE");
    command
        .add_option("--samples", options.until.samples, "With --reference: samples per pixel of the truth")
        ->transform(base::whole_number_from(8, 1'000'000))
        ->type_name("N");
    reference::add_level_options(command, options.levels);
}

void compare_with_reference(const CompareOptions& options)
{
    if (!options.other.empty())
        throw base::InputError("--reference", "takes one scene, not two", "leave out " + options.other);
    const scene::Scene scene = scene::chosen_scene(options);
    base::make_folder(options.out);
    Comparison(options, scene).run();
}

} // namespace compare_command
