// Whole files in and out, with the errors a user can act on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

#include "wound/input_file.hpp"

namespace engine {

using cicatrix::read_file;

/// Creates or replaces a file, not atomically: give it the temporary of write_atomically.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

} // namespace engine
