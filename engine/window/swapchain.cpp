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

constexpr std::uint64_t acquire_timeout_ns = 100'000'000; // a hidden window may never provide an image
constexpr VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

/// A use of a window's image; a barrier goes from one step to the next.
struct Step
{
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout;
};
// The semaphore of the free image is waited for in the transfer stage; see show().
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

/// Chooses a UNORM format: pictures and interface are already sRGB-encoded and must not be encoded twice.
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
    throw base::InputError("window", "the device offers no suitable colour format for it",
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

Swapchain::Swapchain(const gpu::Device& device, const Window& window)
    : device_(device), window_(window), ui_renderer_(device),
      commands_(device.handle(), device.queue(), device.queue_family())
{
    try {
        make_surface();
        const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        gpu::check(vkCreateSemaphore(device_.handle(), &semaphore, nullptr, &acquired_),
                   "create a semaphore");
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
    vkQueueWaitIdle(device_.queue()); // no fence signals the end of presentation
    destroy_swapchain();
    if (surface_)
        vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
    vkDestroySemaphore(device_.handle(), acquired_, nullptr);
}

void Swapchain::destroy_swapchain()
{
    for (const Target& target : targets_)
        vkDestroyImageView(device_.handle(), target.view, nullptr);
    for (const VkSemaphore semaphore : finished_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    targets_.clear();
    finished_.clear();
    if (swapchain_)
        vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = VK_NULL_HANDLE;
}

void Swapchain::make_surface()
{
    surface_ = window_.make_surface(device_.instance());
    VkBool32 supported = VK_FALSE;
    gpu::check(vkGetPhysicalDeviceSurfaceSupportKHR(device_.physical_device(), device_.queue_family(),
                                                    surface_, &supported),
               "ask whether the device can draw to the window");
    if (!supported)
        throw base::InputError("window", fmt::format("device '{}' cannot draw to it", device_.info().name),
                               "choose another with --device; cicatrix capture works without a window");
    format_ = choose_format(device_.physical_device(), surface_);
    outdated_ = true;
}

/// Recreates a lost surface (the display server restarted, the screen was switched).
void Swapchain::lose_surface()
{
    vkQueueWaitIdle(device_.queue());
    destroy_swapchain();
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
    surface_ = VK_NULL_HANDLE;
    make_surface();
}

bool Swapchain::match_window()
{
    const auto [width, height] = window_.size();
    if (width == 0 || height == 0)
        return false;
    if (!outdated_ && extent_.width == width && extent_.height == height)
        return true;
    VkSurfaceCapabilitiesKHR capabilities{};
    const VkResult asked =
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical_device(), surface_, &capabilities);
    if (asked == VK_ERROR_SURFACE_LOST_KHR) {
        lose_surface();
        return false;
    }
    gpu::check(asked, "ask for the window's size");
    VkExtent2D size = capabilities.currentExtent;
    if (size.width == ~0u) // the swapchain determines the window's size
        size = {std::clamp(width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
                std::clamp(height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
    if (size.width == 0 || size.height == 0)
        return false;
    make_swapchain(capabilities, size);
    return true;
}

void Swapchain::make_swapchain(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D size)
{
    vkQueueWaitIdle(device_.queue());
    destroy_swapchain();
    constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if ((capabilities.supportedUsageFlags & usage) != usage)
        throw base::InputError("window", "the device can draw to it but not copy to it",
                               "choose another with --device; cicatrix capture works without a window");
    const std::uint32_t most = capabilities.maxImageCount > 0 ? capabilities.maxImageCount : ~0u;
    VkCompositeAlphaFlagBitsKHR alpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    if (!(capabilities.supportedCompositeAlpha & alpha))
        alpha = VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR; // our alpha is 1 everywhere
    const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                        .surface = surface_,
                                        .minImageCount = std::min(capabilities.minImageCount + 1, most),
                                        .imageFormat = format_.format,
                                        .imageColorSpace = format_.colorSpace,
                                        .imageExtent = size,
                                        .imageArrayLayers = 1,
                                        .imageUsage = usage,
                                        .preTransform = capabilities.currentTransform,
                                        .compositeAlpha = alpha,
                                        .presentMode =
                                            VK_PRESENT_MODE_FIFO_KHR, // always supported; no tearing
                                        .clipped = VK_TRUE};
    gpu::check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain_), "draw to the window");
    std::uint32_t count = 0;
    gpu::check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr),
               "get the window's images");
    std::vector<VkImage> images(count);
    gpu::check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images.data()),
               "get the window's images");
    for (const VkImage image : images) {
        const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = image,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = format_.format,
                                         .subresourceRange = whole};
        Target& target =
            targets_.emplace_back(Target{.image = image, .size = size, .format = format_.format});
        gpu::check(vkCreateImageView(device_.handle(), &view, nullptr, &target.view),
                   "view the window's images");
        const VkSemaphoreCreateInfo semaphore{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        gpu::check(vkCreateSemaphore(device_.handle(), &semaphore, nullptr, &finished_.emplace_back()),
                   "create a semaphore");
    }
    extent_ = size;
    outdated_ = false;
}

void Swapchain::record(VkCommandBuffer commands, const WindowFrame& frame, const Target& target,
                       VkImageLayout final_layout)
{
    barrier(commands, target.image, free_image, copied_to);
    VkClearColorValue background{};
    std::copy(frame.background.begin(), frame.background.end(), background.float32);
    vkCmdClearColorImage(commands, target.image, copied_to.layout, &background, 1, &whole);
    for (const PlacedPicture& placed : frame.pictures) {
        const PlacedPicture picture = clipped(placed, {target.size.width, target.size.height});
        if (picture.image == VK_NULL_HANDLE || picture.from.empty() || picture.to.empty())
            continue;
        barrier(commands, target.image, copied_to, copied_to);
        const VkImageBlit region{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .srcOffsets = {corner(picture.from.left, picture.from.top, 0),
                                                corner(picture.from.right, picture.from.bottom, 1)},
                                 .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .dstOffsets = {corner(picture.to.left, picture.to.top, 0),
                                                corner(picture.to.right, picture.to.bottom, 1)}};
        const bool same =
            picture.from.width() == picture.to.width() && picture.from.height() == picture.to.height();
        vkCmdBlitImage(commands, picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image,
                       copied_to.layout, 1, &region, same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    }
    barrier(commands, target.image, copied_to, drawn_on);
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
    vkCmdBeginRendering(commands, &rendering);
    if (frame.ui)
        ui_renderer_.record(commands, *frame.ui, target.format, target.size);
    vkCmdEndRendering(commands);
    const bool copied = final_layout == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier(commands, target.image, drawn_on,
            {copied ? VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT : VK_PIPELINE_STAGE_2_NONE,
             copied ? VK_ACCESS_2_TRANSFER_READ_BIT : VK_ACCESS_2_NONE, final_layout});
}

bool Swapchain::show(const WindowFrame& frame)
{
    if (!match_window())
        return false;
    // This frame reuses the last frame's command buffer, vertices and semaphore.
    commands_.wait();
    std::uint32_t index = 0;
    const VkResult got = vkAcquireNextImageKHR(device_.handle(), swapchain_, acquire_timeout_ns, acquired_,
                                               VK_NULL_HANDLE, &index);
    if (got == VK_ERROR_SURFACE_LOST_KHR)
        lose_surface();
    outdated_ = outdated_ || got == VK_ERROR_OUT_OF_DATE_KHR || got == VK_SUBOPTIMAL_KHR;
    if (got != VK_SUCCESS && got != VK_SUBOPTIMAL_KHR) {
        if (got != VK_TIMEOUT && got != VK_NOT_READY && got != VK_ERROR_OUT_OF_DATE_KHR &&
            got != VK_ERROR_SURFACE_LOST_KHR)
            gpu::check(got, "get the window's next image");
        return false;
    }
    record(commands_.begin(), frame, targets_[index], VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    const VkSemaphoreSubmitInfo wait{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = acquired_,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT},
        signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
               .semaphore = finished_[index],
               .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    commands_.submit({&wait, 1}, {&signal, 1});
    const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                   .waitSemaphoreCount = 1,
                                   .pWaitSemaphores = &finished_[index],
                                   .swapchainCount = 1,
                                   .pSwapchains = &swapchain_,
                                   .pImageIndices = &index};
    const VkResult shown = vkQueuePresentKHR(device_.queue(), &present);
    if (shown == VK_ERROR_SURFACE_LOST_KHR) {
        lose_surface();
        return false;
    }
    outdated_ = outdated_ || shown == VK_ERROR_OUT_OF_DATE_KHR || shown == VK_SUBOPTIMAL_KHR;
    if (shown != VK_ERROR_OUT_OF_DATE_KHR)
        gpu::check(shown, "show the window's picture");
    return shown != VK_ERROR_OUT_OF_DATE_KHR;
}

cv::Mat3b Swapchain::picture_of(const WindowFrame& frame)
{
    if (!match_window())
        return {};
    commands_.wait();
    constexpr VkFormat rgba = VK_FORMAT_R8G8B8A8_UNORM;
    const gpu::Image canvas(device_, {extent_.width, extent_.height, rgba}, 1,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            "window");
    const gpu::Buffer bytes(device_, VkDeviceSize{extent_.width} * extent_.height * 4,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::HostAccess::Read, "window");
    device_.run_once([&](VkCommandBuffer commands) {
        record(commands, frame, {canvas.handle(), canvas.view(), extent_, rgba},
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {extent_.width, extent_.height, 1}};
        vkCmdCopyImageToBuffer(commands, canvas.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               bytes.handle(), 1, &region);
        const VkMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                       .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                       .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                       .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                       .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
        const VkDependencyInfo info{
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
        vkCmdPipelineBarrier2(commands, &info);
    });
    bytes.invalidate();
    const cv::Mat4b pixels(int(extent_.height), int(extent_.width),
                           reinterpret_cast<cv::Vec4b*>(bytes.mapped().data()));
    cv::Mat3b rgb;
    cv::cvtColor(pixels, rgb, cv::COLOR_RGBA2RGB);
    return rgb;
}

} // namespace window
