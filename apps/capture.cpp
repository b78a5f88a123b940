#include "apps/capture.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <unistd.h>

#include "apps/camera_record.hpp"
#include "apps/contact_sheet.hpp"
#include "apps/cost.hpp"
#include "apps/film.hpp"
#include "apps/output.hpp"
#include "apps/writers.hpp"
#include "engine/image_io.hpp"
#include "wound/input_error.hpp"

namespace app {
namespace {
using nlohmann::json;

constexpr std::size_t most_cells = 48;   // of healing.png, chosen evenly from all pictures
constexpr std::uint32_t close_up = 1280; // px, longest side: it is shown small

/// Wall-clock milliseconds since this process was started; none where /proc does not tell.
std::optional<double> process_ms()
{
    // Field 22 of /proc/self/stat: start time in clock ticks since boot, behind a name that may hold blanks
    // and parentheses.
    std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
    std::string line;
    if (!std::getline(stat, line) || !uptime)
        return std::nullopt;
    std::istringstream fields(line.substr(line.rfind(')') + 2));
    std::string field;
    for (int i = 3; i <= 22; ++i)
        fields >> field;
    double now = 0;
    uptime >> now;
    return 1e3 * (now - std::stod(field) / double(::sysconf(_SC_CLK_TCK)));
}

/// The same shape, the longer side at most `largest`.
std::array<std::uint32_t, 2> within(std::array<std::uint32_t, 2> size, std::uint32_t largest)
{
    const double scale = std::min(1.0, double(largest) / std::max(size[0], size[1]));
    return {std::max(1u, std::uint32_t(size[0] * scale)), std::max(1u, std::uint32_t(size[1] * scale))};
}

json wound_record(const wound::WoundDay& today, double mask_area_ratio)
{
    return {{"unhealed_ratio", today.unhealed_ratio},
            {"recovery_ratio", today.recovery_ratio},
            {"border_ratio", today.border_ratio},
            {"mask_area_ratio", mask_area_ratio}};
}

std::string sheet_label(const Shot& shot, const std::vector<wound::WoundDay>& today)
{
    const std::string open =
        today.empty() ? "" : fmt::format("   {:.0f} % open", 100 * today[0].unhealed_ratio);
    const std::string turn = shot.turn_deg == 0 ? "" : fmt::format("   {:.0f} deg", shot.turn_deg);
    return fmt::format("day {:.4g}", shot.day) + turn + (shot.view.empty() ? open : "   " + shot.view);
}

std::size_t film_frames(const CaptureOptions& options)
{
    return std::size_t(std::lround(options.fps * options.duration_s));
}

/// The film's file; that of one view among several carries its name.
std::filesystem::path film_path(const std::filesystem::path& video, const std::string& view)
{
    std::filesystem::path path = video;
    if (!view.empty())
        path.replace_filename(video.stem().string() + "_" + view + video.extension().string());
    return path;
}

std::vector<Shot> pictures_wanted(const Stage& stage, const std::vector<View>& views,
                                  const CaptureOptions& options)
{
    const std::vector<double>& days = stage.scene().days;
    if (options.orbit == 0)
        return shots_of_days(days, views);
    std::vector<Shot> shots;
    for (const View& view : views)
        std::ranges::copy(
            shots_of_sweep(stage, view,
                           {days.front(), days.back(), options.orbit_deg, options.orbit, "orbit"}),
            std::back_inserter(shots));
    return shots;
}

class Capture
{
  public:
    Capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options, Progress& progress)
        : renderer_(renderer), stage_(stage), options_(options), progress_(progress),
          views_(chosen_views(stage, options.views)), shots_(pictures_wanted(stage, views_, options))
    {
        draw_options_.size = stage.scene().size;
        draw_options_.tile = std::min(options.tile, renderer.device.limits().maxImageDimension2D / 2 * 2);
        draw_options_.transparent = options.transparent;
        draw_options_.radiance = options.exr;
        progress.expect(shots_.size());
        if (!options.video.empty())
            progress.expect(views_.size() * film_frames(options));
    }

    json run(std::vector<std::string>& lines)
    {
        make_folder(options_.out);
        for (const Shot& shot : shots_)
            picture(shot);
        json record = header();
        if (!options_.video.empty())
            for (const View& view : views_)
                record["films"].push_back(film(view));
        if (options_.cost)
            record["cost"] = measure_cost(renderer_.device, renderer_.shaders, stage_, lines);
        record["first_picture_ms"] =
            first_picture_ms_ ? json(*first_picture_ms_) : json(nullptr); // since the process started
        record["days"] = days_;
        if (options_.sheet)
            engine::write_png(options_.out / "healing.png", contact_sheet(title(), cells_, 6));
        writers_.finish();
        write_json(options_.out / "capture.json", record);
        fail_on_validation(renderer_.device);
        return record;
    }

  private:
    void picture(const Shot& shot)
    {
        progress_.show(label(shot));
        const Drawing drawing = draw(renderer_, stage_, shot, draw_options_);
        if (!first_picture_ms_)
            first_picture_ms_ = process_ms();
        write(shot, drawing);
        const std::vector<wound::WoundDay> today = stage_.wounds_on(shot.day);
        json record{{"day", shot.day},
                    {"file", shot.name + ".png"},
                    {"frame_ms", drawing.frame_ms},
                    {"passes", drawing.passes},
                    {"camera", camera_record(stage_, shot.camera, draw_options_.size)},
                    {"wounds", json::array()}};
        if (!shot.view.empty())
            record["view"] = shot.view;
        if (options_.exr)
            record["exr"] = shot.name + ".exr";
        if (options_.orbit > 0)
            record["turn_deg"] = shot.turn_deg;
        for (std::size_t i = 0; i < today.size(); ++i) {
            const double initial = cv::sum(stage_.prepared()[i].patch.mask)[0];
            record["wounds"].push_back(wound_record(today[i], drawing.bed_texels[i] / initial));
        }
        if (!today.empty())
            record.update(record["wounds"][0]); // the first wound's numbers also stand at the top
        for (std::size_t i = 0; i < today.size(); ++i)
            record["wounds"][i]["scene_wound"] = stage_.scene_wounds()[i]; // index into the scene's wounds
        if (options_.after_picture)
            options_.after_picture(stage_, shot, record);
        if (options_.sheet && on_sheet(days_.size()))
            cells_.push_back(
                {sheet_picture(drawing.picture), sheet_close_up(shot), sheet_label(shot, today)});
        days_.push_back(std::move(record));
        progress_.step();
    }

    void write(const Shot& shot, const Drawing& drawing)
    {
        const auto bytes = [](const cv::Mat& mat) { return mat.total() * mat.elemSize(); };
        writers_.push(bytes(drawing.picture),
                      [path = options_.out / (shot.name + ".png"), picture = drawing.picture] {
                          if (picture.channels() == 4)
                              engine::write_png(path, cv::Mat4b(picture));
                          else
                              engine::write_png(path, cv::Mat3b(picture));
                      });
        if (options_.exr)
            writers_.push(bytes(drawing.radiance),
                          [path = options_.out / (shot.name + ".exr"), radiance = drawing.radiance] {
                              if (radiance.channels() == 4)
                                  engine::write_exr(path, cv::Mat4f(radiance), engine::ExrDepth::Half);
                              else
                                  engine::write_exr(path, cv::Mat3f(radiance), engine::ExrDepth::Half);
                          });
    }

    /// The same drawing as the pictures', frame by frame; while one is drawn, the one before is encoded.
    json film(const View& view)
    {
        const std::vector<double>& days = stage_.scene().days;
        const Sweep sweep{days.front(), days.back(), options_.orbit > 0 ? options_.orbit_deg : 0,
                          film_frames(options_)};
        DrawOptions frame_options = draw_options_;
        frame_options.radiance = frame_options.areas = false;
        const std::filesystem::path path = film_path(options_.video, view.name);
        Film film(path, frame_options.size, options_.fps);
        json record{{"file", path.string()}, {"fps", options_.fps}, {"frames", json::array()}};
        if (sweep.turn_deg == 0)
            record["camera"] = camera_record(stage_, view.camera, draw_options_.size);
        if (!view.name.empty())
            record["view"] = view.name;
        std::future<void> encoding;
        for (const Shot& shot : shots_of_sweep(stage_, view, sweep)) {
            progress_.show("film, " + label(shot));
            const cv::Mat3b picture = draw(renderer_, stage_, shot, frame_options).picture;
            if (encoding.valid())
                encoding.get();
            encoding = std::async(std::launch::async, [&film, picture] { film.add(picture); });
            record["frames"].push_back({{"day", shot.day}});
            if (sweep.turn_deg != 0)
                record["frames"].back().update(
                    {{"turn_deg", shot.turn_deg},
                     {"camera", camera_record(stage_, shot.camera, draw_options_.size)}});
            progress_.step();
        }
        encoding.get();
        film.finish();
        return record;
    }

    static std::string label(const Shot& shot)
    {
        return fmt::format("day {:.4g}{}{}", shot.day, shot.view.empty() ? "" : ", ", shot.view);
    }

    /// Whether the picture of this number has a cell.
    bool on_sheet(std::size_t index) const
    {
        const std::size_t cells = std::min(most_cells, shots_.size());
        return (index * cells + shots_.size() - 1) / shots_.size() !=
               ((index + 1) * cells + shots_.size() - 1) / shots_.size();
    }

    /// Beside a single view, the wound is shown large.
    cv::Mat3b sheet_close_up(const Shot& shot)
    {
        if (views_.size() > 1 || options_.orbit > 0)
            return {};
        Shot near = shot;
        near.camera = stage_.close_up(0);
        DrawOptions small = draw_options_;
        small.size = within(small.size, close_up);
        return sheet_picture(draw(renderer_, stage_, near, small).picture);
    }

    std::string title() const
    {
        return fmt::format("{}   {} mode   {}", options_.title, options_.mode, renderer_.device.info().name);
    }

    json header() const
    {
        const engine::DeviceInfo& device = renderer_.device.info();
        return {{"device", device.name},
                {"driver", device.driver},
                {"software_rasteriser", device.software},
                {"size", draw_options_.size},
                {"tiles", canvases(draw_options_).size()},
                {"mode", options_.mode},
                {"scene", to_json(stage_.scene())}};
    }

    Renderer& renderer_;
    const Stage& stage_;
    const CaptureOptions& options_;
    Progress& progress_;
    const std::vector<View> views_;
    const std::vector<Shot> shots_;
    DrawOptions draw_options_;
    std::optional<double> first_picture_ms_;
    json days_ = json::array();
    std::vector<SheetCell> cells_;
    Writers writers_;
};

} // namespace

void check_capture(const CaptureOptions& options, const Scene& scene)
{
    if (options.tile < 64 || options.tile > 16384 || options.tile % 2 != 0)
        throw cicatrix::InputError("--tile", fmt::format("is {}", options.tile),
                                   "give an even number of pixels from 64 to 16384");
    view_names(scene, options.views);
    if (options.video.empty())
        return;
    if (options.video.extension() != ".mp4")
        throw cicatrix::InputError("--video", "\"" + options.video.string() + "\" is no .mp4",
                                   "films are H.264 in MP4: give the file a name that ends in .mp4");
    if (options.transparent)
        throw cicatrix::InputError(
            "--transparent", "does not go with --video, for H.264 holds no alpha",
            "leave one of them out; pictures with alpha can be made by --orbit or --days");
    if (film_frames(options) < 2)
        throw cicatrix::InputError("--video", "would have less than two frames",
                                   "give a longer --duration or more --fps");
    if (scene.days.front() == scene.days.back() && options.orbit == 0)
        throw cicatrix::InputError("--video",
                                   fmt::format("nothing moves: there is only day {:g}", scene.days.front()),
                                   "give several --days, or --orbit");
    Film::check_ffmpeg();
}

json capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options, Progress& progress,
             std::vector<std::string>& lines)
{
    return Capture(renderer, stage, options, progress).run(lines);
}

} // namespace app
