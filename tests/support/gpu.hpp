// The device that all GPU tests of a process share, with validation and synchronisation validation on, and
// the fixture that turns every validation message into a failure.
#pragma once
#include "engine/gpu/device.hpp"
#include "engine/gpu/executor.hpp"

#include <gtest/gtest.h>
#include <span>

namespace graph {

std::span<const EmbeddedShader> test_shaders(); // of tests/shaders/, generated

} // namespace graph

namespace gpu_test {

/// Created on first use. Throws base::InputError when there is no Vulkan device or no validation layer, so
/// that no test is skipped.
gpu::Device& device();

/// The shaders of shaders/ and of tests/shaders/.
const graph::ShaderLibrary& shaders();

class Test : public testing::Test
{
  protected:
    void SetUp() override { device().clear_validation_messages(); }
    void TearDown() override; // fails the test for every message of the validation layer
};

} // namespace gpu_test
