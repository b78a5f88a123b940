#include "apps/capture.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <unistd.h>

#include "apps/contact_sheet.hpp"
#include "apps/cost.hpp"
#include "apps/output.hpp"
#include "apps/scene_options.hpp"
#include "apps/stage.hpp"
#include "engine/executor.hpp"
#include "engine/image_io.hpp"
#include "wound/input_error.hpp"

namespace app {
namespace {
using nlohmann::json;

struct CaptureOptions : SceneOptions
{
    std::filesystem::path out = "out";
    bool no_cost = false;
};

/// Files being encoded while the next frame is drawn. An error of any of them surfaces in finish() or push().
class Writers
{
  public:
    template <typename Work>
    void push(Work work)
    {
        while (running_.size() >= 4)
            pop();
        running_.push_back(std::async(std::launch::async, std::move(work)));
    }
    void finish()
    {
        while (!running_.empty())
            pop();
    }

  private:
    void pop()
    {
        std::future<void> first = std::move(running_.front());
        running_.pop_front();
        first.get();
    }
    std::deque<std::future<void>> running_;
};

/// day_005.png; day_005.5.png; the second frame of the same day is day_005_2.png.
std::string picture_name(double day, int repetition)
{
    std::string name = fmt::format("day_{:0>3}", day == std::floor(day) ? fmt::format("{:.0f}", day)
                                                                        : fmt::format("{:07.3f}", day));
    return name + (repetition > 1 ? fmt::format("_{}", repetition) : "") + ".png";
}

cv::Mat3b to_rgb(const cv::Mat& rgba)
{
    cv::Mat3b rgb;
    cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
    return rgb;
}

json pass_costs(const engine::FrameResult& frame)
{
    json passes = json::array();
    for (const engine::PassResult& pass : frame.passes)
        passes.push_back({{"name", pass.name},
                          {"state", engine::name_of(pass.state)},
                          {"reason", pass.reason},
                          {"gpu_ms", pass.gpu_ms ? json(*pass.gpu_ms) : json(nullptr)},
                          {"cpu_ms", pass.cpu_ms}});
    return passes;
}

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

/// Coverage of the open bed in the warped mask, in texels.
double bed_texels(const cv::Mat& state)
{
    cv::Mat4f values;
    state.convertTo(values, CV_32F);
    return cv::sum(values)[2];
}

json wound_record(const wound::WoundDay& today, double mask_area_ratio)
{
    return {{"unhealed_ratio", today.unhealed_ratio},
            {"recovery_ratio", today.recovery_ratio},
            {"border_ratio", today.border_ratio},
            {"mask_area_ratio", mask_area_ratio}};
}

class Capture
{
  public:
    Capture(const CaptureOptions& options, const Scene& scene)
        : options_(options), scene_(scene), terminal_(::isatty(STDERR_FILENO) != 0)
    {
    }

    void run()
    {
        make_folder(options_.out);
        auto props = std::async(std::launch::async, [this] { return Stage::prepare(scene_); });
        engine::Device device(device_options(options_));
        check_size(device);
        engine::ShaderLibrary library;
        engine::Executor executor(device, library);
        const Stage stage(device, scene_, props.get());
        for (const std::string& note : stage.notes())
            fmt::print(stderr, "note: {}\n", note);

        for (const double day : scene_.days)
            capture_day(executor, stage, day);
        std::vector<std::string> cost_lines;
        json record = header(device);
        if (!options_.no_cost)
            record["cost"] = measure_cost(device, library, stage, cost_lines);
        record["first_picture_ms"] = *first_picture_ms_; // since the process started
        record["days"] = days_;
        writers_.push([&] {
            engine::write_png(options_.out / "healing.png", contact_sheet(title(device), cells_, 6));
        });
        writers_.finish();
        write_json(options_.out / "capture.json", record);
        fail_on_validation(device);
        progress("");
        fmt::print("{} pictures, healing.png and capture.json in {}\n", days_.size(), options_.out.string());
        for (const std::string& line : cost_lines)
            fmt::print("{}\n", line);
    }

  private:
    void check_size(const engine::Device& device) const
    {
        const std::uint32_t largest = device.limits().maxImageDimension2D;
        if (std::max(scene_.size[0], scene_.size[1]) > largest)
            throw cicatrix::InputError("--size",
                                       fmt::format("{}x{} is more than {} can draw", scene_.size[0],
                                                   scene_.size[1], device.info().name),
                                       fmt::format("stay within {}x{}", largest, largest));
    }

    void progress(const std::string& text) const
    {
        if (terminal_)
            fmt::print(stderr, "\r\033[K{}", text);
    }

    void capture_day(engine::Executor& executor, const Stage& stage, double day)
    {
        progress(fmt::format("day {:g} ({} of {})", day, days_.size() + 1, scene_.days.size()));
        const std::vector<wound::WoundDay> today = stage.wounds_on(day);
        engine::Graph graph;
        const passes::FrameImages images =
            stage.declare(graph, today, stage.camera(), scene_.shading, scene_.size);
        const engine::ReadbackId picture = graph.readback("picture", images.picture);
        std::vector<engine::ReadbackId> states;
        for (const passes::WoundTexture& wound : images.wounds)
            states.push_back(graph.readback("state", wound.state));
        const engine::FrameResult frame = executor.run(graph);

        const std::string file = picture_name(day, ++repetitions_[day]);
        const cv::Mat3b rgb = to_rgb(frame.mat(picture));
        if (!first_picture_ms_)
            first_picture_ms_ = process_ms();
        writers_.push([path = options_.out / file, rgb] { engine::write_png(path, rgb); });

        json record{{"day", day},
                    {"file", file},
                    {"frame_ms", frame.frame_ms},
                    {"passes", pass_costs(frame)},
                    {"wounds", json::array()}};
        for (std::size_t i = 0; i < today.size(); ++i) {
            const double initial = cv::sum(stage.prepared()[i].patch.mask)[0];
            record["wounds"].push_back(wound_record(today[i], bed_texels(frame.mat(states[i])) / initial));
        }
        if (!today.empty())
            record.update(record["wounds"][0]); // the first wound's numbers also stand at the top
        days_.push_back(std::move(record));
        cells_.push_back({rgb, close_up(executor, stage, today), sheet_label(day, today)});
    }

    cv::Mat3b close_up(engine::Executor& executor, const Stage& stage,
                       const std::vector<wound::WoundDay>& today)
    {
        engine::Graph graph;
        const passes::FrameImages images =
            stage.declare(graph, today, stage.close_up(0), scene_.shading, scene_.size);
        const engine::ReadbackId picture = graph.readback("picture", images.picture);
        const engine::FrameResult frame = executor.run(graph);
        return to_rgb(frame.mat(picture));
    }

    static std::string sheet_label(double day, const std::vector<wound::WoundDay>& today)
    {
        return fmt::format("day {:g}", day) +
               (today.empty() ? "" : fmt::format("   {:.0f} % open", 100 * today[0].unhealed_ratio));
    }

    std::string title(const engine::Device& device) const
    {
        return fmt::format("{}   {} mode   {}",
                           options_.scene.empty() ? "default scene"
                                                  : std::filesystem::path(options_.scene).stem().string(),
                           options_.mode == "published" ? "published" : "corrected", device.info().name);
    }

    json header(const engine::Device& device) const
    {
        return {{"device", device.info().name},
                {"driver", device.info().driver},
                {"software_rasteriser", device.info().software},
                {"size", {scene_.size[0], scene_.size[1]}},
                {"mode", options_.mode == "published" ? "published" : "corrected"},
                {"scene", to_json(scene_)}};
    }

    static void fail_on_validation(const engine::Device& device)
    {
        const std::vector<std::string> messages = device.validation_messages();
        if (!messages.empty())
            throw std::runtime_error(
                fmt::format("{} validation messages; the first: {}", messages.size(), messages.front()));
    }

    const CaptureOptions& options_;
    const Scene& scene_;
    const bool terminal_;
    std::optional<double> first_picture_ms_;
    std::map<double, int> repetitions_;
    json days_ = json::array();
    std::vector<SheetCell> cells_;
    Writers writers_;
};

} // namespace

void add_capture_command(CLI::App& program)
{
    auto options = std::make_shared<CaptureOptions>();
    CLI::App* command =
        program.add_subcommand("capture", "Pictures of a wound healing, day by day, and what each cost");
    add_scene_options(*command, *options);
    command->add_option("--out", options->out, "Folder for the pictures, healing.png and capture.json")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_flag("--no-cost", options->no_cost, "Leave out the cost measurement at the end");
    command->footer(
        "Example: cicatrix capture --days 0:30:3 --wound photo.jpg --mask mask.png --out healing");
    command->callback([options] {
        const Scene scene = chosen_scene(*options);
        Capture(*options, scene).run();
    });
}

} // namespace app
