// Scene files: JSON in and out, by the table of fields.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace scene {

/// The format of scene files. A file may state it as "version"; one of a later version is refused.
inline constexpr int scene_version = 1;

/// Reads a scene; files inside are relative to the scene's folder. Throws base::InputError naming file and
/// field.
Scene read_scene(const std::filesystem::path& path);
/// The same of JSON that was read or made elsewhere: files inside are relative to the folder of `path`, and
/// messages begin with `where`.
Scene scene_of(const nlohmann::json& root, const std::filesystem::path& path, const std::string& where);
/// The scene as JSON, all fields spelled out, as capture.json records it; read_scene reads it back.
nlohmann::json to_json(const Scene& scene);

/// The same scene with the name of every file in it changed by `rename`; empty names stay empty.
Scene with_files(Scene scene,
                 const std::function<std::filesystem::path(const std::filesystem::path&)>& rename);

/// Writes the scene as a file that read_scene reads back as an equal value. Files in the new file's folder or
/// below are named relative to it, so that the folder can be moved; others absolutely. Throws
/// base::InputError when it cannot be written.
void save_scene(const std::filesystem::path& path, const Scene& scene);

/// "segmentation": {"seed": [x, y], "rect": [x, y, w, h]}; messages begin with `where`. Throws
/// base::InputError.
wound::SegmentationHints read_hints(const nlohmann::json& object, const std::string& where);

/// "0:30:3" (first:last:step) or "0,5,12"; 0 to 3650, at most 10000 days. Throws base::InputError naming
/// `where`.
std::vector<double> parse_days(const std::string& text, const std::string& where);
/// "1280x720", 16 to 16384 a side. Throws base::InputError naming `where`.
std::array<std::uint32_t, 2> parse_size(const std::string& text, const std::string& where);

} // namespace scene
