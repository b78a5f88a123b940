#include "base/file.hpp"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/input_error.hpp"

namespace base {

using nlohmann::json;

std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::size_t max_bytes)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw InputError(path.string(), "there is no such file", "check the path");
    // A pipe or a device could be endless; a folder cannot be read.
    if (!std::filesystem::is_regular_file(status))
        throw InputError(path.string(), "is not a regular file", "name a file, not a folder or a device");
    const auto size = std::filesystem::file_size(path, error);
    if (error)
        throw InputError(path.string(), error.message(), "check the file's permissions");
    if (size == 0)
        throw InputError(path.string(), "the file is empty", "copy or export it again");
    if (size > max_bytes)
        throw InputError(path.string(),
                         fmt::format("{} MB is more than the limit of {} MB", size >> 20, max_bytes >> 20),
                         "use a smaller file");
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path, std::ios::binary);
    errno = 0;
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw InputError(path.string(), fmt::format("cannot be read: {}", std::strerror(errno)),
                         "check the file's permissions");
    return bytes;
}

namespace {

/// Removes the prefix "[json.exception.parse_error.101] " and joins the message into one line.
std::string message_of(const json::exception& error)
{
    std::string message = error.what();
    if (const auto bracket = message.find("] "); bracket != std::string::npos)
        message.erase(0, bracket + 2);
    for (char& c : message)
        c = c == '\n' ? ' ' : c;
    return message;
}

} // namespace

void check_json_depth(std::string_view text, std::string_view where)
{
    constexpr int deepest = 100;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"')
            in_string = !in_string;
        else if (in_string)
            i += c == '\\';
        else if (c == '[' || c == '{')
            ++depth;
        else if (c == ']' || c == '}')
            --depth;
        if (depth > deepest)
            throw InputError(where, fmt::format("nests arrays and objects more than {} deep", deepest),
                             "nothing here needs that; check how the file was made");
    }
}

json read_json(const std::filesystem::path& path)
{
    constexpr std::size_t largest = 64u << 20;
    const std::vector<std::uint8_t> bytes = read_file(path, largest);
    check_json_depth({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
    try {
        return json::parse(bytes);
    } catch (const json::out_of_range& error) { // "number overflow parsing '1e999'"
        throw InputError(path.string(), "contains a number out of range: " + message_of(error),
                         "use numbers of magnitude below 1.8e308");
    } catch (const json::exception& error) {
        throw InputError(path.string(), "is not valid JSON: " + message_of(error),
                         "correct the file at that place");
    }
}

std::string file_version(const std::filesystem::path& path)
{
    std::error_code error;
    const auto time = std::filesystem::last_write_time(path, error);
    return fmt::format("{}@{}|", path.string(), error ? 0 : time.time_since_epoch().count());
}

void make_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder) || ::access(folder.c_str(), W_OK) != 0)
        throw InputError(folder.string(), "cannot be written to", "name another folder with --out");
}

std::filesystem::path cache_folder()
{
    const auto variable = [](const char* name) -> std::string {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty())
        return std::filesystem::path(cache) / "cicatrix";
    if (const std::string home = variable("HOME"); !home.empty())
        return std::filesystem::path(home) / ".cache" / "cicatrix";
    return std::filesystem::temp_directory_path() / "cicatrix";
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close(); // flushes, so that a full disk is detected below
    if (!file)
        throw InputError(path.string(), fmt::format("cannot be written: {}", std::strerror(errno)),
                         "choose a folder that exists, can be written to and has room");
}

std::filesystem::path temporary_beside(const std::filesystem::path& path)
{
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        throw InputError(path.string(), fmt::format("there is no folder {}", folder.string()),
                         "create it first");
    if (access(folder.c_str(), W_OK) != 0 || std::filesystem::is_directory(path, error))
        throw InputError(path.string(), "cannot be written there", "choose a folder that can be written to");
    static std::atomic<unsigned> count = 0;
    std::filesystem::path temporary = path;
    // Keeps the extension, because some writers choose the format by it.
    temporary.replace_filename(
        fmt::format(".{}.{}-{}{}", path.stem().string(), getpid(), count++, path.extension().string()));
    return temporary;
}

void rename_over(const std::filesystem::path& temporary, const std::filesystem::path& path)
{
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error)
        throw InputError(path.string(), fmt::format("cannot be written: {}", error.message()),
                         "choose a folder that exists and can be written to");
}

void write_bytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    write_atomically(path, [&](const std::filesystem::path& temporary) {
        try {
            write_file(temporary, bytes);
        } catch (const InputError& error) { // name the user's file, not the temporary
            throw InputError(path.string(), error.problem(), error.cure());
        }
    });
}

void write_text(const std::filesystem::path& path, std::string_view text)
{
    write_bytes(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void write_json(const std::filesystem::path& path, const json& value)
{
    write_text(path, value.dump(2, ' ', false, json::error_handler_t::replace) + '\n');
}

} // namespace base
