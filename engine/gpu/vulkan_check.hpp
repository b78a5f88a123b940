// Turns a VkResult that the machine is to blame for into the one exception the programs report.
#pragma once
#include <string_view>
#include <volk.h>

namespace gpu {

/// Throws base::InputError for a lost device, exhausted memory or an incomplete driver, saying while
/// doing `what`. `what` completes the sentence "could not ...".
void check(VkResult result, std::string_view what);

} // namespace gpu
