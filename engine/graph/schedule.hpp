// Schedules a declared frame: order of passes, which run, which are skipped or culled and why, barriers,
// lifetimes. A pure function without Vulkan calls, so its tests need no device.
//
// The content_version of an image is a hash of its writer's key and of the content_versions of all images
// the writer samples. A pass is skipped when its needed outputs already have their content_versions.
#pragma once
#include "engine/graph/access.hpp"
#include "engine/graph/graph.hpp"
#include "engine/graph/pass_key.hpp"

#include <map>
#include <string>
#include <vector>

namespace graph {

struct ImageState
{
    ImageDesc desc;
    VkImageUsageFlags usage = 0;
    AccessState access;
    std::uint64_t content_version = 0; // 0: contents undefined
    std::uint64_t refreshed_from = 0;  // the version that differs from this one in `refreshed` only; 0: none
    Region refreshed;
};

/// State carried from one frame to the next. Value-initialised: no image exists yet.
struct Memory
{
    std::map<std::string, ImageState> images;
    std::map<std::string, std::vector<KeyPart>> passes; // key of each pass's last run
    std::uint64_t frames = 0;
};

enum class PassState : std::uint8_t
{
    Run,
    Skipped, // its outputs are up to date
    Culled,  // nothing needs its outputs
};

struct ImageBarrier
{
    ImageId image;
    Barrier barrier;
};

struct PassPlan
{
    std::uint32_t pass = 0; // index in Graph::passes
    std::string name;
    PassState state = PassState::Run;
    std::string reason; // "unchanged", "unused: nothing samples lut", "changed: uniform day", "first run",
                        // "every frame"
    std::optional<Region> region;                                  // of its images that is written; none: all
    std::vector<ImageBarrier> barriers;                            // before the pass
    std::vector<VkAttachmentStoreOp> color_stores, resolve_stores; // by colour target
    VkAttachmentStoreOp depth_store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
};

struct ImagePlan
{
    VkImageUsageFlags usage = 0; // of all passes, including culled ones
    std::uint32_t first = ~0u,
                  last = ~0u; // in Plan::passes, without culled ones; ~0: not used in this frame
    bool needed = false;      // read by a pass that is not culled, read back or presented
};

struct Plan
{
    std::vector<PassPlan> passes;             // in order of execution
    std::vector<ImagePlan> images;            // by ImageId
    std::vector<ImageBarrier> final_barriers; // before the readbacks
    Memory memory;                            // for the next frame
};

/// Throws std::logic_error when the declaration is wrong; see graph_check.hpp.
Plan schedule(const Graph& graph, const Memory& memory);
/// The same of a graph in which check_graph() has found no mistake.
Plan schedule_checked(const Graph& graph, const Memory& memory);

const char* name_of(PassState state);

} // namespace graph
