#include "apps/batch/batch.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/batch/name_locks.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "scene/file.hpp"
#include "stage/capture.hpp"
#include "stage/labels.hpp"

namespace batch_command {
namespace {
using nlohmann::json;

/// The content of a finished variation's variation.json, written last. A variation is done when the file
/// equals this.
json wanted_record(const Variation& variation, const BatchOptions& options)
{
    return {{"name", variation.name},
            {"scene", scene::to_json(variation.scene)},
            {"views", options.views},
            {"labels", options.labels}};
}

/// Temporary name of the old folder of a variation while a new folder replaces it.
std::filesystem::path place_aside(const Variation& variation, const BatchOptions& options)
{
    return options.out / fmt::format(".{}.replaced", variation.name);
}

/// Restores or deletes the old folder that a killed batch left under its temporary name.
void put_back(const Variation& variation, const BatchOptions& options)
{
    const std::filesystem::path folder = options.out / variation.name,
                                aside = place_aside(variation, options);
    std::error_code ignored;
    if (!std::filesystem::exists(aside))
        return;
    if (std::filesystem::exists(folder))
        std::filesystem::remove_all(aside, ignored);
    else
        base::rename_over(aside, folder);
}

bool is_done(const Variation& variation, const BatchOptions& options)
{
    const std::filesystem::path record = options.out / variation.name / "variation.json";
    if (!std::filesystem::exists(record))
        return false;
    try {
        return base::read_json(record) == wanted_record(variation, options);
    } catch (const base::InputError&) {
        return false; // a damaged record: draw the variation again
    }
}

/// Refuses to replace a folder that was not made by a batch.
void check_place(const Variation& variation, const BatchOptions& options)
{
    const std::filesystem::path folder = options.out / variation.name;
    if (std::filesystem::exists(folder) && !std::filesystem::exists(folder / "variation.json"))
        throw base::InputError(folder.string(), "exists and was not made by a batch",
                               "name another folder with --out");
}

/// Deletes the folder at the end of the scope; after a successful rename nothing is left to delete.
struct PartialFolder
{
    std::filesystem::path path;
    ~PartialFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

void draw_variation(stage::Renderer& renderer, const stage::Stage& stage, const Variation& variation,
                    const BatchOptions& options)
{
    const std::filesystem::path folder = options.out / variation.name;
    const std::filesystem::path partial = options.out / fmt::format(".{}.partial", variation.name);
    std::filesystem::remove_all(partial);
    const PartialFolder removed{partial};
    base::make_folder(partial);
    stage::CaptureOptions capture_options;
    capture_options.out = partial;
    capture_options.title = variation.name;
    capture_options.views = options.views;
    capture_options.sheet = capture_options.cost = false;
    std::optional<stage::LabelFiles> labels;
    if (options.labels) {
        labels.emplace(renderer, partial, capture_options.tile);
        capture_options.after_picture = [&](const stage::Stage& shown, const scene::Shot& shot, json& entry) {
            labels->add(shown, shot, entry);
        };
    }
    base::Progress silent(false);
    std::vector<std::string> lines;
    stage::capture(renderer, stage, capture_options, silent, lines);
    if (labels)
        labels->finish();
    base::write_json(partial / "variation.json", wanted_record(variation, options));
    // A rename cannot replace a folder that is not empty. At every moment the old or the new folder is
    // complete, and put_back() finds it.
    const std::filesystem::path aside = place_aside(variation, options);
    if (std::filesystem::exists(folder))
        base::rename_over(folder, aside);
    base::rename_over(partial, folder);
    std::filesystem::remove_all(aside);
}

void set_stage(std::optional<stage::Stage>& stage, const gpu::Device& device, const scene::Scene& scene)
{
    if (!stage) {
        stage.emplace(device, stage::Stage::prepare(scene));
        return;
    }
    stage->update(scene);
    stage->wait_until_complete();
}

std::string csv_text(const json& value)
{
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c); // RFC 4180
    return quoted + '"';
}

/// One line per variation, picture and wound.
void add_measurements(std::string& table, const std::string& variation, const json& labels)
{
    for (const json& frame : labels.at("frames"))
        for (const json& wound : frame.at("wounds")) {
            table += fmt::format("{},{},{},{}", csv_text(variation), csv_text(frame.at("file")),
                                 csv_text(frame.value("view", "")), frame.at("day").dump());
            for (const char* field : {"wound", "unhealed_ratio", "bed_px", "new_epithelium_px", "bed_mm2",
                                      "inside_border_mm2", "visible_bed_mm2", "visible_inside_border_mm2",
                                      "visible_fraction", "deepest_mm", "volume_mm3"})
                table += "," + csv_text(wound.at(field));
            table += '\n';
        }
}

} // namespace

BatchResult run_batch(stage::Renderer& renderer, const std::vector<Variation>& variations,
                      const BatchOptions& options)
{
    base::make_folder(options.out);
    BatchResult result;
    NameLocks locks(options.out);
    std::vector<const Variation*> missing;
    for (const Variation& variation : variations) {
        locks.take(variation.name);
        put_back(variation, options);
        check_place(variation, options);
        if (!is_done(variation, options))
            missing.push_back(&variation);
    }
    result.kept = variations.size() - missing.size();

    base::Progress progress;
    progress.expect(missing.size());
    const auto start = std::chrono::steady_clock::now();
    std::optional<stage::Stage> stage; // one for all variations: update() rebuilds only what differs
    for (std::size_t i = 0; i < missing.size(); ++i) {
        progress.show(missing[i]->name);
        try {
            set_stage(stage, renderer.device, missing[i]->scene);
            if (i + 1 < missing.size())
                stage->prefetch(missing[i + 1]->scene);
            draw_variation(renderer, *stage, *missing[i], options);
            ++result.drawn;
        } catch (const base::InputError& error) {
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
        throw base::InputError(options.out.string(),
                               fmt::format("{} of {} variations are not finished, the first is {}",
                                           missing.size(), variations.size(), missing.front()),
                               "run the missing shares with the same options; finished variations are kept");
    json index = json::array();
    stage::Coco coco;
    std::string table =
        "variation,file,view,day,wound,unhealed_ratio,bed_px,new_epithelium_px,bed_mm2,inside_border_mm2,"
        "visible_bed_mm2,visible_inside_border_mm2,visible_fraction,deepest_mm,volume_mm3\n";
    for (const Variation& variation : variations) {
        const std::filesystem::path folder = options.out / variation.name;
        json pictures = json::array();
        const json capture = base::read_json(folder / "capture.json");
        for (const json& day : capture.at("days"))
            pictures.push_back(
                {{"day", day.at("day")}, {"file", variation.name + "/" + day.at("file").get<std::string>()}});
        index.push_back(
            {{"name", variation.name}, {"scene", scene::to_json(variation.scene)}, {"pictures", pictures}});
        if (!options.labels)
            continue;
        coco.join(base::read_json(folder / "coco.json"), variation.name);
        add_measurements(table, variation.name, base::read_json(folder / "labels.json"));
    }
    base::write_json(options.out / "batch.json", {{"variations", index}});
    if (!options.labels)
        return;
    base::write_json(options.out / "coco.json", coco.document());
    base::write_text(options.out / "measurements.csv", table);
}

} // namespace batch_command
