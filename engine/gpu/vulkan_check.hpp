// Converts VkResult errors that the machine causes into the exception type that the programs report.
#pragma once
#include <string_view>
#include <volk.h>

namespace gpu {

/// Throws base::InputError for any error code (lost device, exhausted memory, no driver, ...). `what`
/// completes the sentence "could not ...".
void check(VkResult result, std::string_view what);

} // namespace gpu
