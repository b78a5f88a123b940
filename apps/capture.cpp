#include "apps/capture.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <unistd.h>

#include "apps/camera_record.hpp"
#include "apps/contact_sheet.hpp"
#include "apps/cost.hpp"
#include "apps/output.hpp"
#include "apps/writers.hpp"
#include "engine/image_io.hpp"

namespace app {
namespace {
using nlohmann::json;

constexpr std::size_t most_cells = 48;   // of healing.png, chosen evenly from all pictures
constexpr std::uint32_t close_up = 1280; // px, longest side: it is shown small

/// Wall-clock milliseconds since this process was started.
double process_ms()
{
    // Field 22 of /proc/self/stat: start time in clock ticks since boot, behind a name that may hold blanks
    // and parentheses.
    std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
    std::string line;
    std::getline(stat, line);
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
    return fmt::format("day {:g}", shot.day) + (shot.view.empty() ? open : "   " + shot.view);
}

class Capture
{
  public:
    Capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options, Progress& progress)
        : renderer_(renderer), stage_(stage), options_(options), progress_(progress),
          views_(chosen_views(stage, options.views)), shots_(shots_of_days(stage.scene().days, views_))
    {
        draw_options_.size = stage.scene().size;
        draw_options_.tile = std::min(options.tile, renderer.device.limits().maxImageDimension2D / 2 * 2);
        progress.expect(shots_.size());
    }

    json run(std::vector<std::string>& lines)
    {
        make_folder(options_.out);
        for (const Shot& shot : shots_)
            picture(shot);
        json record = header();
        if (options_.cost)
            record["cost"] = measure_cost(renderer_.executor, stage_, lines);
        record["first_picture_ms"] = *first_picture_ms_; // since the process started
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
        progress_.show(fmt::format("day {:g}{}{}", shot.day, shot.view.empty() ? "" : ", ", shot.view));
        const Drawing drawing = draw(renderer_, stage_, shot, draw_options_);
        if (!first_picture_ms_)
            first_picture_ms_ = process_ms();
        const std::string file = shot.name + ".png";
        const cv::Mat3b rgb = drawing.picture;
        writers_.push(rgb.total() * rgb.elemSize(),
                      [path = options_.out / file, rgb] { engine::write_png(path, rgb); });

        const std::vector<wound::WoundDay> today = stage_.wounds_on(shot.day);
        json record{{"day", shot.day},
                    {"file", file},
                    {"frame_ms", drawing.frame_ms},
                    {"passes", drawing.passes},
                    {"camera", camera_record(stage_, shot.camera, draw_options_.size)},
                    {"wounds", json::array()}};
        if (!shot.view.empty())
            record["view"] = shot.view;
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
            cells_.push_back({sheet_picture(rgb), sheet_close_up(shot), sheet_label(shot, today)});
        days_.push_back(std::move(record));
        progress_.step();
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
        if (views_.size() > 1)
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

json capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options, Progress& progress,
             std::vector<std::string>& lines)
{
    return Capture(renderer, stage, options, progress).run(lines);
}

} // namespace app
