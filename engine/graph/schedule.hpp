// From a declared frame to what has to be done for it: order, what runs, what is skipped or culled and why,
// barriers, lifetimes. A pure function: no Vulkan call is made, so its tests need no device.
//
// Contents are told apart by content_versions. The content_version of an image is a hash of its writer's key
// and of the content_versions of everything the writer samples; a pass whose needed outputs already hold
// their content_versions is skipped.
#pragma once
#include "engine/graph/access.hpp"
#include "engine/graph/graph.hpp"

#include <map>
#include <string>
#include <vector>

namespace graph {

/// One thing that decides what a pass computes ("uniform day", "input wound_color") and a hash of its value.
struct KeyPart
{
    std::string what;
    std::uint64_t hash = 0;
    bool operator==(const KeyPart&) const = default;
};

struct ImageState
{
    ImageDesc desc;
    VkImageUsageFlags usage = 0;
    AccessState access;
    std::uint64_t content_version = 0; // 0: contents undefined
};

/// What must be remembered from one frame for the next. Value-initialised: nothing exists yet.
struct Memory
{
    std::map<std::string, ImageState> images;
    std::map<std::string, std::vector<KeyPart>> passes; // keys of the last runs
    std::uint64_t frames = 0;
};

enum class PassState : std::uint8_t
{
    Run,
    Skipped, // its outputs already hold what it would write
    Culled,  // nobody needs its outputs
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
    std::vector<ImageBarrier> barriers;                            // before the pass
    std::vector<VkAttachmentStoreOp> color_stores, resolve_stores; // by colour target
    VkAttachmentStoreOp depth_store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
};

struct ImagePlan
{
    VkImageUsageFlags usage = 0; // all that the graph declares, culled passes included
    std::uint32_t first = ~0u,
                  last = ~0u; // in Plan::passes, culled ones left out; ~0: not needed in this frame
    bool needed = false;      // its contents are read by a pass that is not culled, read back or presented
};

struct Plan
{
    std::vector<PassPlan> passes;             // in order of execution
    std::vector<ImagePlan> images;            // by ImageId
    std::vector<ImageBarrier> final_barriers; // before the read-backs
    Memory memory;                            // to be given to the next frame
};

/// Throws std::logic_error when the declaration is wrong; see graph_check.hpp.
Plan schedule(const Graph& graph, const Memory& memory);

const char* name_of(PassState state);

} // namespace graph
