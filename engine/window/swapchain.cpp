#include "engine/window/swapchain.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <opencv2/imgproc.hpp>

#include "base/input_error.hpp"
#include "engine/gpu/memory.hpp"
#include "engine/gpu/vulkan_check.hpp"

namespace window {

namespace {

constexpr std::uint64_t patience_ns =
    100'000'000; // a hidden window may give no image for as long as it is hidden
constexpr VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

/// One step in the life of a window's image: what it waits for, what comes next.
struct Step
{
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout;
};
// The wait for the image to be free happens in the transfer stage; see submit().
constexpr Step free_image{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED},
    copied_to{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL},
    drawn_on{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
             VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
             VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};

void barrier(VkCommandBuffer commands, VkImage image, const Step& from, const Step& to)
{
    const VkImageMemoryBarrier2 one = graph::vulkan_barrier(
        {from.stages, from.access, to.stages, to.access, from.layout, to.layout}, image, whole);
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .imageMemoryBarrierCount = 1,
                                .pImageMemoryBarriers = &one};
    vkCmdPipelineBarrier2(commands, &info);
}

bool usable(VkPhysicalDevice device, VkFormat format)
{
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device, format, &properties);
    constexpr VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT |
                                            VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                            VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    return (properties.optimalTilingFeatures & needed) == needed;
}

/// Pictures and interface are sRGB-encoded already: a format that encodes once more would wash them out.
VkSurfaceFormatKHR choose_format(VkPhysicalDevice device, VkSurfaceKHR surface)
{
    std::uint32_t count = 0;
    gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr),
               "list the window's formats");
    std::vector<VkSurfaceFormatKHR> offered(count);
    gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, offered.data()),
               "list the window's formats");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM,
                                  VK_FORMAT_A8B8G8R8_UNORM_PACK32, VK_FORMAT_A2B10G10R10_UNORM_PACK32,
                                  VK_FORMAT_A2R10G10B10_UNORM_PACK32, VK_FORMAT_R5G6B5_UNORM_PACK16})
        for (const VkSurfaceFormatKHR& format : offered)
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR &&
                usable(device, wanted))
                return format;
    throw base::InputError("window", "the device offers no plain 8-bit colour for it",
                           "choose another with --device; cicatrix capture works without a window");
}

VkOffset3D corner(std::int32_t x, std::int32_t y, std::int32_t z)
{
    return {x, y, z};
}

} // namespace

PlacedPicture clipped(PlacedPicture picture, std::array<std::uint32_t, 2> window)
{
    const Box from = picture.from, to = picture.to;
    const auto cut = [](std::int32_t& at, std::int32_t inside, std::int32_t to_first, std::int32_t to_size,
                        std::int32_t from_first, std::int32_t from_size, std::int32_t& from_at) {
        at = inside;
        from_at = from_first + std::int32_t(std::lround(double(inside - to_first) * from_size / to_size));
    };
    if (from.empty() || to.empty())
        return {};
    const auto width = std::int32_t(window[0]), height = std::int32_t(window[1]);
    const auto across = [&](std::int32_t& at, std::int32_t& from_at) {
        cut(at, std::clamp(at, 0, width), to.left, to.width(), from.left, from.width(), from_at);
    };
    const auto down = [&](std::int32_t& at, std::int32_t& from_at) {
        cut(at, std::clamp(at, 0, height), to.top, to.height(), from.top, from.height(), from_at);
    };
    across(picture.to.left, picture.from.left);
    across(picture.to.right, picture.from.right);
    down(picture.to.top, picture.from.top);
    down(picture.to.bottom, picture.from.bottom);
    return picture;
}

Swapchain::Swapchain(const gpu::Device& used, const Window& shown)
    : device(used), window(shown), ui_renderer(used),
      commands(used.handle(), used.queue(), used.queue_family())
{
    try {
        make_surface();
        const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        gpu::check(vkCreateSemaphore(device.handle(), &semaphore, nullptr, &acquired), "create a semaphore");
    } catch (...) {
        destroy();
        throw;
    }
}

Swapchain::~Swapchain()
{
    destroy();
}

void Swapchain::destroy()
{
    vkQueueWaitIdle(device.queue()); // presentation has no fence
    destroy_swapchain();
    if (surface)
        vkDestroySurfaceKHR(device.instance(), surface, nullptr);
    vkDestroySemaphore(device.handle(), acquired, nullptr);
}

void Swapchain::destroy_swapchain()
{
    for (const Target& target : targets)
        vkDestroyImageView(device.handle(), target.view, nullptr);
    for (const VkSemaphore semaphore : finished)
        vkDestroySemaphore(device.handle(), semaphore, nullptr);
    targets.clear();
    finished.clear();
    if (swapchain)
        vkDestroySwapchainKHR(device.handle(), swapchain, nullptr);
    swapchain = VK_NULL_HANDLE;
}

void Swapchain::make_surface()
{
    surface = window.make_surface(device.instance());
    VkBool32 supported = VK_FALSE;
    gpu::check(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical_device(), device.queue_family(), surface,
                                                    &supported),
               "ask whether the device can draw to the window");
    if (!supported)
        throw base::InputError("window", fmt::format("device '{}' cannot draw to it", device.info().name),
                               "choose another with --device; cicatrix capture works without a window");
    format = choose_format(device.physical_device(), surface);
    outdated = true;
}

/// The window's surface is gone (its display server restarted, the screen was switched): take a new one.
void Swapchain::lose_surface()
{
    vkQueueWaitIdle(device.queue());
    destroy_swapchain();
    vkDestroySurfaceKHR(device.instance(), surface, nullptr);
    surface = VK_NULL_HANDLE;
    make_surface();
}

bool Swapchain::match_window()
{
    const auto [width, height] = window.size();
    if (width == 0 || height == 0)
        return false;
    if (!outdated && extent.width == width && extent.height == height)
        return true;
    VkSurfaceCapabilitiesKHR capabilities{};
    const VkResult asked =
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical_device(), surface, &capabilities);
    if (asked == VK_ERROR_SURFACE_LOST_KHR) {
        lose_surface();
        return false;
    }
    gpu::check(asked, "ask for the window's size");
    VkExtent2D size = capabilities.currentExtent;
    if (size.width == ~0u) // the window takes the size of what is drawn to it
        size = {std::clamp(width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
                std::clamp(height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
    if (size.width == 0 || size.height == 0)
        return false;
    make_swapchain(capabilities, size);
    return true;
}

void Swapchain::make_swapchain(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D size)
{
    vkQueueWaitIdle(device.queue());
    destroy_swapchain();
    constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if ((capabilities.supportedUsageFlags & usage) != usage)
        throw base::InputError("window", "the device can draw to it but not copy to it",
                               "choose another with --device; cicatrix capture works without a window");
    const std::uint32_t most = capabilities.maxImageCount > 0 ? capabilities.maxImageCount : ~0u;
    VkCompositeAlphaFlagBitsKHR alpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    if (!(capabilities.supportedCompositeAlpha & alpha))
        alpha = VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR; // ours is 1 everywhere
    const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                        .surface = surface,
                                        .minImageCount = std::min(capabilities.minImageCount + 1, most),
                                        .imageFormat = format.format,
                                        .imageColorSpace = format.colorSpace,
                                        .imageExtent = size,
                                        .imageArrayLayers = 1,
                                        .imageUsage = usage,
                                        .preTransform = capabilities.currentTransform,
                                        .compositeAlpha = alpha,
                                        .presentMode = VK_PRESENT_MODE_FIFO_KHR, // everywhere; does not tear
                                        .clipped = VK_TRUE};
    gpu::check(vkCreateSwapchainKHR(device.handle(), &info, nullptr, &swapchain), "draw to the window");
    std::uint32_t count = 0;
    gpu::check(vkGetSwapchainImagesKHR(device.handle(), swapchain, &count, nullptr),
               "get the window's images");
    std::vector<VkImage> images(count);
    gpu::check(vkGetSwapchainImagesKHR(device.handle(), swapchain, &count, images.data()),
               "get the window's images");
    for (const VkImage image : images) {
        const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = image,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = format.format,
                                         .subresourceRange = whole};
        Target& target = targets.emplace_back(Target{.image = image, .size = size, .format = format.format});
        gpu::check(vkCreateImageView(device.handle(), &view, nullptr, &target.view),
                   "view the window's images");
        const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        gpu::check(vkCreateSemaphore(device.handle(), &semaphore, nullptr, &finished.emplace_back()),
                   "create a semaphore");
    }
    extent = size;
    outdated = false;
}

void Swapchain::record(VkCommandBuffer to, const WindowFrame& frame, const Target& target,
                       VkImageLayout final_layout)
{
    barrier(to, target.image, free_image, copied_to);
    VkClearColorValue background{};
    std::copy(frame.background.begin(), frame.background.end(), background.float32);
    vkCmdClearColorImage(to, target.image, copied_to.layout, &background, 1, &whole);
    for (const PlacedPicture& placed : frame.pictures) {
        const PlacedPicture picture = clipped(placed, {target.size.width, target.size.height});
        if (picture.image == VK_NULL_HANDLE || picture.from.empty() || picture.to.empty())
            continue;
        barrier(to, target.image, copied_to, copied_to);
        const VkImageBlit region{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .srcOffsets = {corner(picture.from.left, picture.from.top, 0),
                                                corner(picture.from.right, picture.from.bottom, 1)},
                                 .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .dstOffsets = {corner(picture.to.left, picture.to.top, 0),
                                                corner(picture.to.right, picture.to.bottom, 1)}};
        const bool same =
            picture.from.width() == picture.to.width() && picture.from.height() == picture.to.height();
        vkCmdBlitImage(to, picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image,
                       copied_to.layout, 1, &region, same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    }
    barrier(to, target.image, copied_to, drawn_on);
    const VkRenderingAttachmentInfo attachment{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                               .imageView = target.view,
                                               .imageLayout = drawn_on.layout,
                                               .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                               .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {{0, 0}, target.size},
                                    .layerCount = 1,
                                    .colorAttachmentCount = 1,
                                    .pColorAttachments = &attachment};
    vkCmdBeginRendering(to, &rendering);
    if (frame.ui)
        ui_renderer.record(to, *frame.ui, target.format, target.size);
    vkCmdEndRendering(to);
    const bool copied = final_layout == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier(to, target.image, drawn_on,
            {copied ? VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT : VK_PIPELINE_STAGE_2_NONE,
             copied ? VK_ACCESS_2_TRANSFER_READ_BIT : VK_ACCESS_2_NONE, final_layout});
}

bool Swapchain::show(const WindowFrame& frame)
{
    if (!match_window())
        return false;
    // The last frame's commands, vertices and semaphore are used again.
    commands.wait();
    std::uint32_t index = 0;
    const VkResult got =
        vkAcquireNextImageKHR(device.handle(), swapchain, patience_ns, acquired, VK_NULL_HANDLE, &index);
    if (got == VK_ERROR_SURFACE_LOST_KHR)
        lose_surface();
    outdated = outdated || got == VK_ERROR_OUT_OF_DATE_KHR || got == VK_SUBOPTIMAL_KHR;
    if (got != VK_SUCCESS && got != VK_SUBOPTIMAL_KHR) {
        if (got != VK_TIMEOUT && got != VK_NOT_READY && got != VK_ERROR_OUT_OF_DATE_KHR &&
            got != VK_ERROR_SURFACE_LOST_KHR)
            gpu::check(got, "get the window's next image");
        return false;
    }
    record(commands.begin(), frame, targets[index], VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = acquired,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT},
        signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
               .semaphore = finished[index],
               .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    commands.submit({&wait, 1}, {&signal, 1});
    const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                   .waitSemaphoreCount = 1,
                                   .pWaitSemaphores = &finished[index],
                                   .swapchainCount = 1,
                                   .pSwapchains = &swapchain,
                                   .pImageIndices = &index};
    const VkResult shown = vkQueuePresentKHR(device.queue(), &present);
    if (shown == VK_ERROR_SURFACE_LOST_KHR) {
        lose_surface();
        return false;
    }
    outdated = outdated || shown == VK_ERROR_OUT_OF_DATE_KHR || shown == VK_SUBOPTIMAL_KHR;
    if (shown != VK_ERROR_OUT_OF_DATE_KHR)
        gpu::check(shown, "show the window's picture");
    return shown != VK_ERROR_OUT_OF_DATE_KHR;
}

cv::Mat3b Swapchain::picture_of(const WindowFrame& frame)
{
    if (!match_window())
        return {};
    commands.wait();
    constexpr VkFormat rgba = VK_FORMAT_R8G8B8A8_UNORM;
    const gpu::Image canvas(device, {extent.width, extent.height, rgba}, 1,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            "window");
    const gpu::Buffer bytes(device, VkDeviceSize{extent.width} * extent.height * 4,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::HostAccess::Read, "window");
    device.run_once([&](VkCommandBuffer to) {
        record(to, frame, {canvas.handle(), canvas.view(), extent, rgba},
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {extent.width, extent.height, 1}};
        vkCmdCopyImageToBuffer(to, canvas.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, bytes.handle(), 1,
                               &region);
        const VkMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                       .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                       .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                       .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                       .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
        const VkDependencyInfo info{
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
        vkCmdPipelineBarrier2(to, &info);
    });
    bytes.invalidate();
    const cv::Mat4b pixels(int(extent.height), int(extent.width),
                           reinterpret_cast<cv::Vec4b*>(bytes.mapped().data()));
    cv::Mat3b rgb;
    cv::cvtColor(pixels, rgb, cv::COLOR_RGBA2RGB);
    return rgb;
}

} // namespace window
