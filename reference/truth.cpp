#include "reference/truth.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/input_error.hpp"
#include "base/parallel.hpp"
#include "reference/kept.hpp"
#include "reference/stratified.hpp"
#include "reference/traceable.hpp"
#include "scene/field_table.hpp"
#include "scene/file.hpp"

namespace reference {
namespace {

constexpr int picture_version = 4; // goes up when the same scene gives another picture
constexpr std::uint64_t most_pixels = 1u << 25;
constexpr double seconds_between_savings = 120;

double cpu_seconds()
{
    return double(std::clock()) / CLOCKS_PER_SEC; // of the process, all threads
}

class Tracing
{
  public:
    Tracing(const scene::LoadedScene& scene, const Request& request, const Until& until,
            base::Progress& progress, const TruthOptions& options)
        : scene_(scene), request_(request), until_(until), progress_(progress), options_(options),
          exposure_(scene.scene.exposure_stops)
    {
        if (!until_.samples && !until_.noise_de && !until_.seconds)
            until_.noise_de = usual_noise_de;
    }

    /// Adds passes until the picture is good enough. `save` is called now and then, and at the end when
    /// anything was added.
    template <class Save>
    void run(Truth& truth, const Save& save)
    {
        judge(truth);
        if (good_enough(truth))
            return;
        progress_.show("preparing");
        const Traceable traceable(scene_, request_.levels, request_.day);
        if (request_.levels.subsurface)
            truth.skin = traceable.wounds.skin();
        saved_ = start_ = Clock::now();
        begun_with_ = truth.picture.samples();
        try {
            while (!good_enough(truth)) {
                add_pass(traceable.tracer, truth);
                if (seconds_since(saved_) > seconds_between_savings) {
                    save(truth);
                    saved_ = Clock::now();
                }
            }
        } catch (const base::Interrupted&) { // the pass in hand is lost, what was done before is not
            truth.interrupted = true;
        }
        judge(truth);
        save(truth);
    }

  private:
    using Clock = std::chrono::steady_clock;
    static double seconds_since(Clock::time_point then)
    {
        return std::chrono::duration<double>(Clock::now() - then).count();
    }

    void judge(Truth& truth)
    {
        if (judged_ != truth.picture.passes() || judged_ == 0)
            truth.noise_de = truth.picture.noise_de(exposure_);
        judged_ = truth.picture.passes();
    }

    bool good_enough(const Truth& truth) const
    {
        return (until_.samples && truth.picture.samples() >= *until_.samples) ||
               (until_.noise_de && truth.noise_de <= *until_.noise_de) ||
               (until_.seconds && start_ != Clock::time_point{} && truth.picture.passes() >= 2 &&
                seconds_since(start_) >= *until_.seconds);
    }

    void add_pass(const PathTracer& tracer, Truth& truth)
    {
        const double cpu = cpu_seconds();
        const cv::Size size = truth.picture.size();
        scratch_.assign(std::size_t(size.area()), {});
        const std::thread::id caller = std::this_thread::get_id();
        base::in_parallel(std::size_t(size.height), options_.threads, [&](std::size_t row) {
            trace_row(tracer, int(row), truth.picture);
            if (std::this_thread::get_id() == caller)
                progress_.show(words(truth));
        });
        add(truth.picture);
        truth.cpu_seconds += cpu_seconds() - cpu;
        if (const std::uint32_t passes = truth.picture.passes(); passes < 8 || passes % (passes / 8) == 0)
            judge(truth); // as often as it may matter
    }

    void trace_row(const PathTracer& tracer, int y, const Picture& picture)
    {
        const cv::Size size = picture.size();
        for (int x = 0; x < size.width; ++x) {
            const std::uint64_t pixel = std::uint64_t(y) * std::uint64_t(size.width) + std::uint64_t(x);
            PixelSums& sums = scratch_[pixel];
            for (std::uint32_t i = 0; i < samples_per_pass; ++i) {
                const std::uint32_t sample = picture.samples() + i;
                Random random(request_.seed, pixel, sample);
                const auto place = stratified(sample, Random::mixed(request_.seed) ^ Random::mixed(~pixel));
                const glm::dvec3 sight =
                    head::sight_through_pixel(request_.camera, {x + place[0], y + place[1]}, size);
                const Radiance seen = tracer.along(request_.camera.eye, sight, random);
                sums.diffuse += cv::Vec3f(seen.diffuse);
                sums.diffuse_squares += cv::Vec3f(seen.diffuse.mul(seen.diffuse));
                sums.specular += cv::Vec3f(seen.specular);
                sums.specular_squares += cv::Vec3f(seen.specular.mul(seen.specular));
                sums.alpha += float(seen.alpha);
            }
        }
    }

    void add(Picture& picture) const
    {
        const cv::Size size = picture.size();
        const bool first_half = picture.passes() % 2 == 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const PixelSums& more = scratch_[std::size_t(y) * std::size_t(size.width) + std::size_t(x)];
                PixelSums& sums = picture.sums(x, y);
                sums.diffuse += more.diffuse;
                sums.diffuse_squares += more.diffuse_squares;
                sums.specular += more.specular;
                sums.specular_squares += more.specular_squares;
                sums.alpha += more.alpha;
                if (first_half)
                    sums.first_half += more.diffuse + more.specular;
            }
        picture.set_passes(picture.passes() + 1);
    }

    /// "64 samples, noise 0.71 dE, 1:20 left".
    std::string words(const Truth& truth) const
    {
        const std::uint32_t samples = truth.picture.samples();
        std::string text = fmt::format("{} samples", samples);
        if (std::isfinite(truth.noise_de))
            text += fmt::format(", noise {:.2f} dE", truth.noise_de);
        const double elapsed = seconds_since(start_), made = samples - begun_with_;
        double left = until_.seconds ? std::max(0.0, *until_.seconds - elapsed) : 1e9;
        if (made > 0) {
            const double each = elapsed / made;
            if (until_.samples)
                left = std::min(left, each * (*until_.samples - std::min(samples, *until_.samples)));
            if (until_.noise_de && std::isfinite(truth.noise_de)) // noise falls as 1/sqrt(samples)
                left = std::min(left, each * samples *
                                          std::max(0.0, std::pow(truth.noise_de / *until_.noise_de, 2) - 1));
        }
        return left < 1e9 ? text + fmt::format(", {}:{:02} left", long(left) / 60, long(left) % 60) : text;
    }

    const scene::LoadedScene& scene_;
    const Request& request_;
    Until until_;
    base::Progress& progress_;
    const TruthOptions& options_;
    const double exposure_;
    std::vector<PixelSums> scratch_; // of the pass in hand
    Clock::time_point start_{}, saved_{};
    std::uint32_t begun_with_ = 0; // samples at the start
    std::uint32_t judged_ = 0;     // passes when the noise was last measured
};

void hash_files(base::Hash& hash, const scene::LoadedScene& scene)
{
    hash.add(scene.head->key);
    for (const scene::Wound& wound : scene.scene.wounds)
        scene::hash_fields(hash, wound, scene::Affects::Fit);
    if (scene.scene.tissue.ends_with(".json"))
        hash.add(base::file_version(scene.scene.tissue));
}

} // namespace

std::uint64_t truth_key(const scene::LoadedScene& scene, const Request& request)
{
    scene::Scene shown = scene.scene;
    const double last_day = *std::ranges::max_element(shown.days); // the reflectance table depends on it
    shown.days = {request.day, last_day};
    shown.camera = {};
    shown.views.clear();
    shown.size = request.size;
    shown.samples = 1;
    shown.exposure_stops = 0;
    shown.shading.transport = optics::Transport::Lambert; // the rasteriser's choice
    base::Hash hash;
    hash.add(picture_version).add(samples_per_pass).add(scene::to_json(shown).dump());
    hash_files(hash, scene);
    for (const glm::dvec3& point : {request.camera.eye, request.camera.target})
        hash.add(point.x).add(point.y).add(point.z);
    const Levels& levels = request.levels;
    hash.add(request.camera.fov_deg).add(request.seed).add(levels.shadows).add(levels.bounces);
    hash.add(levels.ambient).add(levels.subsurface).add(levels.specular);
    hash.add(levels.medium.anisotropy).add(levels.medium.index);
    return hash.value();
}

void check_request(const scene::LoadedScene& scene, const Request& request)
{
    if (std::uint64_t(request.size[0]) * request.size[1] > most_pixels)
        throw base::InputError(
            "scene: /size", fmt::format("{}x{} is too much to be traced", request.size[0], request.size[1]),
            fmt::format("stay below {} million pixels", most_pixels >> 20));
    if (scene.head->model->indices.empty())
        throw base::InputError("scene: /head", "has no triangles", "export it again");
}

Truth find_truth(const scene::LoadedScene& scene, const Request& request, const Until& until,
                 base::Progress& progress, std::vector<std::string>& notes, const TruthOptions& options)
{
    check_request(scene, request);
    const cv::Size size(int(request.size[0]), int(request.size[1]));
    const std::filesystem::path file = kept_path(truth_key(scene, request));
    Truth truth{.picture = Picture(size)};
    if (options.use_cache)
        read_kept(file, truth);
    bool refused = false;
    Tracing(scene, request, until, progress, options).run(truth, [&](const Truth& now) {
        if (options.use_cache && !refused)
            if (const std::string why = write_kept(file, now); !why.empty()) {
                notes.push_back(why);
                refused = true;
            }
    });
    return truth;
}

} // namespace reference
