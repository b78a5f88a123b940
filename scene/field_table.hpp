// The fields of a scene, each said once: name, unit, range, default, reading, writing, slider, documentation,
// and what has to be made anew when it changes. A new field is a member of a struct in scene/scene.hpp and
// one entry of a table in scene/field_table.cpp.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.hpp"
#include "scene/scene.hpp"

namespace base {
class Fields;
}

namespace scene {

/// What of a prepared wound is made anew when a field changes; each includes those after it.
enum class Affects
{
    Photograph, // which photograph it is, and what is found in it: the default, so that no field is forgotten
    Preparation, // the maps made of it
    Fit,         // its place on the skin
};

/// How the window shows a number: a part of its range.
struct Slider
{
    std::string label;
    double low = 0, high = 1;
    const char* format = "%.2f"; // as printf has it
    bool logarithmic = false;
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

/// What reading a field may need beyond its own value.
struct Reading
{
    std::filesystem::path file;    // of the scene; files inside are relative to its folder
    wound::Healing healing_of_all; // of every wound that says nothing else
};

template <typename Object>
struct Field : FieldInfo
{
    std::function<void(base::Fields&, Object&, Reading&)> read;
    /// Adds what the field is to a JSON object.
    std::function<void(nlohmann::json&, const Object&)> write;
    std::function<double&(Object&)> number;                   // of a field with a slider
    std::function<std::filesystem::path(const Object&)> file; // of a field that names a file; may return none
    std::function<void(Object&, const std::filesystem::path&)> set_file;
};

const std::vector<Field<Scene>>& scene_fields();
const std::vector<Field<Wound>>& wound_fields();
const std::vector<Field<wound::Healing>>& healing_fields();
const std::vector<Field<Light>>& light_fields();
const std::vector<Field<Camera>>& camera_fields();
const std::vector<Field<optics::Shading>>& shading_fields();

/// The field of that name, which must exist.
template <typename Object>
const Field<Object>& field_named(const std::vector<Field<Object>>& fields, std::string_view name);

/// Hashes every field of a wound whose change makes anew what `affects` names, and of its files also when
/// they were last written.
void hash_fields(base::Hash& hash, const Wound& wound, Affects affects);

/// The tables of docs/scene.md by their headings ("scene", "wounds[]", ...), as Markdown.
std::vector<std::pair<std::string, std::string>> field_documentation();

} // namespace scene
