// Executes declared frames on a device: schedules them, keeps the images, records only what must run, labels
// and times every pass, reads results back. One Executor per device; it must be gone before the device.
#pragma once
#include "engine/device.hpp"
#include "engine/frame_slot.hpp"
#include "engine/graph.hpp"
#include "engine/pipelines.hpp"
#include "engine/schedule.hpp"
#include "engine/shader_library.hpp"

#include <array>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace engine {

class Recorder;
struct BoundImage;

struct PassResult
{
    std::string name;
    PassState state = PassState::Run;
    std::string reason;
    std::optional<double> gpu_ms; // only of passes that ran, on a device with timestamps
    double cpu_ms = 0;            // recording; includes compiling the pipelines on the first run
};

struct FrameResult
{
    std::vector<PassResult> passes; // in order of execution
    double frame_ms = 0;            // wall clock, from the declaration's check to the data on the host
    std::optional<double> gpu_ms;   // from the first pass to the last, on a device with timestamps
    Plan plan;

    struct Readback
    {
        std::string name;
        ImageDesc desc;
        std::vector<std::byte> bytes; // rows tightly packed
    };
    std::vector<Readback> readbacks;

    /// The picture as it lies in `bytes`: CV_8UC4 for RGBA8, CV_32FC4 for RGBA32F, ... Shares their memory.
    cv::Mat mat(ReadbackId id) const;
    const PassResult& pass(std::string_view name) const; // throws std::out_of_range when there is none
};

/// Names a submitted frame.
struct FrameToken
{
    std::uint64_t number = 0;
};

class Executor
{
  public:
    Executor(const Device& device, const ShaderLibrary& library);
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Runs one frame and waits for it. Throws std::logic_error when the graph
    /// is declared wrongly, naming every mistake, and cicatrix::InputError when
    /// the device fails; the next frame starts from what was finished before.
    FrameResult run(const Graph& graph);

    /// The same in two steps, with up to two frames in flight; a third submit waits for the first.
    FrameToken submit(const Graph& graph);
    /// Must be asked for before the second submit after this one.
    FrameResult finish(FrameToken token);

    /// Whether the frame would show what is there already: no pass of it would run. Asked before submitting,
    /// so that a window in which nothing changes draws nothing. A pass that asks to run every frame is never
    /// up to date. Throws std::logic_error as run() does.
    bool up_to_date(const Graph& graph) const;

    /// The image a graph presented last, in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
    /// for commands submitted to the same queue.
    VkImage presented(std::string_view image_name) const;

    /// Forgets what the images hold: the next frame runs everything it needs.
    void forget();

  private:
    struct Frame;
    void match_images(const Graph& graph, const Plan& plan);
    std::vector<BoundImage> bind_images(const Graph& graph) const;
    void record_passes(const Graph& graph, Frame& frame, VkCommandBuffer commands,
                       std::span<const BoundImage> bound);
    void record_readbacks(const Graph& graph, Frame& frame, Recorder& recorder);

    const Device& device;
    const ShaderLibrary& library;
    Pipelines pipelines;
    std::map<std::string, Image, std::less<>> images; // by name, as in memory.images
    Memory memory;
    std::array<std::unique_ptr<Frame>, 2> frames;
    std::uint64_t submitted = 0;
};

} // namespace engine
