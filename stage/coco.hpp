// Annotations in COCO's format (cocodataset.org/#format-data): one document per capture, and joining many.
// Masks are run-length encoded, uncompressed: runs of 0 and 1 in turn, beginning with 0, down the columns.
#pragma once
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>

namespace stage {

/// {"size": [height, width], "counts": [...]} of the pixels that are not 0.
nlohmann::json run_lengths(const cv::Mat1b& mask);

/// The kinds of annotation. `Wound` is all inside the outer border: the other two together.
enum class CocoCategory : int
{
    Wound = 1,
    OpenBed = 2,
    NewEpithelium = 3,
};

class Coco
{
  public:
    /// `attributes`: further fields of the image. Returns its id.
    int add_image(const std::string& file_name, cv::Size size, const nlohmann::json& attributes);
    /// One region of an image; nothing when the mask is empty. `attributes` as for images.
    void add_region(int image, CocoCategory category, const cv::Mat1b& mask,
                    const nlohmann::json& attributes);
    /// Appends another document, whose pictures lie in `folder`, with ids of its own.
    void join(const nlohmann::json& document, const std::string& folder);
    nlohmann::json document() const;

  private:
    nlohmann::json images_ = nlohmann::json::array(), regions_ = nlohmann::json::array();
};

} // namespace stage
