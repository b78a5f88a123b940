#include "apps/report/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>
#include <unistd.h>

#include "apps/report/cases.hpp"
#include "apps/report/mesh_density.hpp"
#include "base/file.hpp"
#include "base/input_error.hpp"
#include "head/default_head.hpp"
#include "stage/stage.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/prepare.hpp"

namespace report_command {
namespace {

constexpr int max_texture_side = 512; // texels a side, of textures in sweeps that load many heads

/// A temporary folder for the heads of one sweep.
class ScratchFolder
{
  public:
    ScratchFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "cicatrix-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw base::InputError(name, "cannot be created", "free space in the folder for temporary files");
        path_ = name;
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::filesystem::path saved(const head::Model& head, const std::string& name) const
    {
        save_model(path_ / (name + ".glb"), head);
        return path_ / (name + ".glb");
    }

  private:
    std::filesystem::path path_;
};

/// The steps of a sweep and the objects that must live while they are measured.
struct Steps
{
    std::string x_label, fixed;
    std::vector<double> x;
    std::vector<stage::MeasuredCase> cases; // all x once for each of `prefixes`
    std::vector<std::string> prefixes{""};
    std::string declaring = "declaring, on the CPU";
    bool whole_frame = true;       // whether to report the wall clock of the frame
    std::vector<SweepSeries> more; // series that are measured already
    std::vector<std::shared_ptr<const void>> kept;
};

head::Model head_of(const scene::Scene& scene)
{
    head::Model head = head::load_model(scene.head.empty() ? head::default_head_path() : scene.head);
    head::normalise_size(head);
    return head;
}

/// Draws the scene's first day; every pass runs in every frame.
stage::MeasuredCase whole_frame(const std::shared_ptr<const stage::Stage>& stage,
                                std::array<std::uint32_t, 2> size)
{
    return {"", "",
            [stage, size](graph::Graph& graph, double) {
                const scene::Scene& scene = stage->scene();
                graph.readback(
                    "picture",
                    stage->declare(graph, {.day = scene.days.front(), .tile = size}).images.picture);
            },
            [] {}, true};
}

std::shared_ptr<const stage::Stage> make_stage(const gpu::Device& device, const scene::Scene& scene)
{
    return std::make_shared<const stage::Stage>(device, stage::Stage::prepare(scene));
}

Steps sizes(const scene::Scene& scene, const gpu::Device& device)
{
    Steps steps{.x_label = "pixels",
                .fixed = "the scene and its aspect ratio; every pass runs in every frame"};
    const auto stage = make_stage(device, scene);
    for (const double factor : {0.125, 0.25, 0.5, 0.75, 1.0, 1.5}) {
        const std::array<std::uint32_t, 2> size{
            std::max(16u, std::uint32_t(std::lround(factor * scene.size[0]))),
            std::max(16u, std::uint32_t(std::lround(factor * scene.size[1])))};
        if (std::max(size[0], size[1]) > device.limits().maxImageDimension2D)
            continue;
        steps.x.push_back(double(size[0]) * size[1]);
        steps.cases.push_back(whole_frame(stage, size));
    }
    return steps;
}

Steps triangles(const scene::Scene& scene, const gpu::Device& device)
{
    Steps steps{
        .x_label = "triangles drawn",
        .fixed = fmt::format("{}x{}, the scene; the head subdivided at edge middles (x4, x16) or clustered "
                             "(1/2, 1/4, 1/8), its textures at most {} texels a side; every pass runs in "
                             "every frame",
                             scene.size[0], scene.size[1], max_texture_side)};
    const head::Model head = with_small_pictures(head_of(scene), max_texture_side);
    std::vector<head::Model> heads;
    for (const double share : {0.125, 0.25, 0.5})
        heads.push_back(clustered(head, share));
    heads.push_back(head);
    heads.push_back(subdivided(heads.back()));
    heads.push_back(subdivided(heads.back()));
    const ScratchFolder folder;
    for (const head::Model& one : heads) {
        scene::Scene changed = scene;
        changed.head = folder.saved(one, fmt::format("{}", triangle_count(one)));
        steps.cases.push_back(whole_frame(make_stage(device, changed), scene.size));
        graph::Graph graph;
        steps.cases.back().declare(graph, 0);
        steps.x.push_back(double(triangles_drawn(graph)));
    }
    return steps;
}

Steps wounds(const scene::Scene& scene, const gpu::Device& device)
{
    Steps steps{
        .x_label = "wounds",
        .fixed = fmt::format("{}x{}, the head with textures of at most {} texels a side; wounds like the "
                             "scene's first at half its width, all over the face; every pass runs in every "
                             "frame",
                             scene.size[0], scene.size[1], max_texture_side)};
    const std::vector<head::Place> places{std::string("cheek"),        std::string("eyebrow"),
                                          std::string("chin"),         std::string("forehead"),
                                          head::FacePoint{-0.3, -0.1}, head::FacePoint{-0.25, 0.45},
                                          head::FacePoint{0.25, -0.3}};
    static_assert(shared::MAX_WOUNDS >= 7);
    const ScratchFolder folder;
    scene::Scene changed = scene;
    changed.head = folder.saved(with_small_pictures(head_of(scene), max_texture_side), "head");
    scene::Wound wound = scene.wounds.empty() ? scene::Wound{} : scene.wounds.front();
    wound.width_mm /= 2;
    changed.wounds.clear();
    for (std::size_t count = 0; count <= places.size(); ++count) {
        if (count > 0) {
            wound.place = places[count - 1];
            changed.wounds.push_back(wound);
        }
        steps.x.push_back(double(count));
        steps.cases.push_back(whole_frame(make_stage(device, changed), scene.size));
    }
    return steps;
}

wound::PreparedWound first_wound(const stage::Stage& stage, const char* kind)
{
    if (stage.loaded().wounds.empty())
        throw base::InputError(fmt::format("--sweep {}", kind), "the scene has no wound",
                               "name a scene with one");
    return stage.loaded().wounds.front().prepared();
}

/// `count` points evenly spaced along the closed polyline `border`.
std::vector<cv::Point2d> sampled(const std::vector<cv::Point2d>& border, std::size_t count)
{
    std::vector<double> along{0};
    for (std::size_t i = 0; i < border.size(); ++i)
        along.push_back(along.back() + cv::norm(border[(i + 1) % border.size()] - border[i]));
    std::vector<cv::Point2d> points;
    for (std::size_t k = 0, i = 0; k < count; ++k) {
        const double at = along.back() * double(k) / double(count);
        while (along[i + 1] < at)
            ++i;
        const cv::Point2d a = border[i], b = border[(i + 1) % border.size()];
        points.push_back(a + (b - a) * ((at - along[i]) / std::max(along[i + 1] - along[i], 1e-12)));
    }
    return points;
}

Steps points(const scene::Scene& scene, const gpu::Device& device, const stage::Rounds& rounds)
{
    const auto stage = make_stage(device, scene);
    const wound::PreparedWound first = first_wound(*stage, "points");
    const wound::Healing healing = scene.wounds.front().healing;
    auto maps = std::make_shared<passes::WoundMaps>(passes::upload_wound(device, first.patch));
    Steps steps{.x_label = "control points",
                .fixed = fmt::format(
                    "the scene's first wound, {0}x{0} texels; points evenly along its border (the thin plate "
                    "also has fixed points on the patch's frame). grid: the default warp; dense: the paper's "
                    "thin plate in every texel",
                    first.patch.mask.cols),
                .prefixes = {"grid: ", "dense: "},
                .declaring = "the day's warps, on the CPU",
                .whole_frame = false};
    SweepSeries solving{"solving the flow, once per wound, on the CPU", {}, {}, {}};
    std::vector<std::shared_ptr<const wound::PreparedWound>> prepared;
    for (std::size_t count = 8; count <= 512; count *= 2) {
        auto wound = std::make_shared<wound::PreparedWound>(first);
        wound->control_points = sampled(wound->border, count);
        std::vector<double> times;
        for (int i = 0; i < std::clamp(rounds.timed / 4, 3, 9); ++i) {
            const auto start = std::chrono::steady_clock::now();
            wound->flow = wound::prepare_flow(wound->border, wound->control_points, wound->centroid);
            times.push_back(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        }
        steps.x.push_back(double(count));
        solving.x.push_back(double(count));
        solving.ms.push_back(base::spread_of(times).value());
        prepared.push_back(wound);
    }
    for (const wound::WarpModel level : {wound::WarpModel::Grid, wound::WarpModel::Dense})
        for (const auto& wound : prepared)
            steps.cases.push_back({"", "",
                                   [=](graph::Graph& graph, double position) {
                                       const wound::WoundDay today =
                                           wound::wound_at(*wound, healing, 2 + 4 * position, level);
                                       const passes::WoundTexture texture = passes::add_wound_texture(
                                           graph, "", *maps, today, passes::pack_warps(today));
                                       graph.readback("relief", texture.relief);
                                   },
                                   [] {}, true});
    steps.more.push_back(solving);
    return steps;
}

Steps tables(const scene::Scene& scene)
{
    const optics::HealingTissue tissue = optics::healing_tissue_or_file(scene.tissue);
    const wound::Healing healing = (scene.wounds.empty() ? scene::Wound{} : scene.wounds.front()).healing;
    const double last_day = std::max(1.0, *std::ranges::max_element(scene.days));
    Steps steps{.x_label = "texels",
                .fixed = "the scene's tissue and reflectance model; equal numbers of days and depths",
                .declaring = "the rows' tissue, on the CPU",
                .whole_frame = false};
    for (std::uint32_t side = 8; side <= 512; side *= 2) {
        steps.x.push_back(2.0 * side * side); // two tables: open and covered
        steps.cases.push_back(
            {"", "",
             [=, level = std::min(scene.reflectance_model, optics::ReflectanceModel::Calibrated)](
                 graph::Graph& graph, double) {
                 const passes::LutTissue rows =
                     passes::lut_tissue(wound::lut_rows(tissue, healing, side, last_day).days, last_day);
                 const passes::ReflectanceLut lut =
                     passes::add_reflectance_lut(graph, "reflectance_lut", rows, level, side);
                 graph.readback("table", lut.reflectance);
             },
             [] {}, true});
    }
    return steps;
}

Steps steps_of(const std::string& kind, const scene::Scene& scene, const gpu::Device& device,
               const stage::Rounds& rounds)
{
    if (kind == "size")
        return sizes(scene, device);
    if (kind == "triangles")
        return triangles(scene, device);
    if (kind == "wounds")
        return wounds(scene, device);
    if (kind == "points")
        return points(scene, device, rounds);
    return tables(scene);
}

/// "wound_texture 3" (the pass of the third wound) -> "wound_texture".
std::string without_number(const std::string& pass)
{
    const auto blank = pass.rfind(' ');
    return blank != std::string::npos && pass.find_first_not_of("0123456789", blank + 1) == std::string::npos
               ? pass.substr(0, blank)
               : pass;
}

/// Name of a pass, "frame" or the CPU work -> its time in every frame, ms.
std::map<std::string, std::vector<double>> times_of(const stage::Measurement& measurement, const Steps& steps)
{
    std::map<std::string, std::vector<double>> times;
    for (const stage::TimedFrame& frame : measurement.frames) {
        std::map<std::string, double> sums;
        for (const gpu::PassResult& pass : frame.result.passes)
            if (pass.gpu_ms)
                sums[without_number(pass.name)] += *pass.gpu_ms;
        sums[steps.declaring] = frame.declare_ms;
        if (steps.whole_frame)
            sums["frame"] = frame.wall_ms();
        for (const auto& [name, ms] : sums)
            times[name].push_back(ms);
    }
    return times;
}

} // namespace

std::vector<std::string> sweep_names()
{
    return {"size", "triangles", "wounds", "points", "lut"};
}

Sweep measure_sweep(const std::string& kind, const scene::Scene& scene, const gpu::Device& device,
                    const graph::ShaderLibrary& library, const stage::Rounds& rounds,
                    const std::function<void(int)>& progress)
{
    Steps steps = steps_of(kind, scene, device, rounds);
    const std::vector<stage::Measurement> measurements =
        stage::measure(device, library, steps.cases, rounds, progress);
    Sweep sweep{kind, steps.x_label, steps.fixed, steps.more};
    for (std::size_t i = 0; i < measurements.size(); ++i)
        for (const auto& [name, times] : times_of(measurements[i], steps)) {
            const std::string full = steps.prefixes[i / steps.x.size()] + name;
            auto series = std::ranges::find(sweep.series, full, &SweepSeries::name);
            if (series == sweep.series.end())
                series = sweep.series.insert(series, {full, {}, {}, {}});
            series->x.push_back(steps.x[i % steps.x.size()]);
            series->ms.push_back(base::spread_of(times).value());
        }
    for (SweepSeries& series : sweep.series) {
        std::vector<double> medians;
        for (const base::Spread& spread : series.ms)
            medians.push_back(spread.median);
        series.law = base::fit_power_law(series.x, medians);
    }
    std::ranges::stable_sort(sweep.series, std::ranges::greater{},
                             [](const SweepSeries& series) { return series.ms.back().median; });
    return sweep;
}

} // namespace report_command
