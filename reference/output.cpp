#include "reference/output.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/exr.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/machine.hpp"
#include "base/tone_curve.hpp"
#include "scene/file.hpp"

namespace reference {
namespace {
using nlohmann::json;

json levels_json(const Levels& levels)
{
    return {{"shadows", levels.shadows},   {"bounces", levels.bounces},
            {"ambient", levels.ambient},   {"subsurface", levels.subsurface},
            {"specular", levels.specular}, {"anisotropy", levels.medium.anisotropy},
            {"index", levels.medium.index}};
}

void write_exr(const std::filesystem::path& path, const Picture& picture)
{
    cv::Mat layers[] = {picture.radiance(), picture.diffuse(), picture.specular(), picture.diffuse_error(),
                        picture.specular_error()};
    const char* names[] = {"", "diffuse", "specular", "diffuse_error", "specular_error"};
    std::vector<base::ExrChannel> channels;
    for (std::size_t i = 0; i < std::size(layers); ++i)
        std::ranges::copy(base::exr_channels(names[i], layers[i]), std::back_inserter(channels));
    base::write_exr_channels(path, picture.size(), channels, {{"samples", picture.samples()}});
}

json truth_json(const scene::LoadedScene& scene, const Request& request, const Truth& truth)
{
    return {{"samples", truth.picture.samples()},
            {"noise_de", std::isfinite(truth.noise_de) ? json(truth.noise_de) : json(nullptr)},
            {"cpu_seconds", truth.cpu_seconds},
            {"interrupted", truth.interrupted},
            {"day", request.day},
            {"size", request.size},
            {"camera",
             {{"eye_m", scene::numbers_of(request.camera.eye)},
              {"target_m", scene::numbers_of(request.camera.target)},
              {"fov_deg", request.camera.fov_deg}}},
            {"seed", request.seed},
            {"levels", levels_json(request.levels)},
            {"tissue", truth.skin ? json(*truth.skin) : json(nullptr)},
            {"program", base::program_json()},
            {"scene", scene::to_json(scene.scene)}};
}

} // namespace

void write_truth(const std::filesystem::path& folder, const scene::LoadedScene& scene, const Request& request,
                 const Truth& truth)
{
    base::make_folder(folder);
    write_exr(folder / "reference.exr", truth.picture);
    base::write_png(folder / "reference.png",
                    base::encode_picture(truth.picture.radiance(), scene.scene.exposure_stops));
    base::write_json(folder / "reference.json", truth_json(scene, request, truth));
}

} // namespace reference
