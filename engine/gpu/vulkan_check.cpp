#include "engine/gpu/vulkan_check.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

namespace gpu {

void check(VkResult result, std::string_view what)
{
    if (result >= 0)
        return;
    switch (result) {
    case VK_ERROR_DEVICE_LOST:
        throw base::InputError("Vulkan device", fmt::format("was lost; could not {}", what),
                               "try again, or choose another with --device");
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        throw base::InputError("Vulkan device", fmt::format("ran out of memory; could not {}", what),
                               "make the pictures smaller, or choose another device with --device");
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        throw base::InputError("Vulkan", "no driver was found",
                               "install one (Debian: mesa-vulkan-drivers, which can also draw on the CPU)");
    default:
        throw base::InputError("Vulkan device",
                               fmt::format("could not {} (VkResult {})", what, static_cast<int>(result)),
                               "update the driver, or choose another device with --device");
    }
}

} // namespace gpu
