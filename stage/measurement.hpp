// Measures the cost of drawing, for all commands. The cases alternate frame by frame, so that a machine which
// slows down affects all of them equally. Each case has a separate executor, so that its frames follow each
// other as if nothing else were drawn. docs/report.md explains how times are measured.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/gpu/executor.hpp"
#include "stage/work.hpp"

namespace stage {

struct MeasuredCase
{
    std::string name, what; // what: one line of description
    /// Declares a frame with its read-backs; timed. `position` increases evenly from 0 to below 1 over all
    /// frames, including the warm-up.
    std::function<void(graph::Graph&, double position)> declare;
    std::function<void()> afterwards = [] {}; // not timed
    bool every_pass = false;                  // also run passes whose inputs are unchanged
    int every = 1; // drawn in every such round only, from the first on: for what takes seconds
};

struct TimedFrame
{
    double start_ms = 0;       // since the first frame of the measurement
    double declare_ms = 0;     // duration of declare(); the times in `result` start at its end
    double process_cpu_ms = 0; // CPU time of all threads of the process, from declare() to the frame's end
    gpu::FrameResult result;   // without plan and read-backs
    FrameWork work;
    double wall_ms() const { return declare_ms + result.frame_ms; }
};

struct Measurement
{
    std::string name, what;
    std::vector<TimedFrame> frames;
    std::vector<TimedFrame> counted; // separate frames with counters, which may slow the device down
};

struct Rounds
{
    int warm_up = 3, counted = 2, timed = 60;
    int all() const { return warm_up + counted + timed; }
};

/// Returns one Measurement per case, in the same order. Calls `progress` after every round with the number of
/// finished rounds.
std::vector<Measurement> measure(
    const gpu::Device& device, const graph::ShaderLibrary& library, const std::vector<MeasuredCase>& cases,
    const Rounds& rounds, const std::function<void(int)>& progress = [](int) {});

/// The pass's times in ms in the frames in which it ran: GPU times, or CPU times without GPU timestamps.
std::vector<double> pass_ms(const Measurement& measurement, std::string_view pass);
std::vector<double> wall_ms(const Measurement& measurement);
std::vector<double> process_cpu_ms(const Measurement& measurement);
/// Means over all frames.
FrameWork mean_work(const Measurement& measurement);

} // namespace stage
