#include "apps/capture/gallery.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/contact_sheet.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "scene/file.hpp"
#include "wound/synthetic/kind.hpp"

namespace capture_command {
namespace {
using nlohmann::json;

scene::Scene with_kind(const scene::Scene& scene, const std::string& kind)
{
    scene::Scene changed = scene;
    const scene::Wound before = scene.wounds.empty() ? scene::Wound{} : scene.wounds.front();
    scene::Wound wound = before;
    wound.photo.clear();
    wound.mask.clear();
    wound.kind = kind;
    scene::follow_usual_course(before, wound);
    changed.wounds = {wound};
    return changed;
}

} // namespace

void draw_gallery(stage::Renderer& renderer, stage::Stage& stage, const std::filesystem::path& out,
                  base::Progress& progress)
{
    const scene::Scene scene = stage.scene();
    const int width = std::min<int>(int(std::min(scene.size[0], scene.size[1])), base::sheet_cell_width);
    const auto drawn = std::uint32_t(2 * width); // larger than shown, which smooths its edges
    const std::vector<std::string>& kinds = wound::kind_names();
    progress.expect(kinds.size() * scene.days.size());
    std::vector<base::SheetCell> cells;
    json record = json::array();
    for (const std::string& kind : kinds) {
        stage.update(with_kind(scene, kind));
        stage.wait_until_complete();
        for (const double day : scene.days) {
            progress.show(fmt::format("{}, day {:.4g}", kind, day));
            const stage::Drawing drawing =
                stage::draw(renderer, stage, {day, "", stage.loaded().close_up(0), ""},
                            {.size = {drawn, drawn}, .areas = false});
            const double open = drawing.wounds->front().unhealed_ratio;
            cells.push_back(
                {base::sheet_picture(drawing.picture, width), {}, fmt::format("{}, day {:.4g}", kind, day)});
            record.push_back({{"kind", kind}, {"day", day}, {"unhealed_ratio", open}});
            progress.step();
        }
    }
    progress.clear();
    base::write_png(out / "gallery.png",
                    base::contact_sheet("the kinds of wound", cells, int(scene.days.size())));
    base::write_json(out / "gallery.json", {{"format", "cicatrix gallery"},
                                            {"version", 1},
                                            {"scene", scene::to_json(scene)},
                                            {"pictures", record}});
    stage::fail_on_validation(renderer.device);
}

} // namespace capture_command
