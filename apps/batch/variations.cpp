#include "apps/batch/variations.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

#include "base/file.hpp"
#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "base/text.hpp"
#include "head/default_head.hpp"
#include "scene/file.hpp"
#include "wound/optics/tissue_choice.hpp"

namespace batch_command {
namespace {
using nlohmann::json;
using Row = std::vector<std::string>;

/// Parses CSV (RFC 4180): cells in double quotes may contain commas, line ends and doubled quotes. Empty rows
/// are skipped. `lines` receives the first line of each row.
std::vector<Row> parse_csv(const std::string& text, const std::string& where, std::vector<std::size_t>& lines)
{
    std::vector<Row> rows;
    Row row(1);
    std::size_t line = 1, begin = 1;
    bool quoted = false, any = false;
    const auto end_row = [&] {
        if (any) {
            rows.push_back(row);
            lines.push_back(begin);
        }
        row.assign(1, "");
        any = false;
    };
    for (std::size_t i = text.starts_with("\xef\xbb\xbf") ? 3 : 0; i < text.size(); ++i) {
        const char c = text[i];
        line += c == '\n';
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            row.back() += text[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && c == ',')
            row.emplace_back();
        else if (!quoted && c == '\n') {
            end_row();
            begin = line;
        } else if (quoted || (c != '\r' && (c != ' ' || !row.back().empty())))
            row.back() += c;
        any = any || (c != '\n' && c != '\r' && c != ' ');
    }
    if (quoted)
        throw base::InputError(fmt::format("{}: line {}", where, begin), "has an unclosed quote",
                               "close it, or double it inside a cell");
    end_row();
    for (Row& cells : rows)
        for (std::string& cell : cells)
            cell.erase(cell.find_last_not_of(' ') + 1);
    return rows;
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// The field of `scene` that a column names; an index one past the last wound or light appends one.
json& field_of(json& scene, const std::string& column, const std::string& where)
{
    json* here = &scene;
    for (const std::string& part : split(column, '.')) {
        if (here->is_null())
            *here = json::object();
        if (here->is_object() && !part.empty()) {
            here = &(*here)[part];
            continue;
        }
        std::size_t index = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
        if (!here->is_array() || error != std::errc{} || end != part.data() + part.size())
            throw base::InputError(where, fmt::format("\"{}\" is not a field of a scene", column),
                                   "write it as in wounds.0.width_mm; docs/scene.md lists the fields");
        if (index > here->size())
            throw base::InputError(
                where, fmt::format("index {} is out of range after {} entries", index, here->size()),
                "use consecutive indices from 0");
        if (index == here->size())
            here->push_back(json::object());
        here = &(*here)[index];
    }
    return *here;
}

/// Parses a cell as JSON (a number, an array ...); other cells are text.
json value_of(const std::string& cell, const std::string& where)
{
    base::check_json_depth(cell, where);
    json value = json::parse(cell, nullptr, false);
    return value.is_discarded() ? json(cell) : value;
}

/// Erases fields of the base scene that a new photograph or a new table of areas replaces.
void erase_replaced_fields(json& scene, const std::string& column, const std::string& where)
{
    const auto drop = [&](const char* tail, std::initializer_list<const char*> fields) {
        if (!column.starts_with("wounds.") || !column.ends_with(tail))
            return;
        json& parent = field_of(scene, column.substr(0, column.rfind('.')), where);
        for (const char* field : fields)
            if (parent.is_object())
                parent.erase(field);
    };
    drop(".photo", {"mask", "segmentation"});
    drop(".healing.areas", {"gamma", "delta", "theta"});
}

/// The scene as JSON with every field and with absolute paths, so that a table in another folder can use it.
json spelled_out(scene::Scene scene)
{
    const auto absolute = [](std::filesystem::path& path) {
        if (!path.empty())
            path = std::filesystem::absolute(path);
    };
    absolute(scene.head);
    for (scene::Wound& wound : scene.wounds) {
        absolute(wound.photo);
        absolute(wound.mask);
    }
    if (scene.tissue.ends_with(".json"))
        scene.tissue = std::filesystem::absolute(scene.tissue).string();
    return scene::to_json(scene);
}

/// Throws the error `message` again with `where` as its location.
[[noreturn]] void rethrow(const std::string& where, const std::string& message)
{
    const std::size_t remedy = message.rfind("; ");
    throw base::InputError(where, message.substr(0, remedy),
                           remedy == std::string::npos ? "correct it" : message.substr(remedy + 2));
}

/// Reads the scene; errors name the column: "ROW: /wounds/0/width_mm: is 900" becomes
/// "ROW, column wounds.0.width_mm: is 900".
scene::Scene checked_scene(const json& scene, const std::filesystem::path& path, const std::string& where)
{
    try {
        return scene::scene_of(scene, path, where);
    } catch (const base::InputError& error) {
        const std::string message = error.what(), begin = where + ": /";
        if (!message.starts_with(begin))
            rethrow(where, message);
        const std::size_t end = message.find(": ", begin.size());
        std::string column = message.substr(begin.size(), end - begin.size());
        std::ranges::replace(column, '/', '.');
        rethrow(fmt::format("{}, column {}", where, column),
                end == std::string::npos ? message : message.substr(end + 2));
    }
}

void check_name(const std::string& name, const std::string& where, std::set<std::string>& known)
{
    const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.'; };
    if (name.empty() || name.size() > 100 || name[0] == '.' || !std::ranges::all_of(name, fits))
        throw base::InputError(where, "\"" + name + "\" is not a valid folder name",
                               "use letters, digits, - and _");
    if (!known.insert(name).second)
        throw base::InputError(where, "\"" + name + "\" occurs twice", "give every variation its own name");
}

std::vector<Variation> read_table(const std::filesystem::path& path, const scene::Scene& base)
{
    const std::vector<std::uint8_t> bytes = base::read_file(path, 256u << 20);
    std::vector<std::size_t> lines;
    const std::vector<Row> rows = parse_csv({bytes.begin(), bytes.end()}, path.string(), lines);
    if (rows.size() < 2)
        throw base::InputError(path.string(), "holds no variations",
                               "write a header such as name,wounds.0.width_mm and a row per variation");
    const Row& header = rows.front();
    std::set<std::string> names, columns;
    for (const std::string& column : header)
        if (!columns.insert(column).second)
            throw base::InputError(path.string(), "column \"" + column + "\" occurs twice", "remove one");

    const json spelled = spelled_out(base);
    std::vector<Variation> variations;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        Variation variation{fmt::format("{:04}", i), fmt::format("{}: line {}", path.string(), lines[i]), {}};
        if (rows[i].size() != header.size())
            throw base::InputError(variation.where,
                                   fmt::format("has {} cells, the header {}", rows[i].size(), header.size()),
                                   "give one per column; quote cells that hold commas");
        json scene = spelled;
        for (std::size_t k = 0; k < header.size(); ++k) // before the other columns
            if (header[k] == "scene" && !rows[i][k].empty())
                scene = spelled_out(scene::read_scene(path.parent_path() / rows[i][k]));
        for (std::size_t k = 0; k < header.size(); ++k) {
            const std::string &column = header[k], &cell = rows[i][k];
            const std::string where = fmt::format("{}, column {}", variation.where, column);
            if (!base::is_utf8(cell))
                throw base::InputError(where, "is not UTF-8", "save the table as UTF-8");
            if (column == "scene" || cell.empty())
                continue;
            if (column == "name") {
                variation.name = cell;
                continue;
            }
            erase_replaced_fields(scene, column, where);
        }
        for (std::size_t k = 0; k < header.size(); ++k)
            if (header[k] != "scene" && header[k] != "name" && !rows[i][k].empty()) {
                const std::string where = fmt::format("{}, column {}", variation.where, header[k]);
                field_of(scene, header[k], where) = value_of(rows[i][k], where);
            }
        check_name(variation.name, variation.where + ", column name", names);
        variation.scene = checked_scene(scene, path, variation.where);
        variations.push_back(std::move(variation));
    }
    return variations;
}

std::vector<Variation> read_folder(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    if (files.empty())
        throw base::InputError(folder.string(), "holds no scenes", "put .json files there (docs/scene.md)");
    std::ranges::sort(files); // so that all shares use the same order
    std::vector<Variation> variations;
    std::set<std::string> names;
    for (const std::filesystem::path& file : files) {
        check_name(file.stem().string(), file.string(), names);
        variations.push_back({file.stem().string(), file.string(), scene::read_scene(file)});
    }
    return variations;
}

} // namespace

std::vector<Variation> read_variations(const std::filesystem::path& path, const scene::Scene& base)
{
    return std::filesystem::is_directory(path) ? read_folder(path) : read_table(path, base);
}

void check_files(const Variation& variation)
{
    const scene::Scene& scene = variation.scene;
    const auto needs = [&](const std::filesystem::path& file, const std::string& column) {
        if (!file.empty() && !std::filesystem::is_regular_file(file))
            throw base::InputError(fmt::format("{}, column {}", variation.where, column),
                                   fmt::format("there is no file {}", file.string()),
                                   "name one relative to the table's folder");
    };
    needs(scene.head.empty() ? head::default_head_path() : scene.head, "head");
    for (std::size_t i = 0; i < scene.wounds.size(); ++i) {
        const scene::Wound& wound = scene.wounds[i];
        needs(wound.photo, fmt::format("wounds.{}.photo", i));
        needs(wound.mask, fmt::format("wounds.{}.mask", i));
        if (const auto* place = std::get_if<std::string>(&wound.place);
            place != nullptr && !head::known_face_point(*place))
            throw base::InputError(fmt::format("{}, column wounds.{}.at", variation.where, i),
                                   "\"" + *place + "\" is not a known place",
                                   "use cheek, eyebrow, chin, forehead, nose, or \"[x, y]\"");
    }
    try {
        optics::healing_tissue_or_file(scene.tissue);
    } catch (const base::InputError& error) {
        rethrow(variation.where + ", column tissue", error.what());
    }
}

std::vector<std::size_t> share_of(std::size_t count, std::size_t share, std::size_t shares)
{
    std::vector<std::size_t> mine;
    for (std::size_t i = share - 1; i < count; i += shares)
        mine.push_back(i);
    return mine;
}

} // namespace batch_command
