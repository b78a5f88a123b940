#include "apps/compare/against_reference.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/compare/page.hpp"
#include "base/file.hpp"
#include "base/flip.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/text.hpp"
#include "base/tone_curve.hpp"
#include "reference/command_line.hpp"
#include "scene/file.hpp"
#include "scene/shots.hpp"
#include "stage/renderer.hpp"

namespace compare_command {
namespace {
using nlohmann::json;

constexpr double top_de = 10; // of the maps' colours, and of the difference in L*

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
            fmt::print(stderr, "note: {}\n", base::printable(note));
        write(days);
    }

  private:
    json compare(const scene::Shot& shot)
    {
        const auto [result, traced] = stage::measure_truth_error(
            renderer_, stage_, shot, options_.reference.levels, options_.reference.until, progress_, notes_);
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
        cv::Mat1f lightness;
        cv::extractChannel(result.errors.lab, lightness, 0);
        const cv::Mat3b difference_map = color_mapped(result.errors.de, top_de, result.shown),
                        lightness_map = signed_color_mapped(lightness, top_de, result.shown);
        const auto put = [&](const char* what, const cv::Mat3b& map) {
            base::write_png(options_.out / fmt::format("{}_{}.png", shot.name, what), map);
        };
        put("ours", picture);
        put("reference", truth_picture);
        put("difference", difference_map);
        put("lightness", lightness_map);
        put("flip", color_mapped(flip, 1, cv::Mat1b(flip.size(), uchar(255))));
        put("regions", regions_picture(result.regions, picture));
        rows_.push_back({{picture, truth_picture, difference_map, lightness_map},
                         fmt::format("day {:g}{}   mean dE2000: {}; noise of the truth {:.2f}", shot.day,
                                     shot.view.empty() ? "" : " " + shot.view, label, traced.noise_de)});
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

    void write(const json& days)
    {
        json regions;
        for (std::size_t i = 0; i < pooled_.size(); ++i) {
            const cv::Mat1b all(pooled_[i].de.size(), uchar(255));
            const stage::RegionError error =
                pooled_[i].de.empty() ? stage::RegionError{} : stage::error_in(all, pooled_[i]);
            regions[std::string(reference::region_names[i])] = json_of(error);
            if (error.pixels > 0)
                fmt::print("{:13} mean {:5.2f}  95 % below {:5.2f}  99.9 % below {:5.2f}  at most {:5.2f}  "
                           "L* {:+.2f} a* {:+.2f} b* {:+.2f}  noise {:.2f}\n",
                           reference::region_names[i], error.mean, error.p95, error.p999, error.max, error.l,
                           error.a, error.b, error.noise);
        }
        base::write_png(
            options_.out / "compare.png",
            draw_page({"ours", "reference", "difference, dE2000", "L*: blue -10, red +10"}, rows_, top_de));
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
    stage::Renderer renderer_;
    stage::Stage stage_;
    base::Progress progress_;
    std::vector<std::string> notes_;
    std::vector<PageRow> rows_;
    std::array<stage::PixelErrors, reference::region_names.size()> pooled_; // a column per region
};

} // namespace

void add_reference_options(CLI::App& command, CompareOptions& options)
{
    ReferenceOptions& chosen = options.reference;
    CLI::Option* wanted =
        command.add_flag("--reference", chosen.wanted,
                         "Compare with the scene's path-traced truth instead of with another scene");
    CLI::Option* systems = command.add_flag("--systems", chosen.systems,
                                            "Compare all systems of light transport with that truth and with "
                                            "each other, at 640x360 unless given");
    systems->excludes(wanted);
    command
        .add_option(
            "--document", options.document,
            "With --systems: where the page goes, its picture to images/ beside it (default: rivals.md "
            "in the folder)")
        ->needs(systems)
        ->type_name("PAGE.md");
    const std::size_t before = command.get_options().size();
    reference::add_until_options(command, chosen.until);
    reference::add_level_options(command, chosen.levels);
    const std::vector<CLI::Option*> all = command.get_options([](CLI::Option*) { return true; });
    for (std::size_t i = before; i < all.size(); ++i)
        all[i]->group("With --reference or --systems")->check([&chosen](const std::string&) {
            return chosen.wanted || chosen.systems ? std::string() : "it requires --reference or --systems";
        });
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
