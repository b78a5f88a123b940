// Reads and writes whole files, with error messages that tell the user what to do. Writing is atomic: a
// temporary file beside the final one is written, checked and renamed.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace base {

/// The bytes of a regular file. Throws InputError when the file is missing, not regular, empty, unreadable
/// or larger than `max_bytes`.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Throws InputError at `where` when JSON text nests arrays and objects more than 100 deep: what prints such
/// a value recurses, and its stack would overflow.
void check_json_depth(std::string_view text, std::string_view where);

/// Parses a file of at most 64 MB; throws InputError naming the file and, for broken JSON, the line.
nlohmann::json read_json(const std::filesystem::path& path);

/// A cache key of the path and the file's modification time: data derived from the file is valid as long
/// as the key does not change.
std::string file_version(const std::filesystem::path& path);

/// Creates the folder and its parents. Throws InputError when it cannot be created or written to.
void make_folder(const std::filesystem::path& folder);

/// cicatrix/ in $XDG_CACHE_HOME, else in ~/.cache, else in the system's temporary folder.
std::filesystem::path cache_folder();

/// Creates or replaces a file, not atomically; use it for the temporary of write_atomically. Throws
/// InputError when the file cannot be written completely.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// The two steps of write_atomically that need no template.
std::filesystem::path temporary_beside(const std::filesystem::path& path);
void rename_over(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Runs `write(temporary)` and renames the temporary to `path`. `write` takes the path of a temporary file in
/// the folder of `path` and must throw when it cannot write everything. On any failure the temporary is
/// removed and `path` is unchanged. Throws InputError when the temporary cannot be created or renamed.
template <typename Write>
void write_atomically(const std::filesystem::path& path, Write&& write)
{
    const std::filesystem::path temporary = temporary_beside(path);
    try {
        std::forward<Write>(write)(temporary);
        rename_over(temporary, path);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
}

/// Atomic. Throw InputError when the file cannot be written completely.
void write_bytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_text(const std::filesystem::path& path, std::string_view text);
/// Bytes that are no UTF-8, as names of files may have, are replaced by U+FFFD.
void write_json(const std::filesystem::path& path, const nlohmann::json& json); // indented

} // namespace base
