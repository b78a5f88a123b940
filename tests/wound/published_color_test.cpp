// The published bed's colour from day to day: eq. (4) with R of eqs. (2) and (3) in their domain.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "wound/depth.hpp"
#include "wound/optics/shading.hpp"
#include "wound/reflectance_table.hpp"

namespace {

constexpr double last_day = 30;

/// Degrees: 0 red, 60 yellow, 120 green, -60 magenta.
double hue_deg(const base::Color& c)
{
    return std::atan2(std::sqrt(3.) * (c[1] - c[2]), 2 * c[0] - c[1] - c[2]) * 180 / CV_PI;
}

/// A bed that heals by contraction, as published mode shows it.
struct Bed
{
    Bed(std::string_view name, const wound::TissueThickness& thickness)
        : tissue(wound::at_place(*optics::healing_tissue_named(name), thickness)),
          skin(name == "table1" ? base::Color(.45, .25, .19)
                                : tissue_color(layers(), optics::ReflectanceModel::Calibrated))
    {
        healing.model = wound::HealingModel::Contraction;
        const wound::LutRows rows = wound::lut_rows(tissue, healing, wound::lut_size, last_day);
        table =
            wound::bake_reflectance_table(rows.days, wound::lut_size, optics::ReflectanceModel::Published);
        axes = rows.axes;
    }
    optics::SkinLayers layers() const
    {
        const auto* given = std::get_if<optics::SkinLayers>(&tissue);
        return given != nullptr ? *given : std::get<optics::ChromophoreSkin>(tissue).layers();
    }
    base::Color color(const base::Color& texture, double depth_mm, double day) const
    {
        return optics::blend(optics::BlendModel::Published, texture,
                             wound::sample_table(table, axes, shared::LUT_OPEN, depth_mm, day), skin,
                             wound::healing_at(healing, day).recovery_ratio);
    }
    /// C(1) of eq. (4).
    base::Color end(const base::Color& texture) const
    {
        return optics::blend(optics::BlendModel::Published, texture,
                             optics::tissue_color(layers(), optics::ReflectanceModel::Published), skin, 1);
    }

    optics::HealingTissue tissue;
    base::Color skin;
    wound::Healing healing;
    cv::Mat3f table;
    shared::LutAxes axes{};
};

} // namespace

// By its hue the way leads from the texture's end to the other. It leaves their interval a little: Table 1
// without its epidermis reflects more blue than green, which pulls a deep bed towards red, and thin skin over
// granulation tissue is yellower than skin. Green is far away, at 120 degrees.
TEST(PublishedColor, GoesFromTheTextureToItsEndWithoutTurningGreen)
{
    constexpr double redder_deg = 4, yellower_deg = 2;
    const base::Color fresh(.30, .035, .03), dark(.09, .012, .010), graze(.45, .17, .13);
    const wound::TissueThickness eyelid = wound::tissue_thickness({.3, .28}),
                                 nose = wound::tissue_thickness({0, 0});
    for (const char* name : {"table1", "light", "medium", "dark"})
        for (const wound::TissueThickness& place : {wound::TissueThickness{}, eyelid, nose}) {
            const Bed bed(name, place);
            for (const base::Color& texture : {fresh, dark, graze}) {
                const base::Color end = bed.end(texture);
                const auto [low, high] = std::minmax({hue_deg(texture), hue_deg(end)});
                for (const double depth_mm : {.05, .15, .5, 1.2, 2.5}) {
                    const std::string where = fmt::format("{}, dermis {:.2f} mm, texture {:.2f}, depth {}",
                                                          name, place.dermis, texture[0], depth_mm);
                    EXPECT_EQ(bed.color(texture, depth_mm, 0), texture) << where;
                    EXPECT_LT(cv::norm(bed.color(texture, depth_mm, last_day) - end, cv::NORM_INF), .05)
                        << where;
                    for (double day = 0; day <= last_day; day += .5) {
                        const base::Color now = bed.color(texture, depth_mm, day);
                        EXPECT_TRUE(std::ranges::all_of(now.val, [](double c) { return c >= 0 && c <= 1; }))
                            << where << ", day " << day;
                        EXPECT_LT(now[1], now[0]) << where << ", day " << day;
                        EXPECT_GT(hue_deg(now), low - redder_deg) << where << ", day " << day;
                        EXPECT_LT(hue_deg(now), high + yellower_deg) << where << ", day " << day;
                    }
                }
            }
        }
}
