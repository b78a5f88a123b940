#include "engine/file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "wound/input_error.hpp"

namespace engine {

std::vector<std::uint8_t> read_file(const std::filesystem::path& path, std::size_t max_bytes)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw cicatrix::InputError(path.string(), "there is no such file", "check the path");
    // A pipe or a device could be endless; a folder cannot be read.
    if (!std::filesystem::is_regular_file(status))
        throw cicatrix::InputError(path.string(), "is not a regular file", "name a file");
    const auto size = std::filesystem::file_size(path, error);
    if (error)
        throw cicatrix::InputError(path.string(), error.message(), "check the file's permissions");
    if (size == 0)
        throw cicatrix::InputError(path.string(), "the file is empty", "copy or export it again");
    if (size > max_bytes)
        throw cicatrix::InputError(
            path.string(), fmt::format("{} MB is more than the limit of {} MB", size >> 20, max_bytes >> 20),
            "use a smaller file");
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path, std::ios::binary);
    errno = 0;
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw cicatrix::InputError(path.string(), fmt::format("cannot be read: {}", std::strerror(errno)),
                                   "check the file's permissions");
    return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close(); // flushes: a full disk shows here
    if (!file)
        throw cicatrix::InputError(path.string(), fmt::format("cannot be written: {}", std::strerror(errno)),
                                   "choose a folder that exists, can be written to and has room");
}

} // namespace engine
