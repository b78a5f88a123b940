// A user's files, read whole and written whole, with errors that the user can act on. Writing is atomic: a
// temporary file beside the final one is written, checked, and takes its name.
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

/// The bytes of a regular file. Throws InputError when it is missing, no regular file, empty, unreadable or
/// larger than `max_bytes`.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Parses a file of at most 64 MB; throws InputError naming the file and, for broken JSON, the line.
nlohmann::json read_json(const std::filesystem::path& path);

/// Names a path and when its file was last written: what was made from the file is good as long as this
/// stands.
std::string file_version(const std::filesystem::path& path);

/// Throws InputError when the folder cannot be made or written to.
void make_folder(const std::filesystem::path& folder);

/// cicatrix/ in XDG_CACHE_HOME, else in ~/.cache.
std::filesystem::path cache_folder();

/// Creates or replaces a file, not atomically: give it the temporary of write_atomically. Throws InputError
/// when not everything could be written.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// The two halves of write_atomically that need no template.
std::filesystem::path temporary_beside(const std::filesystem::path& path);
void rename_over(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Runs `write(temporary)` and renames the temporary to `path`; on any failure the temporary is gone and
/// `path` is as it was. `write` takes the temporary's path, which lies beside `path`, and must throw when it
/// could not write everything. Throws InputError when the temporary cannot be made or renamed.
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

/// Atomic. Throw InputError when the file cannot be written whole.
void write_bytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_text(const std::filesystem::path& path, std::string_view text);
void write_json(const std::filesystem::path& path, const nlohmann::json& json); // indented

} // namespace base
