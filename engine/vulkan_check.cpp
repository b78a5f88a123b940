#include "engine/vulkan_check.hpp"

#include "wound/input_error.hpp"

#include <fmt/format.h>

namespace engine {

void check(VkResult result, std::string_view what)
{
    if (result >= 0)
        return;
    switch (result)
    {
    case VK_ERROR_DEVICE_LOST:
        throw cicatrix::InputError("Vulkan device", fmt::format("was lost; could not {}", what),
                                   "try again, or choose another with --device");
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        throw cicatrix::InputError("Vulkan device", fmt::format("ran out of memory; could not {}", what),
                                   "make the pictures smaller, or choose another device with --device");
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        throw cicatrix::InputError("Vulkan", "no driver was found",
                                   "install one (Debian: mesa-vulkan-drivers, which can also draw on the CPU)");
    default:
        throw cicatrix::InputError("Vulkan device",
                                   fmt::format("could not {} (VkResult {})", what, static_cast<int>(result)),
                                   "update the driver, or choose another device with --device");
    }
}

} // namespace engine
