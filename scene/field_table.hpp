// The fields of a scene, each defined once: name, unit, range, default, reading, writing, slider,
// documentation, and what must be recomputed when it changes. To add a field, add a member to a struct in
// scene/scene.hpp and an entry to a table in scene/field_table.cpp.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "scene/scene.hpp"

namespace base {
class Fields;
}

namespace scene {

/// What must be recomputed when a wound's field changes; each value includes those after it.
enum class Affects
{
    Photograph,  // the photograph and its segmentation; the default, which is safe for a new field
    Preparation, // the maps made from the photograph
    Fit,         // the fit to the skin
};

/// Where in the window the slider of a number of the scene itself stands. The sliders of wounds, healing,
/// lights and shading stand in the section of that name.
enum class Section
{
    Skin,
    Light,
};

/// A number's slider in the window; it may cover only a part of the number's range. Sliders stand in the
/// order of their fields.
struct Slider
{
    std::string label;
    double low = 0, high = 1;
    const char* format = "%.2f"; // of printf
    bool logarithmic = false;
    Section section = Section::Skin; // of a number of the scene itself
};

struct FieldInfo
{
    std::string name;
    std::string range;         // with the unit: "mm, 1 to 200"; Markdown
    std::string meaning;       // Markdown
    std::string default_value; // Markdown
    Affects affects = Affects::Photograph;
    std::optional<Slider> slider;
};

/// Context for reading a field.
struct Reading
{
    std::filesystem::path file; // the scene's file; paths in the scene are relative to its folder
    const nlohmann::json* healing_of_all = nullptr; // the scene's `healing`, default of every wound
    std::string where_of_all{};                     // its place, for messages
};

template <typename Object>
struct Field : FieldInfo
{
    std::function<void(base::Fields&, Object&, Reading&)> read;
    /// Adds the field to a JSON object.
    std::function<void(nlohmann::json&, const Object&)> write;
    std::function<double&(Object&)> number; // only for numbers
    /// Whether the number matters in this object, so that the window shows its slider; empty: always.
    std::function<bool(const Object&)> shown_when;
    std::function<std::filesystem::path(const Object&)> file; // only for files; the path may be empty
    std::function<void(Object&, const std::filesystem::path&)> set_file;
};

const std::vector<Field<Scene>>& scene_fields();
const std::vector<Field<Wound>>& wound_fields();
const std::vector<Field<wound::Healing>>& healing_fields();
const std::vector<Field<Light>>& light_fields();
const std::vector<Field<Camera>>& camera_fields();
const std::vector<Field<optics::Shading>>& shading_fields();

/// Hashes every field of a wound whose change requires recomputing `affects`, and the files' modification
/// times.
void hash_fields(base::Hash& hash, const Wound& wound, Affects affects);

/// The tables of docs/scene.md by their headings ("scene", "wounds[]", ...), as Markdown.
std::vector<std::pair<std::string, std::string>> field_documentation();

} // namespace scene
