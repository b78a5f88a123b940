// The counted work of a frame: numbers that follow from what is declared and do not depend on the machine,
// and shader invocations as the device counts them. No clock blurs them.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "engine/gpu/executor.hpp"

namespace stage {

struct FrameWork
{
    double passes = 0;        // that ran
    double texels = 0;        // refreshed by them (graph::PassWork)
    double bytes_written = 0; // by them, and by copying read-backs to the host
    double maps_sampled = 0;
    /// All stages of all passes; none if they were not counted.
    struct Invocations
    {
        double vertex = 0, fragment = 0, compute = 0;
    };
    std::optional<Invocations> invocations;
};

/// `counted`: invocations were asked for and the device can count them.
FrameWork work_of(const gpu::FrameResult& frame, bool counted);

/// Means over the frames; invocations over those in which they were counted.
FrameWork mean(std::span<const FrameWork> frames);

/// "passes", "texels_refreshed", "bytes_written", "maps_sampled", and "invocations" with "vertex", "fragment"
/// and "compute", or null.
nlohmann::json to_json(const FrameWork& work);

} // namespace stage
