#include <CLI/CLI.hpp>
#include <charconv>
#include <fmt/format.h>

#include "apps/batch/batch.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/number_option.hpp"
#include "scene/command_line.hpp"

namespace batch_command {
namespace {

struct CommandOptions : scene::SceneOptions
{
    std::filesystem::path variations;
    std::string share = "1/1";
    BatchOptions batch;
    bool merge = false;
    RandomVariations random;
    std::filesystem::path write;
};

/// Parses "K/N": "3/16" -> {3, 16}.
std::pair<std::size_t, std::size_t> parse_share(const std::string& text)
{
    std::size_t share = 0, shares = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, share);
    const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
    const auto second = slash ? std::from_chars(first.ptr + 1, end, shares) : first;
    if (!slash || second.ec != std::errc{} || second.ptr != end || share < 1 || share > shares)
        throw base::InputError("--share", "\"" + text + "\" is not a valid share",
                               "write K/N with K from 1 to N, as in 3/16");
    return {share, shares};
}

void write_random(const CommandOptions& options)
{
    const std::string table = random_variations(options.random);
    if (options.write.empty()) {
        fmt::print("{}", table);
        return;
    }
    base::write_text(options.write, table);
    fmt::print("{} variations in {}\n", options.random.count, options.write.string());
}

void run(const CommandOptions& options)
{
    if (options.variations.empty())
        throw base::InputError("batch", "no variations are given",
                               "name a .csv or a folder of scenes, or make one with --random N --write FILE");
    const auto [share, shares] = parse_share(options.share);
    const std::vector<Variation> all = read_variations(options.variations, scene::chosen_scene(options));
    if (options.merge) {
        merge_batch(all, options.batch);
        fmt::print("{} variations joined in {}\n", all.size(), options.batch.out.string());
        return;
    }
    std::vector<Variation> mine;
    for (const std::size_t i : share_of(all.size(), share, shares)) {
        check_files(all[i]);
        mine.push_back(all[i]);
    }
    stage::Renderer renderer(stage::device_options(options));
    const BatchResult result = run_batch(renderer, mine, options.batch);
    fmt::print("{} variations drawn, {} kept, {} failed, in {}\n", result.drawn, result.kept,
               result.failures.size(), options.batch.out.string());
    if (result.drawn > 0)
        fmt::print("{:.0f} variations per minute\n", 60 * double(result.drawn) / result.seconds);
    if (!result.failures.empty())
        throw base::InputError(options.variations.string(),
                               fmt::format("{} of {} variations failed, the first is {}",
                                           result.failures.size(), mine.size(), result.failures.front()),
                               "and run the same command again; finished variations are kept");
    if (shares == 1)
        merge_batch(all, options.batch);
}

} // namespace

void add(CLI::App& program)
{
    auto options = std::make_shared<CommandOptions>();
    CLI::App* command = program.add_subcommand(
        "batch", "Draw many variations of a scene from a table, with labels; resumes a stopped batch");
    command
        ->add_option(
            "variations", options->variations,
            "CSV whose header names fields of a scene (wounds.0.width_mm, head, days ...; also name and "
            "scene), or a folder of scenes")
        ->type_name("VARIATIONS");
    command
        ->add_option("--scene", options->scene, "Scene that rows start from; without it, the default scene")
        ->type_name("SCENE.json");
    command
        ->add_option("--out", options->batch.out,
                     "Output folder: one folder per variation, batch.json, coco.json")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_option("--share", options->share, "Draw only every N-th variation, starting with the K-th")
        ->capture_default_str()
        ->type_name("K/N");
    command->add_flag(
        "--merge", options->merge,
        "Draw nothing: join the results of all shares; without --share this happens at the end");
    command->add_flag("--labels", options->batch.labels, "Write labels, as capture does (docs/labels.md)");
    command->add_option("--views", options->batch.views, "Views, as for capture")
        ->delimiter(',')
        ->type_name("NAMES");
    command->add_option("--head", options->head, "Head of the scene that rows start from")
        ->type_name("FILE.glb");
    command->add_option("--days", options->days, "Days of the scene that rows start from")->type_name("DAYS");
    command->add_option("--size", options->size, "Picture size of the scene that rows start from")
        ->type_name("WxH");
    command->add_flag("--msaa", options->msaa, "Four samples per pixel");
    command->add_option("--device", options->device, "Vulkan device by index or part of its name")
        ->type_name("NAME|INDEX");
    command->add_flag("--validation", options->validation,
                      "Run with the Vulkan validation layers; any message is a failure");
    CLI::Option* random = command
                              ->add_option("--random", options->random.count,
                                           "Draw nothing: make a table of N random variations")
                              ->transform(base::whole_number_from(1, 1e6))
                              ->type_name("N");
    command->add_option("--seed", options->random.seed, "Seed of the random variations")
        ->transform(base::whole_number_from(0, 4294967295))
        ->capture_default_str()
        ->needs(random);
    command->add_option("--heads", options->random.heads, "Heads to choose from")
        ->needs(random)
        ->type_name("FILE.glb");
    command->add_option("--photos", options->random.photos, "Photographs of wounds to choose from")
        ->needs(random)
        ->type_name("PHOTO");
    command->add_option("--write", options->write, "File for the table (default: print it)")
        ->needs(random)
        ->type_name("FILE.csv");
    command->footer("Examples:\n"
                    "  cicatrix batch --random 500 --seed 1 --write variations.csv\n"
                    "  cicatrix batch variations.csv --labels --size 640x480 --out data\n"
                    "  cicatrix batch variations.csv --labels --size 640x480 --out data --share 3/16\n"
                    "  cicatrix batch variations.csv --labels --size 640x480 --out data --merge");
    command->callback([options, random] {
        if (random->count() > 0)
            write_random(*options);
        else
            run(*options);
    });
}

} // namespace batch_command
