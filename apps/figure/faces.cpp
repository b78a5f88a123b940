// Figures 7, 8 and 9: rendered faces.
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "apps/figure/figures.hpp"
#include "apps/figure/workbench.hpp"

namespace figure_command {
namespace {

/// Circles a point of the head in a square picture that `camera` has taken of the stage's scene.
void circle(cv::Mat3b& picture, const stage::Stage& stage, const head::Camera& camera, const glm::dvec3& at,
            double radius_m)
{
    const std::array size{std::uint32_t(picture.cols), std::uint32_t(picture.rows)};
    const glm::dmat4 clip_from_world(stage.view(camera, passes::ViewportTile(size)).clip_from_world);
    const glm::dvec4 clip = clip_from_world * glm::dvec4(at, 1);
    const double pixels_per_m =
        picture.rows / (2 * std::tan(glm::radians(camera.fov_deg) / 2) * glm::distance(camera.eye, at));
    cv::circle(picture, cv::Point(cv::Point2d(clip.x / clip.w + 1, clip.y / clip.w + 1) * .5 * picture.cols),
               cvRound(radius_m * pixels_per_m), {200, 30, 30}, std::max(1, picture.cols / 200), cv::LINE_AA);
}

/// A face from the front and its nose from close by, the nose's side away from the light circled.
base::SheetCell nose_cell(Workbench& bench, const scene::Scene& scene, const std::string& label)
{
    const stage::Stage& stage = bench.showing(scene);
    const head::FaceFrame& face = stage.loaded().head->face;
    const glm::dvec3 far_side = face.nose_tip + face.unit_m * glm::dvec3(-.075, .03, -.1);
    const double radius_m = .085 * face.unit_m;
    const head::Camera front = stage.loaded().camera({.from = {0, 0}}),
                       near{face.nose_tip + 9. * face.unit_m * glm::dvec3(0, 0, 1), face.nose_tip, 3.6};
    cv::Mat3b whole = bench.picture(stage, front, 0), nose = bench.picture(stage, near, 0);
    circle(whole, stage, front, far_side, radius_m);
    circle(nose, stage, near, far_side, radius_m);
    return bench.cell(whole, label, nose);
}

} // namespace

// ---- Figure 7 ------------------------------------------------------------------------------------------

void draw_shading(Workbench& bench)
{
    const scene::Direction from_the_right{70, 10};
    scene::Scene proposed = bench.scene("cheek", Equations::Published, from_the_right),
                 usual = bench.scene("cheek", Equations::Corrected, from_the_right);
    proposed.wounds.clear();
    usual.wounds.clear();
    scene::Scene ward = proposed;
    ward.shading.translucency = false;
    std::vector<base::SheetCell> cells;
    for (const auto& [scene, label] : {std::pair(&ward, "(a) Lambert and Ward"),
                                       {&proposed, "(d) proposed, eq. (8)"},
                                       {&usual, "(e) our default"}})
        cells.push_back(nose_cell(bench, *scene, label));
    bench.write_picture("figure_7",
                        base::contact_sheet("Light from the right; (b), (c): not there yet", cells, 3));
    bench.say(
        "(b) the layered Oren-Nayar model and (c) Chang's texture-space BSSRDF are not in Cicatrix yet");
}

// ---- Figures 8 and 9 -----------------------------------------------------------------------------------

namespace {

/// One picture per day, with the light in another place on each.
struct LitDay
{
    double day;
    scene::Direction light;
    const char* where;
};
constexpr std::array<LitDay, 3> lit_days{
    {{0, {-20, 15}, "light left"}, {10, {15, 40}, "light above"}, {12, {60, 15}, "light right"}}};
constexpr double steps_back = 2.2; // of the camera, in distances of a close-up

/// A row of a sheet: the first wound of the scene and the face around it.
void add_row(Workbench& bench, const std::string& letter, const scene::Scene& lit, bool light_moves,
             std::vector<base::SheetCell>& cells)
{
    const stage::Stage& stage = bench.showing(lit);
    head::Camera camera = stage.loaded().close_up(0);
    camera.eye = camera.target + steps_back * (camera.eye - camera.target);
    for (std::size_t i = 0; i < lit_days.size(); ++i) {
        scene::Scene moved = lit;
        if (light_moves)
            moved.lights = {paper_light(lit_days[i].light)};
        bench.showing(moved);
        cells.push_back(bench.cell(bench.picture(stage, camera, lit_days[i].day),
                                   fmt::format("({}-{}) day {:g}{}", letter, i + 1, lit_days[i].day,
                                               light_moves ? fmt::format(", {}", lit_days[i].where) : "")));
    }
}

/// The two rows of a figure, as published in `stem`.png and by our default in `stem`_default.png.
void write_sheets(Workbench& bench, const std::string& stem, const std::string& title, bool light_moves,
                  const std::function<std::array<scene::Scene, 2>(Equations)>& scenes)
{
    for (const Equations equations : {Equations::Published, Equations::Corrected}) {
        const bool published = equations == Equations::Published;
        std::vector<base::SheetCell> cells;
        const std::array<scene::Scene, 2> rows = scenes(equations);
        add_row(bench, "a", rows[0], light_moves, cells);
        add_row(bench, "b", rows[1], light_moves, cells);
        bench.write_picture(
            stem + (published ? "" : "_default"),
            base::contact_sheet(title + ", " + (published ? "as published" : "our default"), cells, 3));
    }
}

} // namespace

void draw_recovery_on_face(Workbench& bench)
{
    write_sheets(bench, "figure_8", "Cheek and eyebrow", true, [&](Equations equations) {
        return std::array{bench.scene("cheek", equations), bench.scene("eyebrow", equations)};
    });
}

void draw_chin(Workbench& bench)
{
    write_sheets(bench, "figure_9", "Two wounds on the chin", false, [&](Equations equations) {
        std::array scenes{bench.scene("chin", equations), bench.scene("chin", equations)};
        scene::Wound& other = scenes[1].wounds.front();
        other.kind = "abrasion";
        other.seed = 5;
        return scenes;
    });
}

} // namespace figure_command
