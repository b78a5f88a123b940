// The key of a pass: hashes of all that determines what it writes. A pass whose key is that of its last run
// is skipped.
#pragma once
#include "engine/graph/graph_check.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace graph {

/// One input that determines a pass's output ("uniform day", "input wound_color") and a hash of its value.
struct KeyPart
{
    std::string what;
    std::uint64_t hash = 0;
    /// What a change touches (Reach); none: everything.
    std::optional<Region> region;
    std::optional<Region> source;
    bool in_place = false;
    bool operator==(const KeyPart& other) const { return what == other.what && hash == other.hash; }
};

/// `accesses`: of the pass. `content_versions`: by image, of what it samples.
std::vector<KeyPart> pass_key(const Graph& graph, const Pass& pass, std::span<const ImageAccess> accesses,
                              std::span<const std::uint64_t> content_versions);

} // namespace graph
