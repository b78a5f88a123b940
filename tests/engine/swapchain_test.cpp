// Clipping of pictures to a window, and recovery from a lost surface.
#include "engine/window/swapchain.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

#include "tests/support/desktop.hpp"

namespace {

using window::Box;
using window::clipped;
using window::PlacedPicture;

TEST(PlacedPicture, InsideTheWindowIsUnchanged)
{
    const PlacedPicture picture{VK_NULL_HANDLE, {0, 0, 50, 30}, {10, 20, 110, 80}};
    const PlacedPicture cut = clipped(picture, {200, 100});
    EXPECT_EQ(cut.from, picture.from);
    EXPECT_EQ(cut.to, picture.to);
}

TEST(PlacedPicture, IsClippedToTheWindowAtTheSameScale)
{
    // The window shows the picture at twice its size: 20 window pixels are 10 picture pixels.
    const PlacedPicture cut = clipped({VK_NULL_HANDLE, {0, 0, 50, 30}, {-20, 20, 80, 80}}, {60, 60});
    EXPECT_EQ(cut.to, (Box{0, 20, 60, 60}));
    EXPECT_EQ(cut.from, (Box{10, 0, 40, 20}));
}

TEST(PlacedPicture, OutsideTheWindowIsEmpty)
{
    EXPECT_TRUE(clipped({VK_NULL_HANDLE, {0, 0, 50, 30}, {300, 0, 400, 60}}, {200, 100}).to.empty());
    EXPECT_TRUE(clipped({VK_NULL_HANDLE, {0, 0, 50, 30}, {0, 0, 0, 60}}, {200, 100}).to.empty())
        << "no width";
}

/// The call that reports a lost surface, once.
enum class Lost
{
    AskingForTheSize,
    AcquiringAnImage,
    Presenting
} lost;
PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR ask;
PFN_vkAcquireNextImageKHR acquire;
PFN_vkQueuePresentKHR present;

void lose_once(Lost when)
{
    lost = when;
    ask = vkGetPhysicalDeviceSurfaceCapabilitiesKHR;
    acquire = vkAcquireNextImageKHR;
    present = vkQueuePresentKHR;
    if (when == Lost::AskingForTheSize)
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR = [](VkPhysicalDevice, VkSurfaceKHR,
                                                       VkSurfaceCapabilitiesKHR*) {
            vkGetPhysicalDeviceSurfaceCapabilitiesKHR = ask;
            return VK_ERROR_SURFACE_LOST_KHR;
        };
    if (when == Lost::AcquiringAnImage)
        vkAcquireNextImageKHR = [](VkDevice, VkSwapchainKHR, std::uint64_t, VkSemaphore, VkFence,
                                   std::uint32_t*) {
            vkAcquireNextImageKHR = acquire;
            return VK_ERROR_SURFACE_LOST_KHR;
        };
    if (when == Lost::Presenting)
        vkQueuePresentKHR = [](VkQueue queue, const VkPresentInfoKHR* info) {
            vkQueuePresentKHR = present;
            present(queue, info); // the semaphores must be waited for even though the picture is lost
            return VK_ERROR_SURFACE_LOST_KHR;
        };
}

TEST(Swapchain, RecreatesALostSurface)
{
    const Desktop desktop;
    ::setenv("DISPLAY", desktop.display().c_str(), 1);
    const window::Window window("lost", {320, 200});
    gpu::Device device({.validation = true,
                        .instance_extensions = window.instance_extensions(),
                        .wishes = {{window::Window::swapchain_extension}, window::Window::can_present}});
    {
        window::Swapchain swapchain(device, window);
        const auto shows = [&](const std::array<float, 4>& background) {
            for (int attempt = 0; attempt < 5; ++attempt)
                if (swapchain.show({{}, background, nullptr}))
                    return true;
            return false;
        };
        ASSERT_TRUE(shows({0, 0, 1, 1}));
        for (const Lost when : {Lost::AcquiringAnImage, Lost::Presenting, Lost::AskingForTheSize}) {
            lose_once(when);
            if (when == Lost::AskingForTheSize) // the size is queried after a resize
                desktop.xdotool({"search", "--name", "lost", "windowsize", "--sync", "300", "180"});
            else
                EXPECT_FALSE(swapchain.show({{}, {0, 1, 0, 1}, nullptr})) << int(when);
            EXPECT_TRUE(shows({1, 0, 0, 1})) << int(when);
            EXPECT_TRUE(vkGetPhysicalDeviceSurfaceCapabilitiesKHR == ask &&
                        vkAcquireNextImageKHR == acquire && vkQueuePresentKHR == present)
                << int(when) << ": this call was not made";
        }
        vkDeviceWaitIdle(device.handle());
        const cv::Mat3b screen = desktop.picture();
        int red = 0;
        for (const cv::Vec3b& pixel : screen)
            red += pixel == cv::Vec3b(255, 0, 0);
        EXPECT_GT(red, 200 * 120);
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

} // namespace
