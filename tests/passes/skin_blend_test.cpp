// The skin under a wound as computed on the CPU (wound/skin_blend.hpp, with the CPU's maps and table) against
// the forward pass, on a flat wall with known coordinates.
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>

#include "head/albedo_under.hpp"
#include "head/vectors.hpp"
#include "passes/frame.hpp"
#include "tests/support/gpu.hpp"
#include "wound/drawn_region.hpp"
#include "wound/optics/surroundings.hpp"
#include "wound/prepare.hpp"
#include "wound/reflectance_table.hpp"
#include "wound/skin_blend.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace {

constexpr std::array days{0., 3., 8., 12., 20., 60.};
constexpr double last_day = 60;
constexpr std::uint32_t side = 128;             // pixels of the picture
constexpr double distance_m = 1;                // of the camera from the wall
const base::Color own_albedo(.55f, .36f, .27f); // of the wall

const cv::Vec3b normal_code(150, 118, 250); // of every texel of the normal map

/// A square of skin at z = 0, 24 cm wide, which faces +z.
head::Model wall(float open = 1)
{
    head::Model model;
    for (const glm::vec2 uv : {glm::vec2(0, 0), {0, 1}, {1, 0}, {1, 1}})
        model.vertices.push_back(
            {{.24f * (uv.x - .5f), .24f * (.5f - uv.y), 0}, {0, 0, 1}, {1, 0, 0, 1}, uv, open});
    model.indices = {0, 1, 2, 2, 1, 3};
    model.primitives = {{0, 6, 0}};
    head::Material skin;
    skin.name = "skin";
    skin.base_color_factor = glm::vec4(own_albedo[0], own_albedo[1], own_albedo[2], 1);
    skin.normal = cv::Mat3b(1, 1, normal_code);
    model.materials = {skin};
    head::update_bounds(model);
    return model;
}

/// Draws only C of eq. (4) times occlusion: white ambient light and no other term.
optics::Shading bare_color(optics::BlendModel model)
{
    optics::Shading shading = optics::skin_shading();
    shading.lambert = shading.translucency = shading.ward = shading.normal_map = shading.shadow = false;
    shading.rho_d = 1;
    shading.ambient = {1, 1, 1};
    shading.blend_model = model;
    return shading;
}

/// A wound on the wall, seen head-on by a camera.
class Scene
{
  public:
    Scene(const std::string& kind, wound::HealingModel model, const head::Anchor& anchor, float open = 1)
        : prepared(wound::prepare(wound::synthesize({.kind = kind, .seed = 3}), {.patch_size = 256})),
          anchor_(anchor)
    {
        healing.model = model;
        anchor_.half_width_m = .5e-3 * prepared.patch.width_mm;
        camera_.fov_deg = 2 * 180 / CV_PI * std::atan(anchor_.half_width_m / distance_m); // shows the patch
        const wound::LutRows rows =
            wound::lut_rows(optics::skin(optics::SkinTone::Light), healing, wound::lut_size, last_day);
        table_ =
            wound::bake_reflectance_table(rows.days, wound::lut_size, optics::ReflectanceModel::Calibrated);
        axes_ = rows.axes;
        tissue_ = passes::lut_tissue(rows.days, last_day);
        maps_ = passes::upload_wound(gpu_test::device(), prepared.patch);
        maps_.region = wound::drawn_region(prepared, healing);
        const head::Model skin = wall(open);
        head_ = passes::with_wounds(gpu_test::device(), passes::upload_head(gpu_test::device(), skin), skin,
                                    std::array{passes::WoundReach{anchor_}});
    }

    cv::Mat4f draw(const wound::WoundDay& today, const optics::Shading& shading,
                   const std::vector<optics::Light>& lights = {})
    {
        const passes::PackedWarps warps = passes::pack_warps(today);
        const passes::FrameWound wound{anchor_, maps_, tissue_, today, warps};
        graph::Graph graph;
        const passes::FrameImages images =
            passes::add_frame(graph, {.head = head_,
                                      .wounds = {&wound, 1},
                                      .lights = lights,
                                      .camera = camera_,
                                      .shading = shading,
                                      .reflectance = optics::ReflectanceModel::Calibrated,
                                      .tile = passes::ViewportTile({side, side})});
        const graph::ReadbackId back = graph.readback("radiance", images.radiance);
        cv::Mat4f radiance;
        executor_.run(graph).mat(back).convertTo(radiance, CV_32F);
        return radiance;
    }

    /// In metres.
    glm::dvec3 position(double x, double y) const
    {
        return {((x + .5) * 2 / side - 1) * anchor_.half_width_m,
                (1 - (y + .5) * 2 / side) * anchor_.half_width_m, 0};
    }

    wound::PatchPlace place(int x, int y) const
    {
        const auto in_patch = [&](double i, double j) { return head::in_frame(anchor_, position(i, j)); };
        const glm::dvec3 here = in_patch(x, y), across = in_patch(x + 1, y) - here,
                         down = in_patch(x, y + 1) - here;
        return {.at = {here.x, here.y},
                .facing = head::share_received(anchor_.normal.z, here.z),
                .right = head::to_cv(anchor_.right),
                .down = head::to_cv(anchor_.down),
                .geometric = {0, 0, 1},
                .footprint = {.25 * (across.x + down.x), .25 * (across.y + down.y)}};
    }

    wound::DayMaps maps_on(const wound::WoundDay& today) const
    {
        return wound::maps_on(prepared, today, maps_.region);
    }
    wound::WoundLook look(const wound::WoundDay& today, const wound::DayMaps& maps) const
    {
        return {today, maps, table_, axes_};
    }

    wound::PreparedWound prepared;
    wound::Healing healing;

  private:
    head::Anchor anchor_;
    head::Camera camera_{{0, 0, distance_m}, {0, 0, 0}, 1};
    cv::Mat3f table_;
    shared::LutAxes axes_;
    passes::LutTissue tissue_;
    passes::WoundMaps maps_;
    passes::Head head_;
    gpu::Executor executor_{gpu_test::device(), gpu_test::shaders()};
};

/// The largest and the mean difference of a channel.
struct Difference
{
    double largest = 0, mean = 0;
};

template <class Expected>
Difference compare(const cv::Mat4f& seen, const Expected& expected)
{
    Difference difference;
    for (int y = 0; y < seen.rows; ++y)
        for (int x = 0; x < seen.cols; ++x) {
            const cv::Vec4f& pixel = seen(y, x);
            const base::Color off = expected(x, y) - base::Color(pixel[0], pixel[1], pixel[2]);
            difference.largest = std::max(difference.largest, cv::norm(off, cv::NORM_INF));
            difference.mean += cv::norm(off, cv::NORM_L1) / 3 / double(seen.total());
        }
    return difference;
}

// A wound's texture, the table and the picture are half floats, which are within 2^-11 of the value; a device
// may filter each with weights in steps of 1/256.
constexpr Difference of_color{.002, 2.5e-4};

Difference compare_color(Scene& scene, const wound::WoundDay& today, const wound::DayMaps& maps,
                         optics::BlendModel blend)
{
    const wound::WoundLook look = scene.look(today, maps);
    return compare(scene.draw(today, bare_color(blend)), [&](int x, int y) {
        const wound::SkinPoint skin =
            wound::with_wound({own_albedo, {0, 0, 1}}, look, scene.place(x, y), blend);
        return optics::visibility(skin.occlusion, skin.albedo).mul(skin.albedo);
    });
}

/// For light from one side: only the diffuse term, or only the highlight of a model.
optics::Shading lit(std::optional<optics::WardModel> highlight)
{
    optics::Shading shading = optics::skin_shading();
    shading.ambient = {0, 0, 0};
    shading.translucency = shading.shadow = false;
    shading.lambert = !highlight;
    shading.ward = highlight.has_value();
    shading.ward_model = highlight.value_or(shading.ward_model);
    shading.rho_ts = 0;
    shading.rho_s = highlight ? optics::skin_rho_s : 0;
    return shading;
}

base::Color lit_radiance(const wound::SkinPoint& skin, const optics::Shading& shading,
                         const optics::Light& light, const cv::Vec3d& position)
{
    const cv::Vec3d n = skin.normal, tangent = cv::normalize(cv::Vec3d(1, 0, 0) - n[0] * n),
                    bitangent = n.cross(tangent);
    const optics::ShadedPoint point{.position = position,
                                    .frame = {tangent[0], tangent[1], tangent[2], bitangent[0], bitangent[1],
                                              bitangent[2], n[0], n[1], n[2]},
                                    .to_viewer = cv::normalize(cv::Vec3d(0, 0, distance_m) - position),
                                    .albedo = shading.ward ? base::Color(0, 0, 0) : skin.albedo,
                                    .finish = wound::finish_of(skin)};
    const bool dimmed = shading.ward && !optics::only_ward(shading);
    return optics::shade(wound::with_gloss(shading, skin), light, point, 1) * (dimmed ? skin.occlusion : 1);
}

using SkinBlendOnGpu = gpu_test::Test;

} // namespace

TEST_F(SkinBlendOnGpu, ColorAndOcclusionEqualThoseOfTheCpu)
{
    for (const std::string& kind : wound::kind_names())
        for (const auto model : {wound::HealingModel::Face, wound::HealingModel::Contraction}) {
            Scene scene(kind, model, {});
            for (const double day : days) {
                const wound::WoundDay today = wound::wound_at(scene.prepared, scene.healing, day);
                const wound::DayMaps maps = scene.maps_on(today);
                for (const auto blend : {optics::BlendModel::Corrected, optics::BlendModel::Published}) {
                    const Difference found = compare_color(scene, today, maps, blend);
                    const std::string where =
                        fmt::format("{}, model {}, day {}, blend {}", kind, int(model), day, int(blend));
                    EXPECT_LT(found.largest, of_color.largest) << where;
                    EXPECT_LT(found.mean, of_color.mean) << where;
                }
            }
        }
}

// Diffuse light depends on albedo and normal; the highlight on normal, occlusion, wetness and tautness, that
// of the published model on the normal alone. The highlight is as bright as .7 and follows the slope, which
// is a difference of depths in half floats and off by .01 in places (wound_texture_test.cpp).
TEST_F(SkinBlendOnGpu, DiffuseLightAndHighlightEqualThoseOfTheCpu)
{
    const optics::Light light{.kind = optics::LightKind::Directional,
                              .position = {0, 0, 0},
                              .direction = cv::normalize(cv::Vec3d(.5, .4, .8))};
    const cv::Vec3d mapped = cv::normalize(cv::Vec3d(normal_code) / 255. * 2 - cv::Vec3d(1, 1, 1));
    for (const auto model : {wound::HealingModel::Face, wound::HealingModel::Contraction}) {
        Scene scene("abrasion", model, {});
        for (const double day : days) {
            const wound::WoundDay today = wound::wound_at(scene.prepared, scene.healing, day);
            const wound::DayMaps maps = scene.maps_on(today);
            const wound::WoundLook look = scene.look(today, maps);
            for (const auto highlight : {std::optional<optics::WardModel>(),
                                         {optics::WardModel::Bounded},
                                         {optics::WardModel::Published}})
            {
                const optics::Shading shading = lit(highlight);
                const Difference found = compare(scene.draw(today, shading, {light}), [&](int x, int y) {
                    const wound::SkinPoint skin =
                        wound::with_wound({own_albedo, mapped}, look, scene.place(x, y), shading.blend_model);
                    return lit_radiance(skin, shading, light, head::to_cv(scene.position(x, y)));
                });
                const std::string where =
                    fmt::format("model {}, day {}, {}", int(model), day,
                                highlight ? fmt::format("highlight {}", int(*highlight)) : "diffuse light");
                EXPECT_LT(found.largest, highlight ? .05 : of_color.largest) << where;
                EXPECT_LT(found.mean, highlight ? 5e-4 : of_color.mean) << where;
            }
        }
    }
}

// In a hollow of the head the surroundings are dimmed and the skin around sends light back; the highlight
// stays.
TEST_F(SkinBlendOnGpu, OcclusionOfTheHeadEqualsThatOfTheCpu)
{
    constexpr float open = .4f;
    const optics::Light light{.kind = optics::LightKind::Directional,
                              .position = {0, 0, 0},
                              .direction = cv::normalize(cv::Vec3d(.5, .4, .8))};
    const base::Color ambient(.3, .35, .4);
    const cv::Vec3d mapped = cv::normalize(cv::Vec3d(normal_code) / 255. * 2 - cv::Vec3d(1, 1, 1));
    Scene scene("abrasion", wound::HealingModel::Face, {}, open);
    const wound::WoundDay today = wound::wound_at(scene.prepared, scene.healing, 3);
    const wound::DayMaps maps = scene.maps_on(today);
    const wound::WoundLook look = scene.look(today, maps);
    optics::Shading shading = lit({});
    shading.ambient = ambient;
    const Difference found = compare(scene.draw(today, shading, {light}), [&](int x, int y) {
        const wound::SkinPoint skin =
            wound::with_wound({own_albedo, mapped}, look, scene.place(x, y), shading.blend_model);
        const base::Color albedo = shading.rho_d * skin.albedo;
        const base::Color around = albedo.mul(optics::visibility(open * skin.occlusion, albedo)).mul(ambient);
        const base::Color bounced =
            optics::bounced_share(open, skin.normal.dot(light.direction)) * albedo.mul(albedo);
        return lit_radiance(skin, shading, light, head::to_cv(scene.position(x, y))) + around + bounced;
    });
    EXPECT_LT(found.largest, of_color.largest);
    EXPECT_LT(found.mean, 1.2 * of_color.mean); // the errors of lamp, surroundings and bounce add up
}

// The patch leans away from the wall, so that the wound on the skin fades with the height above the plane of
// the patch and with the angle.
TEST_F(SkinBlendOnGpu, FadesWithTheProjectionAsOnTheCpu)
{
    for (const double lean_deg : {50., 70.}) {
        const double lean = glm::radians(lean_deg);
        head::Anchor anchor;
        anchor.down = {0, -std::cos(lean), std::sin(lean)};
        anchor.normal = {0, std::sin(lean), std::cos(lean)};
        Scene scene("abrasion", wound::HealingModel::Face, anchor);
        const wound::WoundDay today = wound::wound_at(scene.prepared, scene.healing, 3);
        const Difference found =
            compare_color(scene, today, scene.maps_on(today), optics::BlendModel::Corrected);
        EXPECT_LT(found.largest, of_color.largest) << lean_deg;
        EXPECT_LT(found.mean, of_color.mean) << lean_deg;
    }
}
