#include "apps/compare/systems.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/compare/page.hpp"
#include "base/file.hpp"
#include "base/flip.hpp"
#include "base/image_codec.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/machine.hpp"
#include "base/statistics.hpp"
#include "base/tone_curve.hpp"
#include "engine/graph/formats.hpp"
#include "scene/file.hpp"
#include "scene/shots.hpp"
#include "stage/measurement.hpp"

namespace compare_command {
namespace {
using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr double shown_de = 10;  // of the difference maps' colours
constexpr double arc_deg = 40;   // that camera and light go around the head
constexpr int rays_per_axis = 3; // of a pixel, for the errors of what runs on the processor
constexpr int slow_every = 3;    // rounds, of what takes seconds for a frame
constexpr int jpeg_quality = 88;

/// Eq. (8) with the paper's coefficients, in the scene's light: its shadows, its surroundings, its wounds'
/// colours.
optics::Shading papers_shading(const optics::Shading& own, optics::Transport transport)
{
    optics::Shading shading = optics::published_shading();
    shading.transport = transport;
    shading.blend_model = own.blend_model;
    shading.ambient = own.ambient;
    shading.shadow = own.shadow;
    shading.bounce = own.bounce;
    shading.normal_map = own.normal_map;
    return shading;
}

double seconds_since(Clock::time_point then)
{
    return std::chrono::duration<double>(Clock::now() - then).count();
}

/// Frames of a turning camera and of a passing day; `at` 0 to below 1.
class Path
{
  public:
    Path(const scene::LoadedScene& loaded, double first_day, double last_day)
        : shots_(scene::shots_of_sweep(
              loaded, {"", loaded.camera()},
              {.first_day = first_day, .last_day = last_day, .turn_deg = arc_deg, .count = steps + 1}))
    {
    }
    const scene::Shot& at(double position) const
    {
        return shots_[std::size_t(std::lround(position * double(steps)))];
    }

  private:
    static constexpr std::size_t steps = 1000;
    std::vector<scene::Shot> shots_;
};

class SystemsRun
{
  public:
    SystemsRun(const CompareOptions& options, const scene::Scene& scene)
        : options_(options), renderer_(stage::device_options(options)),
          stage_(renderer_.device, stage::Stage::prepare(scene)),
          systems_(all_systems(scene.shading)), shot_{.day = scene.days.front(),
                                                      .camera = stage_.loaded().camera(),
                                                      .name = "systems"},
          path_(stage_.loaded(), scene.days.front(),
                scene.days.back() > scene.days.front() ? scene.days.back() : scene.days.front() + 10)
    {
        for (const System& system : systems_) {
            stages_.push_back(std::make_shared<stage::Stage>(stage_));
            if (system.shading) {
                scene::Scene own = scene;
                own.shading = *system.shading;
                stages_.back()->update(own);
            }
            rivals_.push_back(system.method ? std::make_shared<reference::Rival>(*system.method) : nullptr);
            const SystemFacts facts = facts_of(system.name);
            record_.push_back({{"name", system.name},
                               {"source", facts.source},
                               {"runs_on", system.method ? "cpu" : "gpu"},
                               {"paper_fps", facts.paper_fps},
                               {"cannot", facts.cannot}});
        }
    }

    void run()
    {
        progress_.expect(systems_.size() + system_cases.size() * std::size_t(rounds().all()));
        notes_ = stage_.loaded().notes;
        truth_ = stage::find_shot_truth(stage_.loaded(), shot_, options_.reference.levels,
                                        options_.reference.until, progress_, notes_);
        bool interrupted = false;
        try {
            for (std::size_t i = 0; i < systems_.size(); ++i) {
                progress_.show(systems_[i].name);
                draw(i);
                progress_.step();
            }
            prepare_days();
            for (const std::string_view name : system_cases)
                measure(std::string(name));
        } catch (const base::Interrupted&) {
            interrupted = true;
        }
        progress_.clear();
        add_truth();
        write(interrupted);
    }

  private:
    stage::Rounds rounds() const { return {.warm_up = 3, .counted = 0, .timed = options_.rounds}; }

    /// The picture, its error, and what comes before a first picture.
    void draw(std::size_t i)
    {
        json& record = record_[i];
        const cv::Size size(int(stage_.scene().size[0]), int(stage_.scene().size[1]));
        const Clock::time_point start = Clock::now();
        cv::Mat4f ours;
        if (rivals_[i]) {
            rivals_[i]->draw(stage_.loaded(), shot_.camera, size, shot_.day, 1);
            record["precompute_s"] = seconds_since(start);
            record["memory_mb"] = double(rivals_[i]->bytes()) / 1e6;
            ours = rivals_[i]->draw(stage_.loaded(), shot_.camera, size, shot_.day, rays_per_axis);
        } else {
            gpu::Executor executor(renderer_.device, renderer_.shaders);
            graph::Graph graph;
            declare(graph, *stages_[i], shot_.day, shot_.camera, true);
            const gpu::FrameResult frame = executor.run(graph);
            record["precompute_s"] = seconds_since(start);
            double bytes = 0;
            for (const auto& [name, image] : frame.plan.memory.images)
                if (const graph::Format* format = graph::find_format(image.desc.format))
                    bytes +=
                        double(image.desc.width) * image.desc.height * image.desc.samples * format->bytes;
            record["memory_mb"] = bytes / 1e6;
            ours = stage::supersampled(renderer_, *stages_[i], shot_);
        }
        add_error(record, ours);
    }

    void add_error(json& record, const cv::Mat4f& ours)
    {
        const stage::TruthError error = stage::error_of(ours, *truth_);
        for (std::size_t r = 0; r < error.regions.size(); ++r)
            if (const stage::RegionError in = stage::error_in(error.regions[r], error.errors); in.pixels > 0)
                record["error"][std::string(reference::region_names[r])] = {
                    {"mean", in.mean}, {"p95", in.p95}, {"noise", in.noise}, {"pixels", in.pixels}};
        const cv::Mat3b picture = base::encode_picture(ours, truth_->exposure_stops),
                        truth = base::encode_picture(truth_->radiance, truth_->exposure_stops);
        record["flip"] =
            cv::countNonZero(error.shown) ? cv::mean(base::flip(truth, picture), error.shown)[0] : 0.;
        const cv::Mat3b map = color_mapped(error.errors.de, shown_de, error.shown);
        const std::string name = record["name"];
        base::write_png(options_.out / (name + ".png"), picture);
        base::write_png(options_.out / (name + "_difference.png"), map);
        pictures_.push_back({picture, map, name});
    }

    /// As a window does it: nothing runs that still holds.
    static void declare(graph::Graph& graph, const stage::Stage& stage, double day,
                        const head::Camera& camera, bool light_stands)
    {
        const auto size = stage.scene().size;
        graph.present(stage
                          .declare(graph, {.day = day,
                                           .tile = size,
                                           .camera = camera,
                                           .every_frame = false,
                                           .light_scale = light_stands ? stage.light_scale(
                                                                             stage.loaded().camera(), size[1])
                                                                       : std::nullopt,
                                           .radiance = false})
                          .images.picture);
    }

    /// What a day needs of photon walks, so that no system pays for all that come after it.
    void prepare_days()
    {
        const int all = rounds().all();
        for (int round = 0; round < all; round += slow_every) {
            progress_.show("tissue of the days");
            reference::DayWounds(stage_.loaded(), path_.at(double(round) / all).day,
                                 reference::MediumChoice{});
        }
    }

    stage::MeasuredCase measured(std::size_t i, const std::string& name)
    {
        const auto stage = stages_[i];
        const auto rival = rivals_[i];
        const auto frame = [this, stage, rival, name](graph::Graph& graph, double position) {
            if (name == "light") {
                scene::Scene lit = stage->scene();
                lit.lights = stage_.scene().lights;
                if (!lit.lights.empty())
                    lit.lights.front().from.azimuth_deg += arc_deg * position;
                stage->update(lit);
            }
            const scene::Shot& shot = path_.at(name == "camera" || name == "day" ? position : 0);
            const double day = name == "day" ? shot.day : shot_.day;
            const head::Camera& camera = name == "camera" ? shot.camera : shot_.camera;
            if (!rival)
                return declare(graph, *stage, day, camera, name == "still" || name == "camera");
            const cv::Size size(int(stage->scene().size[0]), int(stage->scene().size[1]));
            base::encode_picture(rival->draw(stage->loaded(), camera, size, day, 1), truth_->exposure_stops);
        };
        return {systems_[i].name, "", frame, [] {}, false, rival ? slow_every : 1};
    }

    void measure(const std::string& name)
    {
        std::vector<stage::MeasuredCase> cases;
        for (std::size_t i = 0; i < systems_.size(); ++i)
            cases.push_back(measured(i, name));
        const std::vector<stage::Measurement> found =
            stage::measure(renderer_.device, renderer_.shaders, cases, rounds(), [&](int) {
                progress_.step();
                progress_.show("cost, " + name);
            });
        for (const auto& stage : stages_) // the light goes back
            if (scene::Scene back = stage->scene(); back.lights != stage_.scene().lights) {
                back.lights = stage_.scene().lights;
                stage->update(back);
            }
        const double ward = base::median(stage::process_cpu_ms(found.front()));
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double cpu = base::median(stage::process_cpu_ms(found[i])),
                         wall = base::median(stage::wall_ms(found[i]));
            record_[i]["cpu_ms"][name] = cpu;
            record_[i]["wall_ms"][name] = wall;
            record_[i]["fps"][name] = 1000 / wall;
            record_[i]["ratio_to_ward"][name] = cpu / ward;
        }
    }

    /// The truth itself as the last system. Its error is that of a second such truth.
    void add_truth()
    {
        const SystemFacts facts = facts_of("reference");
        json record{
            {"name", "reference"},
            {"source", facts.source},
            {"runs_on", "cpu"},
            {"paper_fps", ""},
            {"precompute_s", nullptr},
            {"cannot", facts.cannot},
            {"flip", nullptr},
            {"memory_mb", double(truth_->traced.picture.size().area()) * sizeof(reference::PixelSums) / 1e6}};
        const double cpu = 1e3 * truth_->traced.cpu_seconds;
        for (const char* name : {"camera", "light", "day"}) {
            record["cpu_ms"][name] = cpu;
            if (record_.front().contains("cpu_ms") && record_.front()["cpu_ms"].contains(name))
                record["ratio_to_ward"][name] = cpu / record_.front()["cpu_ms"][name].get<double>();
        }
        const stage::TruthError error = stage::error_of(truth_->radiance, *truth_);
        for (std::size_t r = 0; r < error.regions.size(); ++r)
            if (const stage::RegionError in = stage::error_in(error.regions[r], error.errors); in.pixels > 0)
                record["error"][std::string(reference::region_names[r])] = {
                    {"mean", in.noise}, {"p95", nullptr}, {"noise", in.noise}, {"pixels", in.pixels}};
        record_.push_back(record);
        const cv::Mat3b picture = base::encode_picture(truth_->radiance, truth_->exposure_stops);
        base::write_png(options_.out / "reference.png", picture);
        pictures_.push_back({picture, color_mapped(error.errors.de, shown_de, error.shown), "reference"});
    }

    void write(bool interrupted)
    {
        for (const std::string& note : notes_)
            fmt::print(stderr, "note: {}\n", note);
        stage::fail_on_validation(renderer_.device);
        const json record{{"device", renderer_.device.info().name},
                          {"software_rasteriser", renderer_.device.info().software},
                          {"program", base::program_json()},
                          {"load", base::load_average()},
                          {"size", fmt::format("{}x{}", stage_.scene().size[0], stage_.scene().size[1])},
                          {"day", shot_.day},
                          {"rounds", options_.rounds},
                          {"noise_de", truth_->traced.noise_de},
                          {"samples", truth_->traced.picture.samples()},
                          {"interrupted", interrupted},
                          {"scene", scene::to_json(stage_.scene())},
                          {"systems", record_},
                          {"claims", claims_of(record_)}};
        base::write_json(options_.out / "systems.json", record);
        const std::filesystem::path page =
            options_.document.empty() ? options_.out / "rivals.md" : options_.document;
        const std::filesystem::path sheet = page.parent_path() / "images" / "rivals.jpg";
        base::make_folder(sheet.parent_path());
        cv::Mat bgr;
        cv::cvtColor(drawn_sheet(), bgr, cv::COLOR_RGB2BGR);
        base::write_file(sheet, base::encode_jpeg(bgr, jpeg_quality));
        base::write_text(page, systems_page(record, "images/rivals.jpg"));
        for (const json& claim : record["claims"])
            fmt::print("{}: {} ({})\n", claim["holds"].get<bool>() ? "holds" : "does not hold",
                       claim["claim"].get<std::string>(), claim["measured"].get<std::string>());
        fmt::print("systems.json and the pictures in {}, the page {}{}\n", options_.out.string(),
                   page.string(), interrupted ? "; interrupted, so costs are missing" : "");
    }

    /// Two systems in a row: each one's picture and difference map.
    cv::Mat3b drawn_sheet() const
    {
        std::vector<PageRow> rows;
        for (std::size_t i = 0; i < pictures_.size(); ++i) {
            if (i % 2 == 0)
                rows.push_back({});
            rows.back().cells.push_back(pictures_[i].picture);
            rows.back().cells.push_back(pictures_[i].map);
            rows.back().label += fmt::format("{}{}", i % 2 == 0 ? "" : "      right: ", pictures_[i].name);
        }
        const cv::Mat3b blank(pictures_.front().picture.size(), cv::Vec3b(250, 249, 247));
        while (rows.back().cells.size() < 4)
            rows.back().cells.push_back(blank);
        return draw_page({"picture", "dE2000 from the reference", "picture", "dE2000 from the reference"},
                         rows, shown_de);
    }

    struct Pictures
    {
        cv::Mat3b picture, map;
        std::string name;
    };

    const CompareOptions& options_;
    stage::Renderer renderer_;
    stage::Stage stage_;
    const std::vector<System> systems_;
    const scene::Shot shot_;
    const Path path_;
    std::vector<std::shared_ptr<stage::Stage>> stages_;     // by system
    std::vector<std::shared_ptr<reference::Rival>> rivals_; // the same; null on the device
    std::optional<stage::ShotTruth> truth_;
    base::Progress progress_;
    std::vector<std::string> notes_;
    std::vector<json> record_; // by system, and last the reference
    std::vector<Pictures> pictures_;
};

} // namespace

std::vector<System> all_systems(const optics::Shading& own)
{
    std::vector<System> systems{{"ward", papers_shading(own, optics::Transport::Lambert), {}}};
    for (std::size_t i = 0; i < optics::transport_names.size(); ++i) {
        const auto transport = optics::Transport(i);
        System system{optics::transport_names[i], own, {}};
        std::ranges::replace(system.name, '_', '-');
        if (transport == optics::Transport::Published)
            system.shading = papers_shading(own, transport);
        system.shading->transport = transport;
        systems.push_back(system);
    }
    for (std::size_t i = 0; i < reference::rival_names.size(); ++i)
        systems.push_back({std::string(reference::rival_names[i]), {}, reference::RivalMethod(i)});
    return systems;
}

void compare_systems(const CompareOptions& options)
{
    if (!options.other.empty())
        throw base::InputError("--systems", "takes one scene, not two", "leave out " + options.other);
    CompareOptions chosen = options;
    if (chosen.size.empty())
        chosen.size = "640x360";
    const scene::Scene scene = scene::chosen_scene(chosen);
    base::make_folder(options.out);
    SystemsRun(chosen, scene).run();
}

} // namespace compare_command
