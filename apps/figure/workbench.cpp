#include "apps/figure/workbench.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"

namespace figure_command {
namespace {

/// scenes/ of the checkout or the installation to which the running program belongs.
std::filesystem::path scenes_folder()
{
    std::error_code ignored;
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const char* place : {"../scenes", "../share/cicatrix/scenes"})
        if (const auto folder = (program / place).lexically_normal();
            std::filesystem::exists(folder / "cheek.json"))
            return folder;
    throw base::InputError((program / "../scenes").lexically_normal().string(),
                           "the scenes of the figures are not there",
                           "run the program from build/ of a checkout, or install it");
}

} // namespace

scene::Light paper_light(const scene::Direction& from)
{
    return {.from = from, .distance_m = scene::published_light_distance_m, .falloff = false};
}

scene::Scene Workbench::scene(const std::string& name, Equations equations,
                              const scene::Direction& light) const
{
    scene::SceneOptions chosen = options_;
    chosen.scene = (scenes_folder() / (name + ".json")).string();
    chosen.mode = equations == Equations::Published ? "published" : "corrected";
    if (name != "cheek")
        chosen.wound = chosen.mask = "";
    scene::Scene scene = scene::chosen_scene(chosen);
    scene.lights = {paper_light(light)};
    return scene;
}

const scene::LoadedScene& Workbench::cheek()
{
    if (!cheek_)
        cheek_ = std::make_unique<scene::LoadedScene>(scene::load(scene("cheek", Equations::Published)));
    return *cheek_;
}

stage::Renderer& Workbench::renderer()
{
    if (!renderer_)
        renderer_ = std::make_unique<stage::Renderer>(stage::device_options(options_));
    return *renderer_;
}

stage::Stage& Workbench::showing(const scene::Scene& scene)
{
    if (!stage_) {
        stage_ = std::make_unique<stage::Stage>(renderer().device, stage::Stage::prepare(scene));
    } else {
        stage_->update(scene);
        stage_->wait_until_complete();
    }
    return *stage_;
}

cv::Mat3b Workbench::picture(const stage::Stage& stage, const head::Camera& camera, double day)
{
    const auto side = std::uint32_t(2 * options_.cell);
    const scene::Shot shot{.day = day, .view = "", .camera = camera, .name = "figure"};
    return stage::draw(renderer(), stage, shot, {.size = {side, side}, .areas = false}).picture;
}

base::SheetCell Workbench::cell(const cv::Mat3b& picture, const std::string& label,
                                const cv::Mat3b& close_up) const
{
    base::SheetCell cell{base::sheet_picture(picture, options_.cell), {}, label};
    if (!close_up.empty())
        cell.close_up = base::sheet_picture(close_up, options_.cell);
    return cell;
}

void Workbench::write_picture(const std::string& stem, const cv::Mat3b& picture)
{
    base::write_png(options_.out / (stem + ".png"), picture);
    files_.push_back(stem + ".png");
}

void Workbench::write_drawing(const std::string& stem, cv::Size size, const std::string& description,
                              const std::function<void(base::Canvas&)>& draw)
{
    base::SvgCanvas svg(size, description, base::SvgUse::StandAlone);
    draw(svg);
    base::write_text(options_.out / (stem + ".svg"), svg.finished());
    files_.push_back(stem + ".svg");
    cv::Mat3b picture(size, base::rgb_of(base::palette::white));
    base::PictureCanvas canvas(picture);
    draw(canvas);
    write_picture(stem, picture);
}

void Workbench::write_json(const std::string& stem, const nlohmann::json& json)
{
    base::write_json(options_.out / (stem + ".json"), json);
    files_.push_back(stem + ".json");
}

Workbench::Output Workbench::take_output()
{
    return {std::exchange(files_, {}), std::exchange(lines_, {})};
}

} // namespace figure_command
