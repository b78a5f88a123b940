// The one way in which commands measure what drawing costs: several cases in turn, frame by frame, so that a
// machine that grows slower meanwhile slows all of them. Each case has an executor of its own and so a past
// of its own: its frames follow each other as if nothing else were drawn. docs/report.md says how times are
// taken.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/gpu/executor.hpp"

namespace stage {

struct MeasuredCase
{
    std::string name, what; // what: one line for the reader
    /// Declares a frame with its read-backs; timed. `position` grows evenly from 0 to below 1 over the
    /// frames, those of the warm-up included.
    std::function<void(graph::Graph&, double position)> declare;
    std::function<void()> afterwards = [] {}; // not timed
    bool every_pass = false;                  // runs all that is needed, also what has not changed
};

struct TimedFrame
{
    double start_ms = 0;     // since the first frame of the measurement
    double declare_ms = 0;   // the caller's work; result's times count from its end
    gpu::FrameResult result; // without plan and read-backs
    double wall_ms() const { return declare_ms + result.frame_ms; }
};

struct Measurement
{
    std::string name, what;
    std::vector<TimedFrame> frames;
    std::vector<TimedFrame> counted; // frames of their own, for counting may slow a device down
};

struct Rounds
{
    int warm_up = 3, counted = 2, timed = 60;
    int all() const { return warm_up + counted + timed; }
};

/// `progress` is told after every round how many are done. One Measurement per case, in their order.
std::vector<Measurement> measure(
    const gpu::Device& device, const graph::ShaderLibrary& library, const std::vector<MeasuredCase>& cases,
    const Rounds& rounds, const std::function<void(int)>& progress = [](int) {});

/// The pass's GPU times in the frames in which it ran; its CPU times on a device without timestamps.
std::vector<double> pass_ms(const Measurement& measurement, std::string_view pass);
std::vector<double> wall_ms(const Measurement& measurement);

} // namespace stage
