// Whole files in and out, with the errors a user can act on.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace engine {

/// The bytes of a regular file. Throws cicatrix::InputError when it is missing, no regular file, empty,
/// unreadable or larger than `max_bytes`.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Creates or replaces a file, not atomically: give it the temporary of write_atomically.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

} // namespace engine
