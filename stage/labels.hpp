// What `cicatrix capture --labels` writes beside the pictures: images, labels.json and coco.json. What each
// holds, with its units and conventions: docs/labels.md.
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

/// A picture's labels, drawn whole or by tiles as the picture itself, and pixel by pixel where it is.
struct DrawnLabels
{
    cv::Mat picture; // RGB
    passes::LabelMaps maps;
    std::shared_ptr<const std::vector<wound::WoundDay>> wounds; // on the shot's day
    std::vector<passes::VisibleWound> visible;                  // one per wound, as `sizes`
    std::vector<passes::WoundSize> sizes;
};
DrawnLabels draw_labels(Renderer& renderer, const Stage& stage, const scene::Shot& shot,
                        const DrawOptions& options);

class LabelFiles
{
  public:
    /// `folder` must exist; `tile` as in DrawOptions.
    LabelFiles(Renderer& renderer, std::filesystem::path folder, std::uint32_t tile);

    /// Draws and writes a picture's label images. `entry` is its entry in capture.json: day, file and camera
    /// are copied from it, and the names of the images are added to it as "labels".
    void add(const Stage& stage, const scene::Shot& shot, nlohmann::json& entry);
    /// Writes labels.json, coco.json and labels.png, the page that shows them. Throws base::InputError
    /// when something could not be written.
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
