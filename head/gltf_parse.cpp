#include "head/gltf_parse.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <string_view>

#include "base/file.hpp"
#include "base/input_error.hpp"

namespace head {
namespace {

constexpr std::size_t max_file = std::size_t{1} << 30; // bytes
constexpr int max_depth = 64;                          // JSON nesting: the parser is recursive
constexpr std::size_t max_objects = 200'000;           // JSON objects: each may take 0.5 kB of memory or more
constexpr std::size_t max_values = 5'000'000;

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view what,
                         std::string_view cure = "export the model again as glTF 2.0 binary (.glb)")
{
    throw base::InputError(path.string(), what, cure);
}

/// Rejects JSON that could exhaust the parser's stack or memory.
void check_json_size(const std::filesystem::path& path, std::string_view json)
{
    int depth = 0;
    std::size_t objects = 0, values = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
            continue;
        }
        in_string = c == '"';
        objects += c == '{';
        values += c == ',';
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        if (depth > max_depth || objects > max_objects || values > max_values)
            refuse(path, "its JSON is nested too deeply or too long");
    }
}

/// The JSON of a .glb. Checks the container's lengths, because tinygltf 2.7 reads 8 bytes past a truncated
/// BIN chunk.
std::string_view json_of_container(const std::filesystem::path& path, std::string_view bytes)
{
    const auto word = [&](std::size_t at) {
        std::uint32_t value;
        std::memcpy(&value, bytes.data() + at,
                    sizeof value); // little-endian, like all supported machines
        return std::size_t{value};
    };
    if (bytes.size() < 20)
        refuse(path, "the file is cut short", "copy or export it again");
    if (word(4) != 2)
        refuse(path, fmt::format("is version {} of binary glTF", word(4)));
    const std::size_t length = word(8), json_length = word(12);
    if (length > bytes.size())
        refuse(path, fmt::format("the file is cut short: {} bytes of {}", bytes.size(), length),
               "copy or export it again");
    if (length < 20 || json_length > length - 20)
        refuse(path, "its JSON chunk reaches beyond the end of the file");
    const std::size_t next = 20 + json_length;
    if (next != length && (length - next < 8 || word(next) > length - next - 8))
        refuse(path, "its binary chunk reaches beyond the end of the file");
    return bytes.substr(20, json_length);
}

/// User data of tinygltf's file callbacks: the only folder that may be read, and the first error.
struct Folder
{
    std::filesystem::path file, folder;
    std::optional<base::InputError> problem;
};

bool external_file_exists(const std::string& name, void* user)
{
    Folder& context = *static_cast<Folder*>(user);
    if (!name.starts_with(context.folder.string() + "/"))
        return false; // tinygltf also tries the working folder
    std::error_code error;
    const auto found = std::filesystem::weakly_canonical(name, error);
    const auto folder = std::filesystem::weakly_canonical(context.folder, error);
    const auto relative = found.lexically_relative(folder);
    if (error || relative.empty() || *relative.begin() == "..") {
        if (!context.problem)
            context.problem.emplace(context.file.string(),
                                    fmt::format("refers to {}, outside its own folder", name),
                                    "put all its files into one folder, or export it as .glb");
        return false;
    }
    return std::filesystem::is_regular_file(found, error);
}

bool read_external_file(std::vector<unsigned char>* bytes, std::string*, const std::string& name, void* user)
{
    Folder& context = *static_cast<Folder*>(user);
    try {
        *bytes = base::read_file(name, max_file);
        return true;
    } catch (const base::InputError& problem) {
        if (!context.problem)
            context.problem = problem;
        return false;
    }
}

/// Stores the encoded bytes of an external picture. Skips a picture in a buffer view, because the view's
/// range is not checked yet.
bool keep_picture(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*)
{
    if (image->bufferView < 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

void check_extensions(const std::filesystem::path& path, const tinygltf::Model& gltf)
{
    // Transforms and quantised numbers are supported; material extensions do not affect this renderer's
    // shading.
    constexpr std::array known = {"KHR_texture_transform", "KHR_mesh_quantization"};
    for (const std::string& extension : gltf.extensionsRequired) {
        if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression")
            refuse(path, fmt::format("is compressed ({})", extension),
                   "export the model without compression");
        const bool material =
            extension.starts_with("KHR_materials_") && extension != "KHR_materials_pbrSpecularGlossiness";
        if (!material && std::find(known.begin(), known.end(), extension) == known.end())
            refuse(path, fmt::format("requires the glTF extension {}, which is not supported", extension),
                   "export the model without it");
    }
}

} // namespace

tinygltf::Model parse_gltf(const std::filesystem::path& path)
{
    const auto bytes = base::read_file(path, max_file);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool binary = text.starts_with("glTF");
    const std::string_view json = binary ? json_of_container(path, text) : text;
    if (!binary && json.find('{') == std::string_view::npos)
        refuse(path, "is not a glTF file", "use a .glb or .gltf file");
    check_json_size(path, json);

    Folder context{path, path.has_parent_path() ? path.parent_path() : ".", std::nullopt};
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({external_file_exists, [](const std::string& name, void*) { return name; },
                           read_external_file, tinygltf::WriteWholeFile, &context});
    parser.SetImageLoader(keep_picture, nullptr);
    tinygltf::Model gltf;
    std::string errors, warnings;
    bool parsed = false;
    try {
        const auto size = static_cast<unsigned>(bytes.size());
        parsed = binary ? parser.LoadBinaryFromMemory(&gltf, &errors, &warnings, bytes.data(), size,
                                                      context.folder.string())
                        : parser.LoadASCIIFromString(&gltf, &errors, &warnings, text.data(), size,
                                                     context.folder.string());
    } catch (const std::exception& exception) {
        errors = exception.what();
    }
    if (context.problem)
        throw *context.problem;
    if (!parsed || !errors.empty()) {
        std::string reason = errors.empty() ? "unknown error" : errors.substr(0, errors.find('\n'));
        // The error may quote bytes of the file.
        std::erase_if(reason, [](unsigned char c) { return c < 0x20 || c >= 0x7f; });
        refuse(path, fmt::format("is not a valid glTF file ({})", reason.substr(0, 200)));
    }
    if (!gltf.asset.version.starts_with("2"))
        refuse(path, fmt::format("/asset/version is \"{}\"", gltf.asset.version.substr(0, 16)));
    check_extensions(path, gltf);
    return gltf;
}

} // namespace head
