// Builds the entries of scene/field_table.cpp: one function per type of field. An accessor is a generic
// lambda that takes the object, const or not, and returns a reference to the member.
#pragma once
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "scene/field_table.hpp"

namespace scene {

/// Resolves `file` relative to the folder of `scene`; absolute and empty paths are unchanged.
inline std::filesystem::path beside(const std::filesystem::path& scene, const std::string& file)
{
    return file.empty() ? std::filesystem::path{} : scene.parent_path() / file;
}

template <typename Object>
nlohmann::json object_json(const std::vector<Field<Object>>& fields, const Object& object)
{
    nlohmann::json written = nlohmann::json::object();
    for (const Field<Object>& field : fields)
        field.write(written, object);
    return written;
}

inline std::string range_text(const std::string& unit, double low, double high)
{
    return fmt::format("{}{}{} to {}", unit, unit.empty() ? "" : ", ", base::plain(low), base::plain(high));
}

template <typename Object, typename Read, typename Write>
Field<Object> custom(std::string name, std::string range, std::string meaning, Read read, Write write)
{
    Field<Object> field;
    field.name = std::move(name);
    field.range = std::move(range);
    field.meaning = std::move(meaning);
    field.read = std::move(read);
    field.write = std::move(write);
    return field;
}

template <typename Object, typename Accessor>
Field<Object> number(const std::string& name, const std::string& unit, double low, double high, Accessor at,
                     std::string meaning)
{
    Field<Object> field = custom<Object>(
        name, range_text(unit, low, high), std::move(meaning),
        [=](base::Fields& fields, Object& object, Reading&) {
            at(object) = fields.number(name, at(object), low, high);
        },
        [=](nlohmann::json& to, const Object& object) { to[name] = at(object); });
    field.number = [=](Object& object) -> double& { return at(object); };
    return field;
}

/// Three numbers in a std::array or a C array.
template <typename Object, typename Accessor>
Field<Object> numbers(const std::string& name, const std::string& unit, double low, double high, Accessor at,
                      std::string meaning)
{
    return custom<Object>(
        name, "three numbers, " + range_text(unit, low, high), std::move(meaning),
        [=](base::Fields& fields, Object& object, Reading&) {
            auto& values = at(object);
            const auto read = fields.numbers<3>(name, {values[0], values[1], values[2]}, low, high);
            std::ranges::copy(read, std::begin(values));
        },
        [=](nlohmann::json& to, const Object& object) {
            const auto& values = at(object);
            to[name] = {values[0], values[1], values[2]};
        });
}

template <typename Object, typename Accessor>
Field<Object> integer(const std::string& name, std::int64_t low, std::int64_t high, Accessor at,
                      std::string meaning)
{
    return custom<Object>(
        name, fmt::format("{} to {}", low, high), std::move(meaning),
        [=](base::Fields& fields, Object& object, Reading&) {
            using Value = std::remove_reference_t<decltype(at(object))>;
            at(object) = Value(fields.integer(name, std::int64_t(at(object)), low, high));
        },
        [=](nlohmann::json& to, const Object& object) { to[name] = at(object); });
}

template <typename Object, typename Accessor>
Field<Object> boolean(const std::string& name, Accessor at, std::string meaning)
{
    return custom<Object>(
        name, "boolean", std::move(meaning),
        [=](base::Fields& fields, Object& object, Reading&) {
            at(object) = fields.boolean(name, at(object));
        },
        [=](nlohmann::json& to, const Object& object) { to[name] = at(object); });
}

/// One of `names`; the member is a string, or an enum whose values count from 0 in the order of `names`.
template <typename Object, typename Accessor>
Field<Object> choice(const std::string& name, const std::vector<std::string>& names, Accessor at,
                     std::string meaning)
{
    using Value = std::remove_cvref_t<std::invoke_result_t<Accessor, Object&>>;
    constexpr bool text = std::is_same_v<Value, std::string>;
    const auto name_of = [=](const Object& object) {
        if constexpr (text)
            return at(object);
        else
            return names[std::size_t(at(object))];
    };
    return custom<Object>(
        name, fmt::format("`{}`", fmt::join(names, "`, `")), std::move(meaning),
        [=](base::Fields& fields, Object& object, Reading&) {
            const std::string chosen = fields.choice(name, name_of(object), names);
            if constexpr (text)
                at(object) = chosen;
            else
                at(object) = Value(std::ranges::find(names, chosen) - names.begin());
        },
        [=](nlohmann::json& to, const Object& object) { to[name] = name_of(object); });
}

/// A path, relative to the scene's folder.
template <typename Object, typename Accessor>
Field<Object> file(const std::string& name, std::string range, Accessor at, std::string meaning)
{
    Field<Object> field = custom<Object>(
        name, std::move(range), std::move(meaning),
        [=](base::Fields& fields, Object& object, Reading& reading) {
            if (fields.get(name) != nullptr)
                at(object) = beside(reading.file, fields.text(name, ""));
        },
        [=](nlohmann::json& to, const Object& object) { to[name] = at(object).string(); });
    field.file = [=](const Object& object) { return at(object); };
    field.set_file = [=](Object& object, const std::filesystem::path& path) { at(object) = path; };
    return field;
}

/// A preset's name, or a file if it ends in ".json".
inline Field<Scene> tissue_field()
{
    Field<Scene> field = custom<Scene>(
        "tissue", "`table1`, `light`, `medium`, `dark`, or path to `.json`",
        "the skin's layers: a preset ([optics](optics.md)) or a [tissue file](#the-tissue-file)",
        [](base::Fields& fields, Scene& scene, Reading& reading) {
            scene.tissue = fields.text("tissue", scene.tissue);
            if (scene.tissue.ends_with(".json"))
                scene.tissue = beside(reading.file, scene.tissue).string();
        },
        [](nlohmann::json& to, const Scene& scene) { to["tissue"] = scene.tissue; });
    field.file = [](const Scene& scene) {
        return scene.tissue.ends_with(".json") ? std::filesystem::path(scene.tissue)
                                               : std::filesystem::path{};
    };
    field.set_file = [](Scene& scene, const std::filesystem::path& path) { scene.tissue = path.string(); };
    return field;
}

/// Checks rules that involve several fields of one object.
void check_object(base::Fields& fields, const Wound& wound);
void check_object(base::Fields& fields, const Light& light);
template <typename Object>
void check_object(base::Fields&, const Object&)
{
}

template <typename Object>
void read_object(const std::vector<Field<Object>>& table, const nlohmann::json& value,
                 const std::string& where, Object& object, Reading& reading)
{
    base::Fields fields(value, where);
    for (const Field<Object>& field : table)
        field.read(fields, object, reading);
    check_object(fields, object);
    fields.finish();
}

/// A field that is an object with its own table.
template <typename Object, typename Member>
Field<Object> nested(std::string name, const std::vector<Field<Member>>& table, Member Object::*member,
                     std::string meaning, Affects affects = Affects::Photograph)
{
    Field<Object> field = custom<Object>(
        name, "object", std::move(meaning),
        [name, &table, member](base::Fields& fields, Object& object, Reading& reading) {
            if (const nlohmann::json* value = fields.get(name))
                read_object(table, *value, fields.where(name), object.*member, reading);
        },
        [name, &table, member](nlohmann::json& to, const Object& object) {
            to[name] = object_json(table, object.*member);
        });
    field.affects = affects;
    return field;
}

/// A field that is an array of such objects. `fresh` returns the object into which the fields are read.
template <typename Object, typename Member, typename Fresh>
Field<Object> list(std::string name, std::size_t most, const std::vector<Field<Member>>& table,
                   std::vector<Member> Object::*member, std::string meaning, Fresh fresh)
{
    return custom<Object>(
        name, fmt::format("array, at most {}", most), std::move(meaning),
        [=, &table](base::Fields& fields, Object& object, Reading& reading) {
            const nlohmann::json* values = fields.get(name);
            if (values == nullptr)
                return;
            if (!values->is_array() || values->size() > most)
                fields.fail(name, "is " + values->dump().substr(0, 60),
                            fmt::format("give an array of at most {} {}", most, name));
            (object.*member).clear();
            for (std::size_t i = 0; i < values->size(); ++i) {
                Member& made = (object.*member).emplace_back(fresh(reading));
                read_object(table, (*values)[i], fmt::format("{}/{}", fields.where(name), i), made, reading);
            }
        },
        [=, &table](nlohmann::json& to, const Object& object) {
            to[name] = nlohmann::json::array();
            for (const Member& value : object.*member)
                to[name].push_back(object_json(table, value));
        });
}

/// A default value in short form: `0.25`, `[0, 0, 0]`, `"cheek"`.
inline std::string default_text(const nlohmann::json& value)
{
    if (value.is_number())
        return base::plain(value.get<double>());
    if (!value.is_array())
        return value.dump();
    std::vector<std::string> elements;
    for (const nlohmann::json& element : value)
        elements.push_back(default_text(element));
    return fmt::format("[{}]", fmt::join(elements, ", "));
}

/// Sets the default_value of each field from `object`.
template <typename Object>
std::vector<Field<Object>> with_defaults(std::vector<Field<Object>> fields, const Object& object = {})
{
    for (Field<Object>& field : fields) {
        nlohmann::json written;
        field.write(written, object);
        if (field.default_value.empty() && written.size() == 1 && !written.front().is_object())
            field.default_value = fmt::format("`{}`", default_text(written.front()));
    }
    return fields;
}

template <typename Object>
Field<Object> defaulting(Field<Object> field, std::string text)
{
    field.default_value = std::move(text);
    return field;
}

template <typename Object>
Field<Object> affecting(Affects affects, Field<Object> field)
{
    field.affects = affects;
    return field;
}

template <typename Object>
Field<Object> shown_when(std::type_identity_t<std::function<bool(const Object&)>> matters,
                         Field<Object> field)
{
    field.shown_when = std::move(matters);
    return field;
}

template <typename Object>
Field<Object> with_slider(Field<Object> field, Slider slider)
{
    field.slider = std::move(slider);
    return field;
}

} // namespace scene
