// The tables of docs/scene.md.
#include <fmt/format.h>

#include "scene/field_table.hpp"

namespace scene {
namespace {

template <typename Object>
void append_documentation(std::vector<std::pair<std::string, std::string>>& tables, const char* heading,
                          const std::vector<Field<Object>>& fields)
{
    std::string table = "| field | unit, range | default | meaning |\n|---|---|---|---|\n";
    for (const Field<Object>& field : fields)
        table += fmt::format("| `{}` | {} | {} | {} |\n", field.name, field.range, field.default_value,
                             field.meaning);
    tables.emplace_back(heading, std::move(table));
}

} // namespace

std::vector<std::pair<std::string, std::string>> field_documentation()
{
    std::vector<std::pair<std::string, std::string>> tables;
    append_documentation(tables, "scene", scene_fields());
    append_documentation(tables, "wounds[]", wound_fields());
    append_documentation(tables, "healing", healing_fields());
    append_documentation(tables, "lights[]", light_fields());
    append_documentation(tables, "camera", camera_fields());
    append_documentation(tables, "shading", shading_fields());
    return tables;
}

} // namespace scene
