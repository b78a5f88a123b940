#include "apps/batch.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/capture.hpp"
#include "apps/json_fields.hpp"
#include "apps/labels.hpp"
#include "apps/output.hpp"
#include "engine/image_io.hpp"
#include "wound/input_error.hpp"

namespace app {
namespace {
using nlohmann::json;

/// What a finished variation's folder records of itself, written last: it is done when this is what is
/// wanted.
json wanted_record(const Variation& variation, const BatchOptions& options)
{
    return {{"name", variation.name},
            {"scene", to_json(variation.scene)},
            {"views", options.views},
            {"labels", options.labels}};
}

bool is_done(const Variation& variation, const BatchOptions& options)
{
    const std::filesystem::path record = options.out / variation.name / "variation.json";
    if (!std::filesystem::exists(record))
        return false;
    try {
        return read_json(record) == wanted_record(variation, options);
    } catch (const cicatrix::InputError&) {
        return false; // damaged: draw it again
    }
}

/// A folder of that name which no batch has made is nobody's to replace.
void check_place(const Variation& variation, const BatchOptions& options)
{
    const std::filesystem::path folder = options.out / variation.name;
    if (std::filesystem::exists(folder) && !std::filesystem::exists(folder / "variation.json"))
        throw cicatrix::InputError(folder.string(), "is there and was not made by a batch",
                                   "name another folder with --out");
}

/// Removed, whatever is in it, unless it was renamed.
struct PartialFolder
{
    std::filesystem::path path;
    ~PartialFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

void draw_variation(Renderer& renderer, const Stage& stage, const Variation& variation,
                    const BatchOptions& options)
{
    const std::filesystem::path folder = options.out / variation.name;
    const std::filesystem::path partial = options.out / fmt::format(".{}.partial", variation.name);
    std::filesystem::remove_all(partial);
    const PartialFolder removed{partial};
    make_folder(partial);
    CaptureOptions capture_options;
    capture_options.out = partial;
    capture_options.title = variation.name;
    capture_options.views = options.views;
    capture_options.sheet = capture_options.cost = false;
    std::optional<LabelFiles> labels;
    if (options.labels) {
        labels.emplace(renderer, partial, capture_options.tile);
        capture_options.after_picture = [&](const Stage& shown, const Shot& shot, json& entry) {
            labels->add(shown, shot, entry);
        };
    }
    Progress silent(false);
    std::vector<std::string> lines;
    capture(renderer, stage, capture_options, silent, lines);
    if (labels)
        labels->finish();
    write_json(partial / "variation.json", wanted_record(variation, options));
    std::filesystem::remove_all(folder);
    engine::rename_over(partial, folder);
}

void set_stage(std::optional<Stage>& stage, const engine::Device& device, const Scene& scene)
{
    if (!stage) {
        stage.emplace(device, scene, Stage::prepare(scene));
        return;
    }
    stage->update(scene);
    stage->settle();
}

std::string csv_text(const json& value)
{
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    return text.find_first_of(",\"\n") == std::string::npos ? text : json(text).dump();
}

/// One line per variation, picture and wound.
void add_measurements(std::string& table, const std::string& variation, const json& labels)
{
    for (const json& frame : labels.at("frames"))
        for (const json& wound : frame.at("wounds")) {
            table += fmt::format("{},{},{},{}", variation, frame.at("file").get<std::string>(),
                                 frame.value("view", ""), frame.at("day").dump());
            for (const char* field : {"wound", "unhealed_ratio", "bed_px", "new_epithelium_px", "bed_mm2",
                                      "inside_border_mm2", "visible_bed_mm2", "visible_inside_border_mm2",
                                      "visible_fraction", "deepest_mm", "volume_mm3"})
                table += "," + csv_text(wound.at(field));
            table += '\n';
        }
}

} // namespace

BatchResult run_batch(Renderer& renderer, const std::vector<Variation>& variations,
                      const BatchOptions& options)
{
    make_folder(options.out);
    BatchResult result;
    std::vector<const Variation*> missing;
    for (const Variation& variation : variations) {
        check_place(variation, options);
        if (!is_done(variation, options))
            missing.push_back(&variation);
    }
    result.kept = variations.size() - missing.size();

    Progress progress;
    progress.expect(missing.size());
    const auto start = std::chrono::steady_clock::now();
    std::optional<Stage> stage; // made once: from one variation to the next only what differs is made anew
    for (std::size_t i = 0; i < missing.size(); ++i) {
        progress.show(missing[i]->name);
        try {
            set_stage(stage, renderer.device, missing[i]->scene);
            if (i + 1 < missing.size())
                stage->foresee(missing[i + 1]->scene);
            draw_variation(renderer, *stage, *missing[i], options);
            ++result.drawn;
        } catch (const cicatrix::InputError& error) {
            progress.clear();
            result.failures.push_back(fmt::format("{}: {}", missing[i]->name, error.what()));
            fmt::print(stderr, "failed: {}\n", result.failures.back());
        }
        progress.step();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

void merge_batch(const std::vector<Variation>& variations, const BatchOptions& options)
{
    std::vector<std::string> missing;
    for (const Variation& variation : variations)
        if (!is_done(variation, options))
            missing.push_back(variation.name);
    if (!missing.empty())
        throw cicatrix::InputError(options.out.string(),
                                   fmt::format("{} of {} variations are not finished, the first is {}",
                                               missing.size(), variations.size(), missing.front()),
                                   "run their shares, with the same options; what is finished is kept");
    json index = json::array();
    Coco coco;
    std::string table =
        "variation,file,view,day,wound,unhealed_ratio,bed_px,new_epithelium_px,bed_mm2,inside_border_mm2,"
        "visible_bed_mm2,visible_inside_border_mm2,visible_fraction,deepest_mm,volume_mm3\n";
    for (const Variation& variation : variations) {
        const std::filesystem::path folder = options.out / variation.name;
        json pictures = json::array();
        const json capture = read_json(folder / "capture.json");
        for (const json& day : capture.at("days"))
            pictures.push_back(
                {{"day", day.at("day")}, {"file", variation.name + "/" + day.at("file").get<std::string>()}});
        index.push_back(
            {{"name", variation.name}, {"scene", to_json(variation.scene)}, {"pictures", pictures}});
        if (!options.labels)
            continue;
        coco.join(read_json(folder / "coco.json"), variation.name);
        add_measurements(table, variation.name, read_json(folder / "labels.json"));
    }
    write_json(options.out / "batch.json", {{"variations", index}});
    if (!options.labels)
        return;
    write_json(options.out / "coco.json", coco.document());
    engine::write_atomically(options.out / "measurements.csv", [&](const std::filesystem::path& temporary) {
        std::ofstream(temporary, std::ios::binary) << table;
    });
}

} // namespace app
