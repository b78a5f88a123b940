// The device that all GPU tests of a process share, with validation and synchronisation validation on, and
// the fixture that turns every validation message into a failure.
#pragma once
#include "engine/gpu/device.hpp"
#include "engine/gpu/executor.hpp"

#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

namespace graph {

std::span<const EmbeddedShader> test_shaders(); // of tests/shaders/, generated

} // namespace graph

namespace gpu_test {

/// Created on first use. Throws base::InputError when there is no Vulkan device or no validation layer, so
/// that no test is skipped.
gpu::Device& device();

/// The shaders of shaders/ and of tests/shaders/.
const graph::ShaderLibrary& shaders();

/// Names of the frame's passes in that state.
std::vector<std::string> passes_in(const gpu::FrameResult& frame, graph::PassState state);
inline std::vector<std::string> ran(const gpu::FrameResult& frame)
{
    return passes_in(frame, graph::PassState::Run);
}

class Test : public testing::Test
{
  protected:
    void SetUp() override { device().clear_validation_messages(); }
    void TearDown() override; // fails the test for every message of the validation layer
};

} // namespace gpu_test
