#include "engine/gpu/executor.hpp"

#include "engine/gpu/recorder.hpp"
#include "engine/gpu/vulkan_check.hpp"
#include "engine/graph/binding_check.hpp"
#include "engine/graph/formats.hpp"
#include "engine/graph/graph_check.hpp"
#include "engine/graph/pass_work.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

namespace gpu {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

/// Labels the commands recorded during its lifetime, for debuggers.
class Label
{
  public:
    Label(VkCommandBuffer commands, const std::string& name) : commands_(commands)
    {
        const VkDebugUtilsLabelEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                        .pLabelName = name.c_str()};
        if (vkCmdBeginDebugUtilsLabelEXT)
            vkCmdBeginDebugUtilsLabelEXT(commands_, &info);
    }
    ~Label()
    {
        if (vkCmdEndDebugUtilsLabelEXT)
            vkCmdEndDebugUtilsLabelEXT(commands_);
    }
    Label(const Label&) = delete;
    Label& operator=(const Label&) = delete;

  private:
    VkCommandBuffer commands_;
};

void compare_readbacks(const FrameResult& refreshed, const FrameResult& whole)
{
    for (std::size_t i = 0; i < whole.readbacks.size(); ++i) {
        const FrameResult::Readback &one = refreshed.readbacks[i], &other = whole.readbacks[i];
        const auto [differs, to] = std::ranges::mismatch(one.bytes, other.bytes);
        if (differs == one.bytes.end())
            continue;
        const std::size_t texel =
            std::size_t(differs - one.bytes.begin()) / graph::find_format(one.desc.format)->bytes;
        throw std::logic_error(
            fmt::format("{} is outdated at texel {}, {}: a pass that it depends on confines a "
                        "change to a region that is too small",
                        one.name, texel % one.desc.width, texel / one.desc.width));
    }
}

} // namespace

const char* name_of(Alignment alignment)
{
    switch (alignment) {
    case Alignment::Calibrated:
        return "calibrated";
    case Alignment::Bounds:
        return "bounds";
    default:
        return "none";
    }
}

cv::Mat FrameResult::mat(graph::ReadbackId id) const
{
    const Readback& readback = readbacks.at(id.index);
    // cv::Mat cannot point to constant data; callers must not write to it.
    void* data = const_cast<std::byte*>(readback.bytes.data());
    return {static_cast<int>(readback.desc.height), static_cast<int>(readback.desc.width),
            graph::find_format(readback.desc.format)->cv_type, data};
}

const PassResult& FrameResult::pass(std::string_view name) const
{
    for (const PassResult& result : passes)
        if (result.name == name)
            return result;
    throw std::out_of_range("no pass " + std::string(name));
}

/// A frame in flight.
struct Executor::Frame
{
    explicit Frame(const Device& device) : slot(device) {}

    std::vector<std::shared_ptr<const void>> kept; // Graph::keep; `slot` is destroyed first and waits
    FrameSlot slot;
    std::uint64_t number = 0;
    Clock::time_point start, recorded, submitted;
    FrameResult result;                // without the results that finish() adds
    std::vector<VkDeviceSize> offsets; // of the readbacks
    const Buffer* readback = nullptr;  // null without readbacks
};

Executor::Executor(const Device& device, const graph::ShaderLibrary& library)
    : device_(device), library_(library), pipelines_(device, library)
{
    for (auto& frame : frames_)
        frame = std::make_unique<Frame>(device_);
}

Executor::~Executor() = default; // frames_ is destroyed first and waits for frames in flight

FrameResult Executor::run(const graph::Graph& graph)
{
    FrameResult result = finish(submit(graph));
    if (measuring_.check_regions) {
        forget();
        compare_readbacks(result, finish(submit(graph)));
    }
    return result;
}

FrameToken Executor::submit(const graph::Graph& graph)
{
    const Clock::time_point start = Clock::now();
    std::vector<std::string> problems = graph::check_graph(graph);
    const std::vector<std::string> unfit = graph::check_bindings(graph, library_);
    problems.insert(problems.end(), unfit.begin(), unfit.end());
    graph::throw_if_any(problems);

    Frame& frame = *frames_[submitted_ % frames_.size()];
    frame.slot.wait();
    frame.kept = graph.kept; // releases the resources of the slot's last frame
    frame.result = {};
    frame.result.plan = graph::schedule_checked(graph, memory_);
    frame.start = start;
    match_images(graph, frame.result.plan);
    const std::vector<BoundImage> bound = bind_images(graph);
    const auto passes = static_cast<std::uint32_t>(graph.passes.size());
    const Clock::time_point scheduled = Clock::now();
    const VkCommandBuffer commands = frame.slot.begin(2 * passes + 2, measuring_.count ? passes : 0);
    record_passes(graph, frame, commands, bound);
    frame.recorded = Clock::now();
    frame.slot.submit(measuring_.align);
    frame.submitted = Clock::now();
    frame.result.host.schedule_ms = milliseconds(scheduled - start);
    frame.result.host.record_ms = milliseconds(frame.recorded - scheduled);
    frame.result.host.submit_ms = milliseconds(frame.submitted - frame.recorded);
    memory_ = frame.result.plan.memory; // after submission: an exception above leaves it unchanged
    frame.number = ++submitted_;
    return {frame.number};
}

FrameResult Executor::finish(FrameToken token)
{
    Frame& frame = *frames_[(token.number - 1) % frames_.size()];
    if (token.number == 0 || frame.number != token.number)
        throw std::logic_error("Executor::finish: the results of this frame no longer exist");
    frame.slot.wait();
    const Clock::time_point done = Clock::now();
    FrameResult result = std::move(frame.result);
    frame.kept.clear();
    frame.number = 0;
    if (frame.slot.has_timestamps())
        read_times(frame, done, result);
    if (frame.readback) {
        frame.readback->invalidate();
        for (std::size_t i = 0; i < result.readbacks.size(); ++i) {
            std::vector<std::byte>& bytes = result.readbacks[i].bytes;
            std::memcpy(bytes.data(), frame.readback->mapped().data() + frame.offsets[i], bytes.size());
        }
    }
    const Clock::time_point end = Clock::now();
    result.host.wait_ms = milliseconds(done - frame.submitted);
    result.host.readback_ms = milliseconds(end - done);
    result.frame_ms = milliseconds(end - frame.start);
    return result;
}

bool Executor::up_to_date(const graph::Graph& graph) const
{
    const graph::Plan plan = graph::schedule(graph, memory_);
    return std::ranges::none_of(
        plan.passes, [](const graph::PassPlan& pass) { return pass.state == graph::PassState::Run; });
}

/// Converts the timestamps of a frame completed at `done`: two per pass that ran, two for the readbacks.
void Executor::read_times(const Frame& frame, Clock::time_point done, FrameResult& result)
{
    const FrameSlot& slot = frame.slot;
    const auto since_start = [&](Clock::time_point time) { return milliseconds(time - frame.start); };
    const std::size_t passes = static_cast<std::size_t>(
        std::ranges::count(result.passes, graph::PassState::Run, &PassResult::state));
    const std::size_t last =
        2 * (passes + (frame.readback ? 1 : 0)) - 1; // a pass ran or images were read back
    const double all_ms = slot.milliseconds(0, last);
    double origin = 0;
    if (const auto first = slot.first_timestamp()) {
        result.alignment = Alignment::Calibrated;
        result.alignment_error_ms = first->error_ms;
        origin = since_start(first->time);
    } else {
        result.alignment = Alignment::Bounds;
        result.alignment_error_ms =
            std::max(0.0, (since_start(done) - since_start(frame.recorded) - all_ms) / 2);
        origin = since_start(frame.recorded) + result.alignment_error_ms;
    }
    std::size_t ran = 0;
    for (PassResult& pass : result.passes)
        if (pass.state == graph::PassState::Run) {
            pass.gpu_begin_ms = origin + slot.milliseconds(0, 2 * ran);
            pass.gpu_ms = slot.milliseconds(2 * ran, 2 * ran + 1);
            pass.invocations = slot.invocations(ran);
            ++ran;
        }
    result.gpu_ms = ran > 0 ? slot.milliseconds(0, 2 * ran - 1) : 0.0;
    if (frame.readback)
        result.copy = GpuSpan{origin + slot.milliseconds(0, 2 * ran), slot.milliseconds(2 * ran, last)};
}

VkImage Executor::presented(std::string_view image_name) const
{
    const auto image = images_.find(image_name);
    return image == images_.end() ? VK_NULL_HANDLE : image->second.handle();
}

void Executor::forget()
{
    for (auto& [name, state] : memory_.images)
        state.content_version = 0; // access states stay, for the next barriers
    memory_.passes.clear();
}

/// Creates the images this frame uses and destroys those that are no longer declared or declared differently.
void Executor::match_images(const graph::Graph& graph, const graph::Plan& plan)
{
    const auto fits = [&](const std::string& name, const Image& image) {
        const auto state = plan.memory.images.find(name);
        return state != plan.memory.images.end() && state->second.desc == image.desc() &&
               state->second.usage == image.usage();
    };
    for (auto image = images_.begin(); image != images_.end();) {
        if (fits(image->first, image->second)) {
            ++image;
            continue;
        }
        check(vkQueueWaitIdle(device_.queue()),
              "finish the frames that use an image"); // rare: after a change of size
        memory_.images.erase(image->first);
        image = images_.erase(image);
    }
    for (std::size_t i = 0; i < graph.images.size(); ++i) {
        const std::string& name = graph.images[i].name;
        if (graph.images[i].external || plan.images[i].first == ~0u || images_.contains(name))
            continue;
        const graph::ImageState& state = plan.memory.images.at(name);
        images_.emplace(name, Image(device_, state.desc, 1, state.usage, name));
    }
}

std::vector<BoundImage> Executor::bind_images(const graph::Graph& graph) const
{
    std::vector<BoundImage> bound;
    for (const graph::Graph::Image& image : graph.images) {
        if (image.external)
            bound.push_back({VK_NULL_HANDLE, image.external->view});
        else if (const auto found = images_.find(image.name); found != images_.end())
            bound.push_back({found->second.handle(), found->second.view()});
        else
            bound.push_back({});
    }
    return bound;
}

void Executor::record_passes(const graph::Graph& graph, Frame& frame, VkCommandBuffer commands,
                             std::span<const BoundImage> bound)
{
    Recorder recorder(device_, graph, pipelines_, frame.slot, commands, bound);
    for (const graph::PassPlan& planned : frame.result.plan.passes) {
        PassResult& result = frame.result.passes.emplace_back();
        result.name = planned.name;
        result.state = planned.state;
        result.reason = planned.reason;
        if (planned.state != graph::PassState::Run)
            continue;
        const Clock::time_point start = Clock::now();
        const Label label(commands, planned.name);
        frame.slot.timestamp();
        // Every pass writes an image, so there is always a barrier between this timestamp and a dispatch.
        // llvmpipe needs it: without a barrier it reports almost no time for the dispatch.
        assert(!planned.barriers.empty());
        recorder.barriers(planned.barriers);
        frame.slot.begin_count();
        const graph::Pass& pass = graph.passes[planned.pass];
        if (const auto* compute = std::get_if<graph::ComputePass>(&pass))
            recorder.record(*compute, planned);
        else
            recorder.record(std::get<graph::RasterPass>(pass), planned);
        frame.slot.end_count();
        frame.slot.timestamp();
        result.work = graph::work_of(graph, planned);
        result.cpu_begin_ms = milliseconds(start - frame.start);
        result.cpu_ms = milliseconds(Clock::now() - start);
    }
    record_readbacks(graph, frame, recorder);
}

void Executor::record_readbacks(const graph::Graph& graph, Frame& frame, Recorder& recorder)
{
    if (!graph.readbacks.empty())
        frame.slot.timestamp();
    recorder.barriers(frame.result.plan.final_barriers);
    frame.offsets.clear();
    frame.readback = nullptr;
    VkDeviceSize size = 0;
    for (const graph::Graph::Readback& readback : graph.readbacks) {
        const graph::ImageDesc& desc = graph.images[readback.image.index].desc;
        const std::size_t bytes =
            std::size_t{desc.width} * desc.height * graph::find_format(desc.format)->bytes;
        frame.offsets.push_back(size);
        frame.result.readbacks.push_back({readback.name, desc, std::vector<std::byte>(bytes)});
        size += (bytes + 15) / 16 * 16; // copies start on a multiple of the texel size
    }
    if (graph.readbacks.empty())
        return;
    frame.readback = &frame.slot.readback(size);
    recorder.copy_out(graph.readbacks, *frame.readback, frame.offsets);
    frame.slot.timestamp();
}

} // namespace gpu
