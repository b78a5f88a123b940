#include "stage/labels.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "scene/file.hpp"

namespace stage {
namespace {
using nlohmann::json;

constexpr std::size_t most_rows = 8; // of labels.png

/// Colours of LABEL_... in labels.png, RGB.
const cv::Vec3b class_colors[] = {{0, 0, 0}, {90, 120, 190}, {220, 40, 40}, {245, 180, 60}, {90, 160, 90}};

cv::Mat4f floats(const cv::Mat& halves)
{
    cv::Mat4f values;
    halves.convertTo(values, CV_32F);
    return values;
}

cv::Mat3b overlaid(const cv::Mat3b& picture, const cv::Mat1b& kinds)
{
    cv::Mat3b result = picture.clone();
    for (int y = 0; y < kinds.rows; ++y)
        for (int x = 0; x < kinds.cols; ++x)
            if (kinds(y, x) != shared::LABEL_BACKGROUND)
                for (int c = 0; c < 3; ++c)
                    result(y, x)[c] = uchar((picture(y, x)[c] + class_colors[kinds(y, x)][c]) / 2);
    return result;
}

/// Colours the depth of wounds from dark blue (0) to yellow (`deepest_mm`) over the picture in gray.
cv::Mat3b depth_picture(const passes::LabelMaps& maps, const cv::Mat3b& picture, double deepest_mm)
{
    cv::Mat1b scaled, gray;
    maps.depth_mm.convertTo(scaled, CV_8U, 255 / std::max(deepest_mm, 1e-3)); // clamps depths below 0
    cv::Mat colored;
    cv::applyColorMap(scaled, colored, cv::COLORMAP_VIRIDIS);
    cv::cvtColor(colored, colored, cv::COLOR_BGR2RGB);
    cv::cvtColor(picture, gray, cv::COLOR_RGB2GRAY);
    cv::Mat3b result;
    cv::cvtColor(gray, result, cv::COLOR_GRAY2RGB);
    colored.copyTo(result, maps.wounds != 0);
    return result;
}

json wound_entry(const Stage& stage, std::size_t index, const wound::WoundDay& today,
                 const passes::VisibleWound& seen, const passes::WoundSize& size)
{
    const head::Anchor& anchor = stage.loaded().wounds[index].anchor;
    return {{"wound", index + 1},
            {"unhealed_ratio", today.unhealed_ratio},
            {"bed_px", seen.bed_px},
            {"new_epithelium_px", seen.epithelium_px},
            {"box", {seen.box.x, seen.box.y, seen.box.width, seen.box.height}},
            {"bed_mm2", size.bed_mm2},
            {"inside_border_mm2", size.inside_mm2},
            {"visible_bed_mm2", seen.bed_mm2},
            {"visible_inside_border_mm2", seen.inside_mm2},
            {"visible_fraction",
             size.inside_mm2 > 0 ? std::clamp(seen.inside_mm2 / size.inside_mm2, 0.0, 1.0) : 0.0},
            {"deepest_mm", size.deepest_mm},
            {"volume_mm3", size.volume_mm3},
            {"center_m", scene::numbers_of(anchor.centre)},
            {"normal", scene::numbers_of(anchor.normal)}};
}

void add_regions(Coco& coco, int image, std::size_t number, const passes::LabelMaps& maps,
                 const passes::WoundSize& size)
{
    const cv::Mat1b whole = maps.wounds == double(number);
    const auto attributes = [&](double mm2) { return json{{"wound", number}, {"area_mm2", mm2}}; };
    coco.add_region(image, CocoCategory::Wound, whole, attributes(size.inside_mm2));
    coco.add_region(image, CocoCategory::OpenBed, whole & (maps.kinds == shared::LABEL_OPEN_BED),
                    attributes(size.bed_mm2));
    coco.add_region(image, CocoCategory::NewEpithelium, whole & (maps.kinds == shared::LABEL_NEW_EPITHELIUM),
                    attributes(std::max(size.inside_mm2 - size.bed_mm2, 0.0)));
}

} // namespace

DrawnLabels draw_labels(Renderer& renderer, const Stage& stage, const scene::Shot& shot,
                        const DrawOptions& options)
{
    DrawnLabels drawn;
    cv::Mat kinds, measures;
    for (const passes::ViewportTile& tile : tiles_of(options)) {
        const bool first = kinds.empty();
        graph::Graph graph;
        const Frame declared = stage.declare(graph, {.day = shot.day, .tile = tile, .camera = shot.camera});
        const passes::FrameImages& images = declared.images;
        drawn.wounds = declared.wounds;
        const std::array wanted{graph.readback("label kinds", images.labels.kinds),
                                graph.readback("label measures", images.labels.measures),
                                graph.readback("picture", images.picture)};
        std::vector<std::array<graph::ReadbackId, 2>> maps;
        if (first)
            for (const passes::WoundTexture& wound : images.wounds)
                maps.push_back({graph.readback(fmt::format("state {}", maps.size()), wound.state),
                                graph.readback(fmt::format("relief {}", maps.size()), wound.relief)});
        const gpu::FrameResult frame = renderer.executor.run(graph);
        passes::place(kinds, frame.mat(wanted[0]), tile);
        passes::place(measures, frame.mat(wanted[1]), tile);
        passes::place(drawn.picture, frame.mat(wanted[2]), tile);
        for (std::size_t i = 0; i < maps.size(); ++i)
            drawn.sizes.push_back(passes::wound_size(
                stage.loaded().surface_mm2(i), floats(frame.mat(maps[i][0])), floats(frame.mat(maps[i][1]))));
    }
    cv::cvtColor(drawn.picture, drawn.picture, cv::COLOR_RGBA2RGB);
    drawn.maps = passes::label_maps(kinds, measures);
    drawn.visible = passes::visible_wounds(kinds, measures, drawn.wounds->size());
    return drawn;
}

LabelFiles::LabelFiles(Renderer& renderer, std::filesystem::path folder, std::uint32_t tile)
    : renderer_(renderer), folder_(std::move(folder)), tile_(tile)
{
}

json LabelFiles::write_images(const std::string& name, const passes::LabelMaps& maps)
{
    json files;
    const auto file = [&](const char* what, const char* extension) {
        files[what] = fmt::format("{}_{}.{}", name, what, extension);
        return folder_ / files[what].get<std::string>();
    };
    const cv::Mat1b mask = maps.wounds != 0;
    for (const auto& [what, image] :
         {std::pair{"classes", maps.kinds}, {"wounds", maps.wounds}, {"mask", mask}})
        writers_.push(image.total(), [path = file(what, "png"), image] { base::write_png(path, image); });
    for (const auto& [what, image] : {std::pair{"depth", maps.depth_mm}, {"distance", maps.distance_mm}})
        writers_.push(4 * image.total(), [path = file(what, "exr"), image] { base::write_exr(path, image); });
    return files;
}

void LabelFiles::add(const Stage& stage, const scene::Shot& shot, json& entry)
{
    const DrawnLabels drawn =
        draw_labels(renderer_, stage, shot, {.size = stage.scene().size, .tile = tile_});
    const std::vector<wound::WoundDay>& today = *drawn.wounds;
    entry["labels"] = write_images(shot.name, drawn.maps);

    json frame{{"day", shot.day},
               {"file", entry.at("file")},
               {"size", stage.scene().size},
               {"labels", entry.at("labels")},
               {"camera", entry.at("camera")},
               {"wounds", json::array()}};
    json image{{"day", shot.day}};
    if (!shot.view.empty())
        frame["view"] = image["view"] = shot.view;
    if (entry.contains("turn_deg"))
        frame["turn_deg"] = image["turn_deg"] = entry.at("turn_deg");
    const int id = coco_.add_image(entry.at("file"), drawn.maps.kinds.size(), image);
    double deepest = 0;
    for (std::size_t i = 0; i < today.size(); ++i) {
        frame["wounds"].push_back(wound_entry(stage, i, today[i], drawn.visible[i], drawn.sizes[i]));
        add_regions(coco_, id, i + 1, drawn.maps, drawn.sizes[i]);
        deepest = std::max(deepest, drawn.sizes[i].deepest_mm);
    }
    frames_.push_back(std::move(frame));
    if (cells_.size() >= 3 * most_rows)
        return;
    const cv::Mat3b picture = drawn.picture;
    const std::string bed =
        today.empty() ? "no wound" : fmt::format("open bed {:.0f} mm2", drawn.sizes[0].bed_mm2);
    cells_.push_back({base::sheet_picture(picture), {}, fmt::format("day {:g} {}", shot.day, shot.view)});
    cells_.push_back({base::sheet_picture(overlaid(picture, drawn.maps.kinds)), {}, bed});
    cells_.push_back({base::sheet_picture(depth_picture(drawn.maps, picture, deepest)),
                      {},
                      fmt::format("depth, yellow: {:.2f} mm", deepest)});
}

void LabelFiles::finish()
{
    writers_.finish();
    base::write_json(folder_ / "labels.json", {{"format", "cicatrix labels"},
                                               {"version", 1},
                                               {"classes",
                                                {{"background", shared::LABEL_BACKGROUND},
                                                 {"skin", shared::LABEL_SKIN},
                                                 {"open_bed", shared::LABEL_OPEN_BED},
                                                 {"new_epithelium", shared::LABEL_NEW_EPITHELIUM},
                                                 {"other", shared::LABEL_OTHER}}},
                                               {"frames", frames_}});
    base::write_json(folder_ / "coco.json", coco_.document());
    if (!cells_.empty())
        base::write_png(folder_ / "labels.png", base::contact_sheet("Picture, labels, depth", cells_, 3));
}

} // namespace stage
