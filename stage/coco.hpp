// Annotations in COCO's format (cocodataset.org/#format-data), one document per capture; documents can be
// joined. Masks are uncompressed run lengths: alternating runs of 0 and 1, starting with 0, column by column.
#pragma once
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>

namespace stage {

/// {"size": [height, width], "counts": [...]} of the non-zero pixels.
nlohmann::json run_lengths(const cv::Mat1b& mask);

/// The categories. `Wound` is everything inside the outer border: the union of the other two.
enum class CocoCategory : int
{
    Wound = 1,
    OpenBed = 2,
    NewEpithelium = 3,
};

class Coco
{
  public:
    /// `attributes`: additional fields of the image. Returns the image's id.
    int add_image(const std::string& file_name, cv::Size size, const nlohmann::json& attributes);
    /// Adds one region of an image unless the mask is empty. `attributes`: additional fields of the region.
    void add_region(int image, CocoCategory category, const cv::Mat1b& mask,
                    const nlohmann::json& attributes);
    /// Appends another document with pictures in `folder`, and renumbers its ids.
    void join(const nlohmann::json& document, const std::string& folder);
    nlohmann::json document() const;

  private:
    nlohmann::json images_ = nlohmann::json::array(), regions_ = nlohmann::json::array();
};

} // namespace stage
