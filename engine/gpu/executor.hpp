// Executes declared frames on a device: schedules them, keeps the images, records only what must run, labels
// and times every pass, reads results back. One Executor per device; it must be gone before the device.
#pragma once
#include "engine/gpu/device.hpp"
#include "engine/gpu/frame_slot.hpp"
#include "engine/gpu/pipelines.hpp"
#include "engine/graph/graph.hpp"
#include "engine/graph/schedule.hpp"
#include "engine/graph/shader_library.hpp"

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gpu {

class Recorder;
struct BoundImage;

/// All times of a frame lie on one line, in milliseconds since it was handed to submit() or run().
struct GpuSpan
{
    double begin_ms = 0; // as exact as FrameResult::alignment says
    double ms = 0;
    double end_ms() const { return begin_ms + ms; }
};

struct PassResult
{
    std::string name;
    graph::PassState state = graph::PassState::Run;
    std::string reason;
    std::optional<double> gpu_ms;       // only of passes that ran, on a device with timestamps
    std::optional<double> gpu_begin_ms; // the same
    double cpu_ms = 0;                  // recording; includes compiling the pipelines on the first run
    double cpu_begin_ms = 0;
    std::uint64_t bytes_written = 0; // to its declared images, as far as they are stored; 0 unless it ran
    std::optional<Invocations> invocations; // only of passes that ran, when counted and the device can
};

/// How the GPU's times were laid on the host's line.
enum class Alignment : std::uint8_t
{
    None,       // no timestamps
    Bounds,     // centred between the submission and its completion
    Calibrated, // by the device's own word on both clocks
};
const char* name_of(Alignment alignment);

/// Where a frame's wall clock went on the host: one after the other, frame_ms in sum.
struct HostTimes
{
    double schedule_ms = 0; // checking and scheduling the declaration, making images
    double record_ms = 0;   // the commands of all passes and read-backs
    double submit_ms = 0;   // handing them over
    double wait_ms = 0;     // until they were done; with frames in flight also what the caller did meanwhile
    double readback_ms = 0; // fetching results
};

struct FrameResult
{
    std::vector<PassResult> passes; // in order of execution
    double frame_ms = 0;            // wall clock, from the declaration's check to the data on the host
    std::optional<double> gpu_ms;   // from the first pass to the last, on a device with timestamps
    std::optional<GpuSpan> copy;    // of what is read back into a buffer of the host's
    HostTimes host;
    Alignment alignment = Alignment::None;
    double alignment_error_ms = 0; // either way, at most
    graph::Plan plan;

    struct Readback
    {
        std::string name;
        graph::ImageDesc desc;
        std::vector<std::byte> bytes; // rows tightly packed
    };
    std::vector<Readback> readbacks;

    /// The picture as it lies in `bytes`: CV_8UC4 for RGBA8, CV_32FC4 for RGBA32F, ... Shares their memory.
    cv::Mat mat(graph::ReadbackId id) const;
    const PassResult& pass(std::string_view name) const; // throws std::out_of_range when there is none
};

/// What to find out beside the times that cost nothing.
struct Measuring
{
    bool align = false; // calibrated timestamps, where the device has them
    bool count = false; // shader invocations, where the device can; may slow the passes down
};

/// Names a submitted frame.
struct FrameToken
{
    std::uint64_t number = 0;
};

class Executor
{
  public:
    Executor(const Device& device, const graph::ShaderLibrary& library);
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Runs one frame and waits for it. Throws std::logic_error when the graph
    /// is declared wrongly, naming every mistake, and base::InputError when
    /// the device fails; the next frame starts from what was finished before.
    FrameResult run(const graph::Graph& graph);

    /// The same in two steps, with up to two frames in flight; a third submit waits for the first.
    FrameToken submit(const graph::Graph& graph);
    /// Must be asked for before the second submit after this one.
    FrameResult finish(FrameToken token);

    /// Whether the frame would show what is there already: no pass of it would run. Asked before submitting,
    /// so that a window in which nothing changes draws nothing. A pass that asks to run every frame is never
    /// up to date. Throws std::logic_error as run() does.
    bool up_to_date(const graph::Graph& graph) const;

    /// From the next frame on. Nothing at first.
    void measure(const Measuring& what) { measuring_ = what; }

    /// The image a graph presented last, in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
    /// for commands submitted to the same queue.
    VkImage presented(std::string_view image_name) const;

    /// Forgets what the images hold: the next frame runs everything it needs.
    void forget();

  private:
    struct Frame;
    void match_images(const graph::Graph& graph, const graph::Plan& plan);
    std::vector<BoundImage> bind_images(const graph::Graph& graph) const;
    void record_passes(const graph::Graph& graph, Frame& frame, VkCommandBuffer commands,
                       std::span<const BoundImage> bound);
    void record_readbacks(const graph::Graph& graph, Frame& frame, Recorder& recorder);
    static void read_times(const Frame& frame, std::chrono::steady_clock::time_point done,
                           FrameResult& result);

    const Device& device_;
    const graph::ShaderLibrary& library_;
    Pipelines pipelines_;
    std::map<std::string, Image, std::less<>> images_; // by name, as in memory_.images
    graph::Memory memory_;
    Measuring measuring_;
    std::array<std::unique_ptr<Frame>, 2> frames_;
    std::uint64_t submitted_ = 0;
};

} // namespace gpu
