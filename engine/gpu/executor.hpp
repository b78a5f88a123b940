// Executes declared frames on a device: schedules them, owns the images, records the passes that must run,
// labels and times them, reads results back. One Executor per device; destroy it before the device.
#pragma once
#include "engine/gpu/device.hpp"
#include "engine/gpu/frame_slot.hpp"
#include "engine/gpu/pipelines.hpp"
#include "engine/graph/graph.hpp"
#include "engine/graph/pass_work.hpp"
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

/// All times of a frame are in milliseconds since the call to submit() or run().
struct GpuSpan
{
    double begin_ms = 0; // accuracy: FrameResult::alignment_error_ms
    double ms = 0;
    double end_ms() const { return begin_ms + ms; }
};

struct PassResult
{
    std::string name;
    graph::PassState state = graph::PassState::Run;
    std::string reason;
    std::optional<double> gpu_ms;       // of passes that ran, on a device with timestamps
    std::optional<double> gpu_begin_ms; // the same
    double cpu_ms = 0;                  // recording; includes compiling pipelines on the first run
    double cpu_begin_ms = 0;
    graph::PassWork work;                   // nothing unless it ran
    std::optional<Invocations> invocations; // of passes that ran, if counted and supported
};

/// How GPU timestamps were converted to the host's clock.
enum class Alignment : std::uint8_t
{
    None,       // no timestamps
    Bounds,     // centred between the submission and its completion
    Calibrated, // by calibrated timestamps
};
const char* name_of(Alignment alignment);

/// Phases of a frame in wall-clock time on the host, in order; their sum is frame_ms.
struct HostTimes
{
    double schedule_ms = 0; // checking and scheduling the declaration, creating images
    double record_ms = 0;   // recording all passes and readbacks
    double submit_ms = 0;   // submitting the commands
    double wait_ms = 0;     // until completion; includes the caller's work between submit() and finish()
    double readback_ms = 0; // copying results from the readback buffer
};

struct FrameResult
{
    std::vector<PassResult> passes; // in order of execution
    double frame_ms = 0;            // wall clock, from checking the declaration to the data on the host
    std::optional<double> gpu_ms;   // start of the first pass to end of the last; needs timestamps
    std::optional<GpuSpan> copy;    // of the readbacks into a host-visible buffer
    HostTimes host;
    Alignment alignment = Alignment::None;
    double alignment_error_ms = 0; // at most, in either direction
    graph::Plan plan;

    struct Readback
    {
        std::string name;
        graph::ImageDesc desc;
        std::vector<std::byte> bytes; // rows tightly packed
    };
    std::vector<Readback> readbacks;

    /// A view of `bytes` (shared memory) as a picture: CV_8UC4 for RGBA8, CV_32FC4 for RGBA32F, ...
    cv::Mat mat(graph::ReadbackId id) const;
    const PassResult& pass(std::string_view name) const; // throws std::out_of_range when there is none
};

/// Optional measurements, off by default because of their cost.
struct Measuring
{
    bool align = false; // calibrated timestamps, if supported
    bool count = false; // shader invocations, if supported; may slow the passes down
    /// run() runs every pass a second time, whole, and throws std::logic_error when a readback differs: a
    /// pass declares a wrong region (graph::Reach).
    bool check_regions = false;
};

/// Identifies a submitted frame.
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

    /// Runs one frame and waits for it. Throws std::logic_error with all
    /// mistakes of a wrong declaration, and base::InputError when the
    /// device fails; the next frame continues from the last finished one.
    FrameResult run(const graph::Graph& graph);

    /// run() in two steps, with up to two frames in flight; a third submit() waits for the first frame.
    FrameToken submit(const graph::Graph& graph);
    /// Must be called before the second submit() after the one that returned `token`.
    FrameResult finish(FrameToken token);

    /// True when no pass of the frame would run: its images are up to date. A window asks before it submits
    /// and draws nothing when nothing changed. A frame with an every_frame() pass is never up to date. Throws
    /// std::logic_error as run() does.
    bool up_to_date(const graph::Graph& graph) const;

    /// Takes effect with the next frame.
    void measure(const Measuring& what) { measuring_ = what; }

    /// A presented image by name, in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
    /// for commands submitted to the same queue. Null when there is none.
    VkImage presented(std::string_view image_name) const;

    /// Marks all image contents as outdated: the next frame runs every pass that it needs.
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
