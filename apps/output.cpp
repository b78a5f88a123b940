#include "apps/output.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "engine/image_io.hpp"
#include "wound/input_error.hpp"

namespace app {

void make_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder) || ::access(folder.c_str(), W_OK) != 0)
        throw cicatrix::InputError(folder.string(), "cannot be written to", "name another folder with --out");
}

void write_text(const std::filesystem::path& path, std::string_view text)
{
    engine::write_atomically(path, [&](const std::filesystem::path& temporary) {
        std::ofstream file(temporary);
        file << text;
        if (!file.flush())
            throw cicatrix::InputError(path.string(), "could not be written",
                                       "see that the disk is not full");
    });
}

void write_json(const std::filesystem::path& path, const nlohmann::json& json)
{
    write_text(path, json.dump(2) + '\n');
}

} // namespace app
