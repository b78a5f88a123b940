// Reads and writes scene files (JSON) by the table of fields.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "wound/photo/segmentation.hpp"

namespace scene {
struct Scene;

/// Version of the scene format. A file may state it as "version"; files of later versions are rejected.
inline constexpr int scene_version = 1;

/// Reads a scene; paths in it are relative to the scene's folder. Throws base::InputError naming file and
/// field.
Scene read_scene(const std::filesystem::path& path);
/// Like read_scene(), from JSON: paths are relative to the folder of `path`, and messages begin with `where`.
Scene scene_of(const nlohmann::json& root, const std::filesystem::path& path, const std::string& where);
/// The scene as JSON with all fields, as in capture.json, but without healing courses that are
/// usual_healing(); scene_of() of it gives an equal scene.
nlohmann::json to_json(const Scene& scene);

/// The scene with every non-empty file path replaced by rename(path).
Scene with_files(Scene scene,
                 const std::function<std::filesystem::path(const std::filesystem::path&)>& rename);

/// Writes a file from which read_scene() returns an equal scene. Paths in the file's folder or below are
/// relative to it, so that the folder can be moved; others are absolute. Throws base::InputError if the file
/// cannot be written.
void save_scene(const std::filesystem::path& path, const Scene& scene);

/// A point or vector as an array of three.
nlohmann::json numbers_of(const glm::dvec3& v);

/// "segmentation": {"seed": [x, y], "rect": [x, y, w, h]}; messages begin with `where`. Throws
/// base::InputError.
wound::SegmentationHints read_hints(const nlohmann::json& object, const std::string& where);

/// "0:30:3" (first:last:step) or "0,5,12"; 0 to 3650, at most 10000 days. Throws base::InputError naming
/// `where`.
std::vector<double> parse_days(const std::string& text, const std::string& where);
/// "1280x720", 16 to 16384 a side. Throws base::InputError naming `where`.
std::array<std::uint32_t, 2> parse_size(const std::string& text, const std::string& where);

} // namespace scene
