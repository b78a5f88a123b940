#include "scene/file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "scene/field_builders.hpp"

namespace scene {
using nlohmann::json;

Scene scene_of(const json& root, const std::filesystem::path& path, const std::string& where)
{
    Scene scene;
    Reading reading{path};
    read_object(scene_fields(), root, where + ": ", scene, reading);
    return scene;
}

json to_json(const Scene& scene)
{
    return object_json(scene_fields(), scene);
}

Scene with_files(Scene scene,
                 const std::function<std::filesystem::path(const std::filesystem::path&)>& rename)
{
    const auto rename_in = [&](const auto& fields, auto& object) {
        for (const auto& field : fields)
            if (field.file)
                if (const std::filesystem::path file = field.file(object); !file.empty())
                    field.set_file(object, rename(file));
    };
    rename_in(scene_fields(), scene);
    for (Wound& wound : scene.wounds)
        rename_in(wound_fields(), wound);
    return scene;
}

Scene read_scene(const std::filesystem::path& path)
{
    return scene_of(base::read_json(path), path, path.string());
}

void save_scene(const std::filesystem::path& path, const Scene& scene)
{
    const std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal().parent_path();
    base::write_json(path, to_json(with_files(scene, [&](const std::filesystem::path& file) {
                         const std::filesystem::path whole =
                             std::filesystem::absolute(file).lexically_normal();
                         const std::filesystem::path relative = whole.lexically_relative(folder);
                         return relative.empty() || *relative.begin() == ".." ? whole : relative;
                     })));
}

std::vector<double> parse_days(const std::string& text, const std::string& where)
{
    const std::string cure = "write \"first:last:step\" or days separated by commas, from 0 to 3650";
    const char separator = text.find(':') != std::string::npos ? ':' : ',';
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        double number = 0;
        const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
        if (error != std::errc{} || stop != text.data() + end || !(number >= 0 && number <= 3650))
            throw base::InputError(
                where, "\"" + text + "\" holds no valid day at \"" + text.substr(begin, end - begin) + "\"",
                cure);
        numbers.push_back(number);
        begin = end + 1;
    }
    if (separator == ',')
        return numbers;
    if (numbers.size() != 3 || numbers[1] < numbers[0] || numbers[2] <= 0 ||
        (numbers[1] - numbers[0]) / numbers[2] > 10000)
        throw base::InputError(where, "\"" + text + "\" is not a valid range of days", cure);
    std::vector<double> days;
    for (int i = 0; numbers[0] + i * numbers[2] <= numbers[1] + 1e-9 * numbers[2]; ++i)
        days.push_back(numbers[0] + i * numbers[2]);
    return days;
}

std::array<std::uint32_t, 2> parse_size(const std::string& text, const std::string& where)
{
    std::array<std::uint32_t, 2> size{};
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size[0]);
    const bool cross = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
    const auto height = cross ? std::from_chars(width.ptr + 1, end, size[1]) : width;
    if (!cross || height.ec != std::errc{} || height.ptr != end ||
        std::ranges::any_of(size, [](auto s) { return s < 16 || s > 16384; }))
        throw base::InputError(where, "\"" + text + "\" is not a valid picture size",
                               "write WIDTHxHEIGHT, each from 16 to 16384, as in 1280x720");
    return size;
}

json numbers_of(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

} // namespace scene
