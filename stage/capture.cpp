#include "stage/capture.hpp"

#include "scene/file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/contact_sheet.hpp"
#include "base/file.hpp"
#include "base/film.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/program.hpp"
#include "base/writers.hpp"
#include "stage/camera_record.hpp"
#include "stage/cost.hpp"

namespace stage {
namespace {
using nlohmann::json;

constexpr std::size_t most_cells = 48;   // of healing.png, spread evenly over all pictures
constexpr std::uint32_t close_up = 1280; // px, longest side; the sheet shows it scaled down

/// Scales `size` down, keeping its aspect, so that the longer side is at most `largest`.
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

std::string sheet_label(const scene::Shot& shot, const std::vector<wound::WoundDay>& today)
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

/// The film's file; the name of a named view is appended to the stem.
std::filesystem::path film_path(const std::filesystem::path& video, const std::string& view)
{
    std::filesystem::path path = video;
    if (!view.empty())
        path.replace_filename(video.stem().string() + "_" + view + video.extension().string());
    return path;
}

std::vector<scene::Shot> pictures_wanted(const Stage& stage, const std::vector<scene::NamedCamera>& views,
                                         const CaptureOptions& options)
{
    const std::vector<double>& days = stage.scene().days;
    if (options.orbit == 0)
        return scene::shots_of_days(days, views);
    std::vector<scene::Shot> shots;
    for (const scene::NamedCamera& view : views)
        std::ranges::copy(
            scene::shots_of_sweep(stage.loaded(), view,
                                  {days.front(), days.back(), options.orbit_deg, options.orbit, "orbit"}),
            std::back_inserter(shots));
    return shots;
}

class Capture
{
  public:
    Capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options, base::Progress& progress)
        : renderer_(renderer), stage_(stage), options_(options), progress_(progress),
          views_(scene::chosen_views(stage.loaded(), options.views)),
          shots_(pictures_wanted(stage, views_, options))
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
        base::make_folder(options_.out);
        for (const scene::Shot& shot : shots_)
            picture(shot);
        json record = header();
        if (!options_.video.empty())
            for (const scene::NamedCamera& view : views_)
                record["films"].push_back(film(view));
        if (options_.cost)
            record["cost"] = measure_cost(renderer_.device, renderer_.shaders, stage_, lines);
        record["first_picture_ms"] = first_picture_ms_ ? json(*first_picture_ms_) : json(nullptr);
        record["days"] = days_;
        if (options_.sheet)
            base::write_png(options_.out / "healing.png", base::contact_sheet(title(), cells_, 6));
        writers_.finish();
        base::write_json(options_.out / "capture.json", record);
        fail_on_validation(renderer_.device);
        return record;
    }

  private:
    void picture(const scene::Shot& shot)
    {
        progress_.show(label(shot));
        const Drawing drawing = draw(renderer_, stage_, shot, draw_options_);
        if (!first_picture_ms_)
            first_picture_ms_ = base::ms_since_start();
        write(shot, drawing);
        const std::vector<wound::WoundDay>& today = *drawing.wounds;
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
            const double initial = cv::sum(stage_.loaded().wounds[i].prepared().patch.mask)[0];
            record["wounds"].push_back(wound_record(today[i], drawing.bed_texels[i] / initial));
        }
        if (!today.empty())
            record.update(record["wounds"][0]); // also copy the first wound's numbers to the top level
        for (std::size_t i = 0; i < today.size(); ++i)
            record["wounds"][i]["scene_wound"] =
                stage_.loaded().wounds[i].scene_wound; // index into the scene's wounds
        if (options_.after_picture)
            options_.after_picture(stage_, shot, record);
        if (options_.sheet && on_sheet(days_.size()))
            cells_.push_back(
                {base::sheet_picture(drawing.picture), sheet_close_up(shot), sheet_label(shot, today)});
        days_.push_back(std::move(record));
        progress_.step();
    }

    void write(const scene::Shot& shot, const Drawing& drawing)
    {
        const auto bytes = [](const cv::Mat& mat) { return mat.total() * mat.elemSize(); };
        writers_.push(bytes(drawing.picture),
                      [path = options_.out / (shot.name + ".png"), picture = drawing.picture] {
                          if (picture.channels() == 4)
                              base::write_png(path, cv::Mat4b(picture));
                          else
                              base::write_png(path, cv::Mat3b(picture));
                      });
        if (options_.exr)
            writers_.push(bytes(drawing.radiance),
                          [path = options_.out / (shot.name + ".exr"), radiance = drawing.radiance] {
                              if (radiance.channels() == 4)
                                  base::write_exr(path, cv::Mat4f(radiance), base::ExrDepth::Half);
                              else
                                  base::write_exr(path, cv::Mat3f(radiance), base::ExrDepth::Half);
                          });
    }

    /// Draws the frames like the pictures; while one frame is drawn, the previous one is encoded.
    json film(const scene::NamedCamera& view)
    {
        const std::vector<double>& days = stage_.scene().days;
        const scene::Sweep sweep{days.front(), days.back(), options_.orbit > 0 ? options_.orbit_deg : 0,
                                 film_frames(options_)};
        DrawOptions frame_options = draw_options_;
        frame_options.radiance = frame_options.areas = false;
        if (sweep.first_day == sweep.last_day) // a turntable
            frame_options.light_scale = stage_.light_scale(view.camera, frame_options.size[1]);
        const std::filesystem::path path = film_path(options_.video, view.name);
        base::Film film(path, frame_options.size, options_.fps);
        json record{{"file", path.string()}, {"fps", options_.fps}, {"frames", json::array()}};
        if (sweep.turn_deg == 0)
            record["camera"] = camera_record(stage_, view.camera, draw_options_.size);
        if (!view.name.empty())
            record["view"] = view.name;
        std::future<void> encoding;
        for (const scene::Shot& shot : scene::shots_of_sweep(stage_.loaded(), view, sweep)) {
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

    static std::string label(const scene::Shot& shot)
    {
        return fmt::format("day {:.4g}{}{}", shot.day, shot.view.empty() ? "" : ", ", shot.view);
    }

    /// Whether the picture of this index gets a cell on the sheet.
    bool on_sheet(std::size_t index) const
    {
        const std::size_t cells = std::min(most_cells, shots_.size());
        return (index * cells + shots_.size() - 1) / shots_.size() !=
               ((index + 1) * cells + shots_.size() - 1) / shots_.size();
    }

    /// A close-up of the first wound; empty with several views or an orbit.
    cv::Mat3b sheet_close_up(const scene::Shot& shot)
    {
        if (views_.size() > 1 || options_.orbit > 0)
            return {};
        scene::Shot near = shot;
        near.camera = stage_.loaded().close_up(0);
        DrawOptions small = draw_options_;
        small.size = within(small.size, close_up);
        return base::sheet_picture(draw(renderer_, stage_, near, small).picture);
    }

    std::string title() const
    {
        return fmt::format("{}   {} mode   {}", options_.title, options_.mode, renderer_.device.info().name);
    }

    json header() const
    {
        const gpu::DeviceInfo& device = renderer_.device.info();
        return {{"format", "cicatrix capture"},
                {"version", 1},
                {"device", device.name},
                {"driver", device.driver},
                {"software_rasteriser", device.software},
                {"size", draw_options_.size},
                {"tiles", tiles_of(draw_options_).size()},
                {"mode", options_.mode},
                {"scene", scene::to_json(stage_.scene())}};
    }

    Renderer& renderer_;
    const Stage& stage_;
    const CaptureOptions& options_;
    base::Progress& progress_;
    const std::vector<scene::NamedCamera> views_;
    const std::vector<scene::Shot> shots_;
    DrawOptions draw_options_;
    std::optional<double> first_picture_ms_;
    json days_ = json::array();
    std::vector<base::SheetCell> cells_;
    base::Writers writers_;
};

} // namespace

void check_capture(const CaptureOptions& options, const scene::Scene& scene)
{
    if (options.tile < 64 || options.tile > 16384 || options.tile % 2 != 0)
        throw base::InputError("--tile", fmt::format("is {}", options.tile),
                               "give an even number of pixels from 64 to 16384");
    scene::view_names(scene, options.views);
    if (options.video.empty())
        return;
    if (options.video.extension() != ".mp4")
        throw base::InputError("--video", "\"" + options.video.string() + "\" is not an .mp4 file",
                               "films are H.264 in MP4: give the file a name that ends in .mp4");
    if (options.transparent)
        throw base::InputError("--transparent", "cannot be combined with --video, because H.264 has no alpha",
                               "omit one of them; --orbit or --days make pictures with alpha");
    if (film_frames(options) < 2)
        throw base::InputError("--video", "would have fewer than two frames",
                               "give a longer --duration or more --fps");
    if (scene.days.front() == scene.days.back() && options.orbit == 0)
        throw base::InputError("--video",
                               fmt::format("nothing moves: there is only day {:g}", scene.days.front()),
                               "give several --days, or --orbit");
    base::Film::check_ffmpeg();
}

json capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options, base::Progress& progress,
             std::vector<std::string>& lines)
{
    return Capture(renderer, stage, options, progress).run(lines);
}

} // namespace stage
