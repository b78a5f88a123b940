// What the figures share: the options, the device and the scenes, each made when a figure first needs it, and
// the writing of files.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/canvas.hpp"
#include "base/contact_sheet.hpp"
#include "base/progress.hpp"
#include "scene/command_line.hpp"
#include "scene/loaded_scene.hpp"
#include "stage/renderer.hpp"

namespace figure_command {

/// Used of SceneOptions: head, wound and mask, size, device, validation.
struct FigureOptions : scene::SceneOptions
{
    std::vector<std::string> names; // of figures; empty: all
    std::filesystem::path out = "out/figures";
    int cell = base::sheet_cell_width; // px, width of each picture on a sheet
    int frames = 60;                   // that frame-rate measures of each case
};

enum class Equations
{
    Published, // the paper's
    Corrected, // the program's default
};

class Workbench
{
  public:
    Workbench(const FigureOptions& options, base::Progress& progress) : options_(options), progress_(progress)
    {
    }

    const FigureOptions& options() const { return options_; }
    base::Progress& progress() { return progress_; }

    /// scenes/NAME.json with the command's head, lit by paper_light() from `light`. The command's photograph
    /// replaces the wound of scenes/cheek.json. Throws base::InputError.
    scene::Scene scene(const std::string& name, Equations equations,
                       const scene::Direction& light = {15, 20}) const;
    /// scene("cheek", Published), loaded without a device.
    const scene::LoadedScene& cheek();
    stage::Renderer& renderer();
    bool has_renderer() const { return renderer_ != nullptr; }

    /// The scene on the device, until the next call; scenes share what they have in common. Throws
    /// base::InputError.
    stage::Stage& showing(const scene::Scene& scene);

    /// A square picture of the stage's scene, twice as wide as a sheet's cell.
    cv::Mat3b picture(const stage::Stage& stage, const head::Camera& camera, double day);
    /// A cell of a sheet, from pictures of any size.
    base::SheetCell cell(const cv::Mat3b& picture, const std::string& label,
                         const cv::Mat3b& close_up = {}) const;

    void write_picture(const std::string& stem, const cv::Mat3b& picture);
    /// Writes the same drawing as SVG and as PNG.
    void write_drawing(const std::string& stem, cv::Size size, const std::string& description,
                       const std::function<void(base::Canvas&)>& draw);
    void write_json(const std::string& stem, const nlohmann::json& json);

    /// Adds a line that is printed and shown below the figure.
    void say(const std::string& line) { lines_.push_back(line); }

    /// The files and lines since the last call.
    struct Output
    {
        std::vector<std::string> files, lines;
    };
    Output take_output();

  private:
    const FigureOptions& options_;
    base::Progress& progress_;
    std::unique_ptr<scene::LoadedScene> cheek_;
    std::unique_ptr<stage::Renderer> renderer_;
    std::unique_ptr<stage::Stage> stage_; // after the renderer: destroyed before it
    std::vector<std::string> files_, lines_;
};

/// The light of the paper's section 6.3: white, without falloff, at the paper's distance.
scene::Light paper_light(const scene::Direction& from);

} // namespace figure_command
