#include "engine/file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "wound/input_error.hpp"

namespace engine {

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
