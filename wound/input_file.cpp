#include "wound/input_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "wound/input_error.hpp"

namespace cicatrix {

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

/// "[json.exception.parse_error.101] parse error at line 3, column 5: ..." without the bracket, in one line.
std::string words_of(const json::exception& error)
{
    std::string message = error.what();
    if (const auto bracket = message.find("] "); bracket != std::string::npos)
        message.erase(0, bracket + 2);
    for (char& c : message)
        c = c == '\n' ? ' ' : c;
    return message;
}

} // namespace

json read_json(const std::filesystem::path& path)
{
    constexpr std::size_t largest = 64u << 20;
    const std::vector<std::uint8_t> bytes = read_file(path, largest);
    try {
        return json::parse(bytes);
    } catch (const json::out_of_range& error) { // "number overflow parsing '1e999'"
        throw InputError(path.string(), "holds a number out of range: " + words_of(error),
                         "give numbers below 1.8e308 in size");
    } catch (const json::exception& error) {
        throw InputError(path.string(), "is not valid JSON: " + words_of(error), "mend the file there");
    }
}

} // namespace cicatrix
