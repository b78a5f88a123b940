#include "stage/coco.hpp"

#include <opencv2/imgproc.hpp>

namespace stage {
using nlohmann::json;

json run_lengths(const cv::Mat1b& mask)
{
    json counts = json::array();
    bool inside = false;
    std::int64_t run = 0;
    for (int x = 0; x < mask.cols; ++x)
        for (int y = 0; y < mask.rows; ++y) {
            if ((mask(y, x) != 0) != inside) {
                counts.push_back(run);
                run = 0;
                inside = !inside;
            }
            ++run;
        }
    counts.push_back(run);
    return {{"size", {mask.rows, mask.cols}}, {"counts", counts}};
}

int Coco::add_image(const std::string& file_name, cv::Size size, const json& attributes)
{
    json image = attributes;
    const int id = int(images_.size()) + 1;
    image.update({{"id", id}, {"file_name", file_name}, {"width", size.width}, {"height", size.height}});
    images_.push_back(std::move(image));
    return id;
}

void Coco::add_region(int image, CocoCategory category, const cv::Mat1b& mask, const json& attributes)
{
    const int area = cv::countNonZero(mask);
    if (area == 0)
        return;
    const cv::Rect box = cv::boundingRect(mask);
    json region = attributes;
    region.update({{"id", regions_.size() + 1},
                   {"image_id", image},
                   {"category_id", int(category)},
                   {"segmentation", run_lengths(mask)},
                   {"area", area},
                   {"bbox", {box.x, box.y, box.width, box.height}},
                   {"iscrowd", 0}});
    regions_.push_back(std::move(region));
}

void Coco::join(const json& document, const std::string& folder)
{
    const std::size_t images = images_.size(); // ids start at 1 in every document
    for (json image : document.at("images")) {
        image["id"] = image.at("id").get<std::size_t>() + images;
        image["file_name"] = folder + "/" + image.at("file_name").get<std::string>();
        images_.push_back(std::move(image));
    }
    for (json region : document.at("annotations")) {
        region["id"] = regions_.size() + 1;
        region["image_id"] = region.at("image_id").get<std::size_t>() + images;
        regions_.push_back(std::move(region));
    }
}

json Coco::document() const
{
    const auto category = [](CocoCategory id, const char* name) {
        return json{{"id", int(id)}, {"name", name}, {"supercategory", "wound"}};
    };
    return {{"info", {{"description", "Rendered by Cicatrix"}}},
            {"images", images_},
            {"annotations", regions_},
            {"categories",
             {category(CocoCategory::Wound, "wound"), category(CocoCategory::OpenBed, "open_bed"),
              category(CocoCategory::NewEpithelium, "new_epithelium")}}};
}

} // namespace stage
