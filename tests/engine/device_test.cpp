// Choice of the device, the message when none is suitable, and that validation messages fail a test.
#include "base/input_error.hpp"
#include "engine/gpu/device.hpp"
#include "engine/gpu/memory.hpp"
#include "tests/support/gpu.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

namespace {

using base::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

gpu::PhysicalDevice device_of(const char* name, VkPhysicalDeviceType type,
                              std::vector<std::string> missing = {})
{
    gpu::PhysicalDevice device;
    device.info.name = name;
    device.info.missing = std::move(missing);
    device.properties.deviceType = type;
    return device;
}

const std::vector<gpu::PhysicalDevice> three{
    device_of("llvmpipe (LLVM 15)", VK_PHYSICAL_DEVICE_TYPE_CPU),
    device_of("Intel Iris", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
    device_of("GeForce", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, {"dynamicRendering", "4 samples per pixel"}),
};

std::string refusal(const std::vector<gpu::PhysicalDevice>& devices, const char* wanted)
{
    try {
        return "took " + gpu::choose_device(devices, wanted).info.name;
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(DeviceChoice, TakesTheBestFitDevice)
{
    EXPECT_EQ(&gpu::choose_device(three, ""), &three[1]);
}

TEST(DeviceChoice, TakesTheOneAskedForByIndexOrPartOfItsName)
{
    EXPECT_EQ(&gpu::choose_device(three, "0"), &three[0]);
    EXPECT_EQ(&gpu::choose_device(three, "LLVM"), &three[0]);
    EXPECT_EQ(&gpu::choose_device(three, "iris"), &three[1]);
}

TEST(DeviceChoice, SaysWhichDevicesThereAreWhenTheOneAskedForIsMissing)
{
    EXPECT_THAT(refusal(three, "Radeon"),
                AllOf(HasSubstr("device 'Radeon': there is no such device"),
                      HasSubstr("0 = llvmpipe (LLVM 15), 1 = Intel Iris, 2 = GeForce")));
    EXPECT_THAT(refusal(three, "3"), HasSubstr("no such device"));
}

TEST(DeviceChoice, SaysWhatTheOneAskedForLacks)
{
    EXPECT_THAT(refusal(three, "geforce"),
                HasSubstr("device 'GeForce': it lacks dynamicRendering, 4 samples per pixel"));
}

TEST(DeviceChoice, SaysWhyEachWasRefused)
{
    EXPECT_THAT(refusal({three[2], device_of("Old", VK_PHYSICAL_DEVICE_TYPE_CPU, {"Vulkan 1.3"})}, ""),
                HasSubstr("GeForce lacks dynamicRendering, 4 samples per pixel; Old lacks Vulkan 1.3"));
    EXPECT_THAT(refusal({}, ""), HasSubstr("no device found"));
}

using DeviceTest = gpu_test::Test;

TEST_F(DeviceTest, DescribesEveryDevice)
{
    EXPECT_THAT(gpu::describe_devices(), AllOf(HasSubstr(gpu_test::device().info().name), HasSubstr("driver"),
                                               HasSubstr("timestamps"), HasSubstr("samples")));
    EXPECT_THAT(gpu_test::device().info().missing, IsEmpty());
    EXPECT_THAT(gpu_test::device().info().driver, Not(IsEmpty()));
}

TEST_F(DeviceTest, MissingRequirementsOfAWindowAreListed)
{
    const auto missing = [](const gpu::DeviceWishes& wishes) {
        return gpu::enumerate_devices(gpu_test::device().instance(), wishes).front().info.missing;
    };
    EXPECT_THAT(missing({{VK_KHR_SWAPCHAIN_EXTENSION_NAME}, {}}), IsEmpty());
    EXPECT_THAT(missing({{"VK_NO_such_thing"}, {}}), testing::ElementsAre("VK_NO_such_thing"));
    EXPECT_THAT(missing({{}, [](VkInstance, VkPhysicalDevice, std::uint32_t) { return false; }}),
                testing::ElementsAre("drawing to this display's windows"));
}

TEST_F(DeviceTest, AnUnknownDeviceIsAnInputError)
{
    EXPECT_THROW(gpu::Device({.device = "no such device"}), InputError);
}

TEST_F(DeviceTest, AnImageBeyondTheDevicesLimitIsAnInputError)
{
    EXPECT_THROW(gpu::Image(gpu_test::device(), {1u << 20, 16, VK_FORMAT_R8G8B8A8_UNORM}, 1,
                            VK_IMAGE_USAGE_SAMPLED_BIT, "huge"),
                 InputError);
}

TEST_F(DeviceTest, SeveralDevicesLiveSideBySide)
{
    const gpu::Device second;
    EXPECT_EQ(second.info().name, gpu_test::device().info().name);
}

/// Writes a buffer twice with no barrier between; only synchronisation validation can detect that.
void write_twice_without_a_barrier()
{
    const gpu::Buffer buffer(gpu_test::device(), 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::HostAccess::None,
                             "twice");
    gpu_test::device().run_once([&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer.handle(), 0, 64, 1);
        vkCmdFillBuffer(commands, buffer.handle(), 0, 64, 2);
    });
}

TEST_F(DeviceTest, AMissingBarrierIsReported)
{
    write_twice_without_a_barrier();
    EXPECT_THAT(gpu_test::device().validation_messages(), SizeIs(1));
    EXPECT_THAT(gpu_test::device().validation_messages().at(0), HasSubstr("SYNC-HAZARD-WRITE-AFTER-WRITE"));
    gpu_test::device().clear_validation_messages();
}

TEST_F(DeviceTest, AMessageFailsTheTest)
{
    write_twice_without_a_barrier();
    EXPECT_NONFATAL_FAILURE(DeviceTest::TearDown(), "SYNC-HAZARD");
    gpu_test::device().clear_validation_messages();
}

} // namespace
