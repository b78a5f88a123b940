#include "apps/segmentation/segmentation.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/image_io.hpp"
#include "wound/photo/agreement.hpp"
#include "wound/photo/segmentation.hpp"
#include "wound/prepare.hpp"

namespace segmentation_command {

namespace {

/// Segments the photo with three hints: the mask's bounding box plus a margin of 1/10 of its size on each
/// side, a seed at its centre, and none; prints how well each result agrees with the mask.
void measure_segmentation(const std::string& photo, const std::string& mask)
{
    const cv::Mat3b srgb = base::read_rgb(photo);
    const cv::Mat1b truth = wound::checked_mask(base::read_mask(mask), srgb.size(), mask);
    const cv::Rect bounds = cv::boundingRect(truth);
    const cv::Size margin(bounds.width / 10, bounds.height / 10);
    wound::SegmentationHints rect, seed;
    rect.rect = (bounds - cv::Point(margin) + margin + margin) & cv::Rect(cv::Point(), srgb.size());
    seed.seed = (bounds.tl() + bounds.br()) / 2;
    for (const auto& [name, hints] :
         {std::pair("rectangle", rect), {"seed", seed}, {"no hint", wound::SegmentationHints{}}})
    {
        const cv::Mat1b found = wound::segment(srgb, hints, photo);
        const wound::ContourAgreement fit = wound::agreement(found, truth);
        fmt::print(
            "{:<10} intersection over union {:.3f}; after aligning the centroids {:.3f}, border {:.1f} "
            "px apart, area {:.3f} of the mask's\n",
            name, wound::intersection_over_union(found, truth), fit.intersection_over_union,
            fit.border_distance_px, fit.area_ratio);
    }
}

} // namespace

void add(CLI::App& program)
{
    auto files = std::make_shared<std::pair<std::string, std::string>>();
    CLI::App* command = program.add_subcommand(
        "segmentation", "Compare the wound found in a photograph with a mask drawn by hand");
    command->add_option("photo", files->first, "Photograph of a wound, PNG or JPEG")
        ->required()
        ->type_name("PHOTO");
    command->add_option("mask", files->second, "Mask drawn by hand, white in the wound")
        ->required()
        ->type_name("MASK");
    command->footer("Example: cicatrix segmentation photo.png mask.png");
    command->callback([files] { measure_segmentation(files->first, files->second); });
}

} // namespace segmentation_command
