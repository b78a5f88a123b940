#include "stage/measurement.hpp"

#include <chrono>
#include <ctime>
#include <memory>

namespace stage {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

double process_cpu_now_ms()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

TimedFrame draw(gpu::Executor& executor, const MeasuredCase& drawn, double position, Clock::time_point zero,
                bool counted)
{
    if (drawn.every_pass)
        executor.forget();
    TimedFrame frame;
    const Clock::time_point start = Clock::now();
    const double cpu_start_ms = process_cpu_now_ms();
    graph::Graph graph;
    drawn.declare(graph, position);
    frame.start_ms = milliseconds(start - zero);
    frame.declare_ms = milliseconds(Clock::now() - start);
    frame.result = executor.run(graph);
    frame.process_cpu_ms = process_cpu_now_ms() - cpu_start_ms;
    frame.work = work_of(frame.result, counted);
    frame.result.readbacks.clear(); // saves the memory of hundreds of pictures
    frame.result.plan = {};
    drawn.afterwards();
    return frame;
}

} // namespace

std::vector<Measurement> measure(const gpu::Device& device, const graph::ShaderLibrary& library,
                                 const std::vector<MeasuredCase>& cases, const Rounds& rounds,
                                 const std::function<void(int)>& progress)
{
    std::vector<Measurement> measurements;
    std::vector<std::unique_ptr<gpu::Executor>> executors;
    for (const MeasuredCase& one : cases) {
        measurements.push_back({one.name, one.what, {}, {}});
        executors.push_back(std::make_unique<gpu::Executor>(device, library));
    }
    Clock::time_point zero = Clock::now();
    for (int round = 0; round < rounds.all(); ++round) {
        const bool counting = round >= rounds.warm_up && round < rounds.warm_up + rounds.counted;
        if (round == rounds.warm_up + rounds.counted)
            zero = Clock::now();
        for (std::size_t i = 0; i < cases.size(); ++i) {
            if (round % cases[i].every != 0)
                continue;
            executors[i]->measure({.align = true, .count = counting});
            TimedFrame frame = draw(*executors[i], cases[i], double(round) / rounds.all(), zero,
                                    counting && device.info().statistics);
            if (counting)
                measurements[i].counted.push_back(std::move(frame));
            else if (round >= rounds.warm_up)
                measurements[i].frames.push_back(std::move(frame));
        }
        progress(round + 1);
    }
    return measurements;
}

std::vector<double> pass_ms(const Measurement& measurement, std::string_view pass)
{
    std::vector<double> times;
    for (const TimedFrame& frame : measurement.frames)
        for (const gpu::PassResult& result : frame.result.passes)
            if (result.name == pass && result.state == graph::PassState::Run)
                times.push_back(result.gpu_ms.value_or(result.cpu_ms));
    return times;
}

std::vector<double> wall_ms(const Measurement& measurement)
{
    std::vector<double> times;
    for (const TimedFrame& frame : measurement.frames)
        times.push_back(frame.wall_ms());
    return times;
}

FrameWork mean_work(const Measurement& measurement)
{
    std::vector<FrameWork> works;
    for (const auto* frames : {&measurement.counted, &measurement.frames})
        for (const TimedFrame& frame : *frames)
            works.push_back(frame.work);
    return mean(works);
}

std::vector<double> process_cpu_ms(const Measurement& measurement)
{
    std::vector<double> times;
    for (const TimedFrame& frame : measurement.frames)
        times.push_back(frame.process_cpu_ms);
    return times;
}

} // namespace stage
