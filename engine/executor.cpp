#include "engine/executor.hpp"

#include "engine/binding_check.hpp"
#include "engine/formats.hpp"
#include "engine/graph_check.hpp"
#include "engine/recorder.hpp"
#include "engine/vulkan_check.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace engine {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A labelled stretch of commands, for debuggers.
class Label
{
  public:
    Label(VkCommandBuffer to, const std::string& name) : commands(to)
    {
        const VkDebugUtilsLabelEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                        .pLabelName = name.c_str()};
        if (vkCmdBeginDebugUtilsLabelEXT)
            vkCmdBeginDebugUtilsLabelEXT(commands, &info);
    }
    ~Label()
    {
        if (vkCmdEndDebugUtilsLabelEXT)
            vkCmdEndDebugUtilsLabelEXT(commands);
    }
    Label(const Label&) = delete;
    Label& operator=(const Label&) = delete;

  private:
    VkCommandBuffer commands;
};

} // namespace

cv::Mat FrameResult::mat(ReadbackId id) const
{
    const Readback& readback = readbacks.at(id.index);
    // cv::Mat has no constant form; callers get the picture to read.
    void* data = const_cast<std::byte*>(readback.bytes.data());
    return {static_cast<int>(readback.desc.height), static_cast<int>(readback.desc.width),
            find_format(readback.desc.format)->cv_type, data};
}

const PassResult& FrameResult::pass(std::string_view name) const
{
    for (const PassResult& result : passes)
        if (result.name == name)
            return result;
    throw std::out_of_range("no pass " + std::string(name));
}

/// One of the frames in flight.
struct Executor::Frame
{
    explicit Frame(const Device& device) : slot(device) {}

    std::vector<std::shared_ptr<const void>> kept; // Graph::keep; the slot, destroyed first, waits
    FrameSlot slot;
    std::uint64_t number = 0;
    Clock::time_point start;
    FrameResult result;                // without what only the finished frame knows
    std::vector<VkDeviceSize> offsets; // of the read-backs
    const Buffer* readback = nullptr;  // null when there are none
};

Executor::Executor(const Device& used, const ShaderLibrary& shaders)
    : device(used), library(shaders), pipelines(used, shaders)
{
    for (auto& frame : frames)
        frame = std::make_unique<Frame>(device);
}

Executor::~Executor() = default; // the frames, destroyed first, wait for what is in flight

FrameResult Executor::run(const Graph& graph)
{
    return finish(submit(graph));
}

FrameToken Executor::submit(const Graph& graph)
{
    const Clock::time_point start = Clock::now();
    std::vector<std::string> problems = check_graph(graph);
    const std::vector<std::string> unfit = check_bindings(graph, library);
    problems.insert(problems.end(), unfit.begin(), unfit.end());
    throw_if_any(problems);

    Frame& frame = *frames[submitted % frames.size()];
    frame.slot.wait();
    frame.kept = graph.kept; // those of the frame that used the slot last can go
    frame.result = {};
    frame.result.plan = schedule(graph, memory);
    frame.start = start;
    match_images(graph, frame.result.plan);
    const std::vector<BoundImage> bound = bind_images(graph);
    const auto timestamps = static_cast<std::uint32_t>(2 * graph.passes.size());
    const VkCommandBuffer commands = frame.slot.begin(timestamps);
    record_passes(graph, frame, commands, bound);
    frame.slot.submit();
    memory = frame.result.plan.memory; // only now: whatever threw before has changed no image
    frame.number = ++submitted;
    return {frame.number};
}

FrameResult Executor::finish(FrameToken token)
{
    Frame& frame = *frames[(token.number - 1) % frames.size()];
    if (token.number == 0 || frame.number != token.number)
        throw std::logic_error("Executor::finish: this frame's results are gone");
    frame.slot.wait();
    FrameResult result = std::move(frame.result);
    frame.kept.clear();
    frame.number = 0;
    if (frame.slot.has_timestamps()) {
        std::size_t tick = 0;
        for (PassResult& pass : result.passes)
            if (pass.state == PassState::Run) {
                pass.gpu_ms = frame.slot.milliseconds(tick, tick + 1);
                tick += 2;
            }
        result.gpu_ms = tick > 0 ? frame.slot.milliseconds(0, tick - 1) : 0.0;
    }
    if (frame.readback) {
        frame.readback->invalidate();
        for (std::size_t i = 0; i < result.readbacks.size(); ++i) {
            std::vector<std::byte>& bytes = result.readbacks[i].bytes;
            std::memcpy(bytes.data(), frame.readback->mapped().data() + frame.offsets[i], bytes.size());
        }
    }
    result.frame_ms = milliseconds_since(frame.start);
    return result;
}

bool Executor::up_to_date(const Graph& graph) const
{
    const Plan plan = schedule(graph, memory);
    return std::ranges::none_of(plan.passes,
                                [](const PassPlan& pass) { return pass.state == PassState::Run; });
}

VkImage Executor::presented(std::string_view image_name) const
{
    const auto image = images.find(image_name);
    return image == images.end() ? VK_NULL_HANDLE : image->second.handle();
}

void Executor::forget()
{
    for (auto& [name, state] : memory.images)
        state.stamp = 0; // what the GPU may still be doing to it stays known
    memory.passes.clear();
}

/// Makes the images this frame touches, and lets go of those that are declared differently or no longer.
void Executor::match_images(const Graph& graph, const Plan& plan)
{
    const auto fits = [&](const std::string& name, const Image& image) {
        const auto state = plan.memory.images.find(name);
        return state != plan.memory.images.end() && state->second.desc == image.desc() &&
               state->second.usage == image.usage();
    };
    for (auto image = images.begin(); image != images.end();) {
        if (fits(image->first, image->second)) {
            ++image;
            continue;
        }
        check(vkQueueWaitIdle(device.queue()),
              "finish the frames that use an image"); // rare: a change of size
        memory.images.erase(image->first);
        image = images.erase(image);
    }
    for (std::size_t i = 0; i < graph.images.size(); ++i) {
        const std::string& name = graph.images[i].name;
        if (graph.images[i].external || plan.images[i].first == ~0u || images.contains(name))
            continue;
        const ImageState& state = plan.memory.images.at(name);
        images.emplace(name, Image(device, state.desc, 1, state.usage, name));
    }
}

std::vector<BoundImage> Executor::bind_images(const Graph& graph) const
{
    std::vector<BoundImage> bound;
    for (const Graph::Image& image : graph.images) {
        if (image.external)
            bound.push_back({VK_NULL_HANDLE, image.external->view});
        else if (const auto own = images.find(image.name); own != images.end())
            bound.push_back({own->second.handle(), own->second.view()});
        else
            bound.push_back({});
    }
    return bound;
}

void Executor::record_passes(const Graph& graph, Frame& frame, VkCommandBuffer commands,
                             std::span<const BoundImage> bound)
{
    Recorder recorder(device, graph, pipelines, frame.slot, commands, bound);
    for (const PassPlan& planned : frame.result.plan.passes) {
        PassResult& result = frame.result.passes.emplace_back();
        result.name = planned.name;
        result.state = planned.state;
        result.reason = planned.reason;
        if (planned.state != PassState::Run)
            continue;
        const Clock::time_point start = Clock::now();
        const Label label(commands, planned.name);
        frame.slot.timestamp();
        // Every pass writes an image, so there always is a barrier between this timestamp and a dispatch.
        // llvmpipe needs it: without one it reports next to no time for the dispatch.
        assert(!planned.barriers.empty());
        recorder.barriers(planned.barriers);
        const Pass& pass = graph.passes[planned.pass];
        if (const auto* compute = std::get_if<ComputePass>(&pass))
            recorder.record(*compute);
        else
            recorder.record(std::get<RasterPass>(pass), planned);
        frame.slot.timestamp();
        result.cpu_ms = milliseconds_since(start);
    }
    record_readbacks(graph, frame, recorder);
}

void Executor::record_readbacks(const Graph& graph, Frame& frame, Recorder& recorder)
{
    recorder.barriers(frame.result.plan.final_barriers);
    frame.offsets.clear();
    frame.readback = nullptr;
    VkDeviceSize size = 0;
    for (const Graph::Readback& readback : graph.readbacks) {
        const ImageDesc& desc = graph.images[readback.image.index].desc;
        const std::size_t bytes = std::size_t{desc.width} * desc.height * find_format(desc.format)->bytes;
        frame.offsets.push_back(size);
        frame.result.readbacks.push_back({readback.name, desc, std::vector<std::byte>(bytes)});
        size += (bytes + 15) / 16 * 16; // copies start on a multiple of the texel size
    }
    if (graph.readbacks.empty())
        return;
    frame.readback = &frame.slot.readback(size);
    recorder.copy_out(graph.readbacks, *frame.readback, frame.offsets);
}

} // namespace engine
