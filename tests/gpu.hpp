// The device that all GPU tests of a process share, with validation and synchronisation validation on, and the fixture
// that turns any of its messages into a failure.
#pragma once
#include "engine/device.hpp"
#include "engine/executor.hpp"

#include <gtest/gtest.h>
#include <span>

namespace engine {

std::span<const EmbeddedShader> test_shaders(); // of tests/shaders/, generated

} // namespace engine

namespace gpu {

/// Made on first use. Throws cicatrix::InputError without a Vulkan device or the validation layer: no test is skipped.
engine::Device& device();

/// The shaders of shaders/ and of tests/shaders/.
const engine::ShaderLibrary& shaders();

class Test : public testing::Test
{
  protected:
    void SetUp() override { device().clear_validation_messages(); }
    void TearDown() override; // fails the test for every message of the validation layer
};

} // namespace gpu
