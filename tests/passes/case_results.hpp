// Runs a test shader once per case and reads back one result of each as 32-bit floats.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/support/gpu.hpp"

namespace gpu_test {

/// `shader` stores the result of case i in `results` at (i % width, i / width). `bind(pass)`: the cases' buffers.
template <typename Bind>
std::vector<cv::Vec4f> case_results(std::string_view shader, std::size_t cases, const Bind& bind)
{
    constexpr std::uint32_t width = 1024;
    const auto height = static_cast<std::uint32_t>((cases + width - 1) / width);
    graph::Graph graph;
    const graph::ImageId results = graph.image("results", {width, height, VK_FORMAT_R32G32B32A32_SFLOAT});
    graph::ComputePass& pass = graph.compute("cases", shader);
    bind(pass);
    pass.store("results", results);
    pass.dispatch(width, height);
    const graph::ReadbackId back = graph.readback("results", results);
    gpu::Executor executor(device(), shaders());
    const gpu::FrameResult frame = executor.run(graph);
    const cv::Mat4f values = frame.mat(back);
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(cases)};
}

} // namespace gpu_test
