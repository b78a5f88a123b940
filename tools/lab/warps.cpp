// `cicatrix-lab warps`: the tables of docs/warp.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/progress.hpp"
#include "tools/lab/commands.hpp"
#include "tools/lab/warp_cost.hpp"
#include "tools/lab/warp_ladder.hpp"
#include "wound/prepare.hpp"

namespace lab {
namespace {

/// The wound border of a mask, named after its file.
LadderShape shape_of(const std::string& file)
{
    wound::Photograph photograph;
    photograph.mask = base::read_mask(file);
    photograph.srgb = cv::Mat3b(photograph.mask.size(), cv::Vec3b(128, 128, 128));
    wound::Preparation preparation;
    preparation.where = file;
    const wound::PreparedWound prepared = wound::prepare(photograph, preparation);
    return {std::filesystem::path(file).stem().string(), prepared.border, prepared.centroid};
}

/// Measures the built-in shapes and those of the masks.
void measure_warps(const std::vector<std::string>& masks, const std::filesystem::path& out)
{
    std::vector<LadderShape> shapes = ladder_shapes();
    for (const std::string& file : masks) {
        LadderShape shape = shape_of(file);
        if (std::ranges::find(shapes, shape.name, &LadderShape::name) != shapes.end())
            shape.name = file;
        shapes.push_back(shape);
    }
    base::make_folder(out);
    std::vector<LadderRow> rows;
    {
        base::Progress progress;
        progress.expect(shapes.size());
        for (const LadderShape& shape : shapes) {
            progress.show(shape.name);
            const std::vector<LadderRow> own = measure_ladder(shape);
            rows.insert(rows.end(), own.begin(), own.end());
            progress.step();
        }
    }
    const std::string summary = ladder_summary(rows);
    base::write_text(out / "warps.csv", ladder_csv(rows));
    base::write_text(out / "warps.md", summary + "\n" + ladder_tables(rows));
    base::write_png(out / "warps.png", draw_ladder(rows));
    const std::optional<wound::WarpModel> best = cheapest_exact(rows);
    fmt::print("{}cheapest within {} texel and without folds: {}\n"
               "all shapes and ratios: warps.csv, warps.md and warps.png in {}\n",
               summary, error_limit, best ? wound::name_of(*best) : "none", out.string());
}

} // namespace

void add_warps(CLI::App& program)
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
    command->add_option("masks", options->masks, "Wound masks to measure as well")->type_name("MASK");
    command->add_option("--out", options->out, "Folder for warps.csv, warps.md and warps.png")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_flag(
        "--shader", options->shader,
        "Print instead the cost of the compute passes on a Vulkan device, by model and by region");
    command
        ->add_option("--device", options->device,
                     "Vulkan device by index or part of its name; also CICATRIX_DEVICE")
        ->type_name("NAME|INDEX");
    command->footer("Example: cicatrix-lab warps mask.png --out warps");
    command->callback([options] {
        if (!options->shader)
            return measure_warps(options->masks, options->out);
        stage::Renderer renderer({.device = options->device});
        measure_warp_cost(renderer);
    });
}

} // namespace lab
