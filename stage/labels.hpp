// Writes the files of `cicatrix capture --labels`: label images, labels.json and coco.json. docs/labels.md
// defines their contents, units and conventions.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/contact_sheet.hpp"
#include "base/writers.hpp"
#include "passes/labels.hpp"
#include "stage/coco.hpp"
#include "stage/renderer.hpp"

namespace stage {

/// The labels of a picture, aligned with its pixels.
struct DrawnLabels
{
    cv::Mat picture; // RGB
    passes::LabelMaps maps;
    std::shared_ptr<const std::vector<wound::WoundDay>> wounds; // on the shot's day
    std::vector<passes::VisibleWound> visible;                  // one per wound, like `sizes`
    std::vector<passes::WoundSize> sizes;
};
/// Draws the labels whole or in tiles, like the picture.
DrawnLabels draw_labels(Renderer& renderer, const Stage& stage, const scene::Shot& shot,
                        const DrawOptions& options);

class LabelFiles
{
  public:
    /// `folder` must exist; `tile` as in DrawOptions.
    LabelFiles(Renderer& renderer, std::filesystem::path folder, std::uint32_t tile);

    /// Draws and writes a picture's label images. `entry` is the picture's entry in capture.json: add()
    /// copies file, camera and turn from it and adds the names of the images as "labels".
    void add(const Stage& stage, const scene::Shot& shot, nlohmann::json& entry);
    /// Writes labels.json, coco.json and the overview labels.png. Throws base::InputError when a file cannot
    /// be written.
    void finish();

  private:
    nlohmann::json write_images(const std::string& name, const passes::LabelMaps& maps);

    Renderer& renderer_;
    const std::filesystem::path folder_;
    const std::uint32_t tile_;
    nlohmann::json frames_ = nlohmann::json::array();
    Coco coco_;
    std::vector<base::SheetCell> cells_;
    base::Writers writers_;
};

} // namespace stage
