// Where results go: folders that can be written to, JSON files that are whole or absent.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace app {

/// Throws cicatrix::InputError when the folder cannot be made or written to.
void make_folder(const std::filesystem::path& folder);

/// Atomic. Throws cicatrix::InputError when it cannot be written whole.
void write_text(const std::filesystem::path& path, std::string_view text);

/// Indented, atomic. Throws cicatrix::InputError when it cannot be written whole.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

} // namespace app
