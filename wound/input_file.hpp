// A user's files, read whole, with errors that the user can act on. Here for the same reason as InputError.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace cicatrix {

/// The bytes of a regular file. Throws InputError when it is missing, no regular file, empty, unreadable or
/// larger than `max_bytes`.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Parses a file of at most 64 MB; throws InputError naming the file and, for broken JSON, the line.
nlohmann::json read_json(const std::filesystem::path& path);

} // namespace cicatrix
