#include "apps/wound_measurements.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/warp_cost.hpp"
#include "engine/image_io.hpp"
#include "wound/agreement.hpp"
#include "wound/prepare.hpp"
#include "wound/segmentation.hpp"
#include "wound/warp_ladder.hpp"

namespace app {

namespace {

/// The border of a mask, named after its file.
wound::LadderShape shape_of(const std::string& file)
{
    wound::Photograph photograph;
    photograph.mask = engine::read_mask(file);
    photograph.srgb = cv::Mat3b(photograph.mask.size(), cv::Vec3b(128, 128, 128));
    wound::Preparation preparation;
    preparation.where = file;
    const wound::PreparedWound prepared = wound::prepare(photograph, preparation);
    return {std::filesystem::path(file).stem().string(), prepared.border, prepared.centroid};
}

/// The drawn shapes and those of the masks.
void measure_warps(const std::vector<std::string>& masks, const std::filesystem::path& out)
{
    std::vector<wound::LadderShape> shapes = wound::ladder_shapes();
    for (const std::string& file : masks) {
        wound::LadderShape shape = shape_of(file);
        if (std::ranges::find(shapes, shape.name, &wound::LadderShape::name) != shapes.end())
            shape.name = file;
        shapes.push_back(shape);
    }
    make_folder(out);
    std::vector<wound::LadderRow> rows;
    {
        Progress progress;
        progress.expect(shapes.size());
        for (const wound::LadderShape& shape : shapes) {
            progress.show(shape.name);
            const std::vector<wound::LadderRow> own = wound::measure_ladder(shape);
            rows.insert(rows.end(), own.begin(), own.end());
            progress.step();
        }
    }
    const std::string summary = wound::ladder_summary(rows);
    write_text(out / "warps.csv", wound::ladder_csv(rows));
    write_text(out / "warps.md", summary + "\n" + wound::ladder_tables(rows));
    engine::write_png(out / "warps.png", wound::draw_ladder(rows));
    const std::optional<wound::WarpRung> best = wound::cheapest_exact(rows);
    fmt::print("{}cheapest within {} texel and without a fold: {}\n"
               "every shape and r: warps.csv, warps.md and warps.png in {}\n",
               summary, wound::kErrorLimit, best ? wound::name_of(*best) : "none", out.string());
}

/// With a rectangle a tenth larger than the mask's, with a seed in its middle, and without a hint.
void measure_segmentation(const std::string& photo, const std::string& mask)
{
    const cv::Mat3b srgb = engine::read_rgb(photo);
    const cv::Mat1b truth = wound::checked_mask(engine::read_mask(mask), srgb.size(), mask);
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
        fmt::print("{:<10} intersection over union {:.3f}; laid centroid on centroid {:.3f}, border {:.1f} "
                   "px apart, area {:.3f} of the mask's\n",
                   name, wound::intersection_over_union(found, truth), fit.intersection_over_union,
                   fit.border_distance_px, fit.area_ratio);
    }
}

} // namespace

void add_warps_command(CLI::App& program)
{
    struct Options
    {
        std::vector<std::string> masks;
        std::filesystem::path out = "out/warps";
        bool shader = false;
        std::string device;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("warps", "Measure error, area, folds and cost of every warp (docs/warp.md)");
    command->add_option("masks", options->masks, "Masks whose borders are measured too")->type_name("MASK");
    command->add_option("--out", options->out, "Folder for warps.csv, warps.md and warps.png")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_flag("--shader", options->shader,
                      "Print what the compute passes cost on a Vulkan device instead, by rung and by region");
    command
        ->add_option("--device", options->device,
                     "Vulkan device by index or part of its name; also CICATRIX_DEVICE")
        ->type_name("NAME|INDEX");
    command->footer("Example: cicatrix warps mask.png --out warps");
    command->callback([options] {
        if (!options->shader)
            return measure_warps(options->masks, options->out);
        Renderer renderer({.device = options->device});
        measure_warp_cost(renderer);
    });
}

void add_segmentation_command(CLI::App& program)
{
    auto files = std::make_shared<std::pair<std::string, std::string>>();
    CLI::App* command = program.add_subcommand(
        "segmentation", "Compare the wound found in a photograph with one drawn by hand");
    command->add_option("photo", files->first, "Photograph of a wound, PNG or JPEG")
        ->required()
        ->type_name("PHOTO");
    command->add_option("mask", files->second, "The wound white on black")->required()->type_name("MASK");
    command->footer("Example: cicatrix segmentation photo.png mask.png");
    command->callback([files] { measure_segmentation(files->first, files->second); });
}

} // namespace app
