// Tissue by its chromophores: colours near measured skin, and what healing does to them.
#include <cmath>
#include <gtest/gtest.h>

#include "wound/skin_presets.hpp"

using namespace wound;

namespace {

const RungOptions few_angles{.angles = 4};

Spectrum spectrum_of(const SkinLayers& tissue)
{
    const std::vector<double> channels = diffuse_color(tissue, Rung::AddingDoubling, few_angles);
    Spectrum result{};
    std::copy(channels.begin(), channels.end(), result.begin());
    return result;
}

Lab measured_like(std::string_view preset)
{
    return lab_10_degrees(spectrum_of(*tissue_preset(preset)));
}

double redness(const Color& color)
{
    return lab_from_linear(color).a;
}

Color fast_color(const SkinLayers& tissue)
{
    return tissue_color(tissue, Rung::Calibrated);
}

} // namespace

TEST(Spectrum, WhiteAndGreyKeepTheirColour)
{
    for (double grey : {0., .18, 1.}) {
        Spectrum flat;
        flat.fill(grey);
        const Color color = linear_rgb(flat);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], grey, 1e-12);
        const Lab lab = lab_10_degrees(flat);
        EXPECT_NEAR(lab.a, 0, 1e-9);
        EXPECT_NEAR(lab.b, 0, 1e-9);
    }
}

TEST(Spectrum, SingleWavelengthsHaveTheirHue)
{
    const auto line = [](double nm) {
        Spectrum s{};
        s[static_cast<std::size_t>((nm - 400) / 10)] = 1;
        return linear_rgb(s);
    };
    EXPECT_GT(line(640)[0], 5 * std::abs(line(640)[1]));
    EXPECT_GT(line(530)[1], .1);
    EXPECT_LT(line(530)[0], 0); // outside the gamut
    EXPECT_GT(line(450)[2], 5 * std::abs(line(450)[1]));
}

TEST(Spectrum, KnowsOneThreeAndSpectralChannelsOnly)
{
    EXPECT_EQ(channel_weights(1).size(), 1u);
    EXPECT_EQ(channel_weights(3).size(), 3u);
    EXPECT_EQ(channel_weights(wavelength_count).size(), wavelength_count);
    EXPECT_TRUE(channel_weights(4).empty());
}

TEST(Chromophores, BloodAbsorbsAsTabulated)
{
    // Prahl 1999 at 540 nm: 150 g/l haemoglobin, oxygenated 28.5, deoxygenated 24.9 mm^-1. Jacques:
    // melanosomes 67.9 mm^-1 at 500 nm.
    const Layer oxygenated = chromophore_layer("", {.blood = 1, .oxygenation = 1, .baseline = 0}, .9, 1.4, 1);
    const Layer bloodless = chromophore_layer("", {.blood = 1, .oxygenation = 0, .baseline = 0}, .9, 1.4, 1);
    const Layer melanin = chromophore_layer("", {.melanosomes = 1}, .9, 1.4, 1);
    EXPECT_NEAR(oxygenated.sigma_a[14], 28.51, .01);
    EXPECT_NEAR(bloodless.sigma_a[14], 24.95, .01);
    EXPECT_NEAR(melanin.sigma_a[10], 67.9, .1);
    const Layer bile = chromophore_layer("", {.bilirubin_mmol_l = 1, .water = 0, .baseline = 0}, .9, 1.4, 1);
    EXPECT_NEAR(bile.sigma_a[6], std::log(10.) * 53808 * 1e-4, 1e-9);
}

TEST(Chromophores, SkinPresetsLandOnMeasuredSkin)
{
    for (const MeasuredSkin& skin : measured_skins())
        EXPECT_LT(delta_e2000(measured_like(skin.preset), skin.lab), skin.preset == "dark" ? 2.3 : 1.0)
            << skin.preset;
}

TEST(Chromophores, GranulationTissueIsRedAndTable1IsNot)
{
    const double bed = redness(fast_color(*tissue_preset("granulation")));
    EXPECT_GT(bed, 25);
    EXPECT_GT(bed, redness(fast_color(*tissue_preset("light"))) + 12);
    // Taking Table 1's epidermis away makes it lighter in every channel and less red.
    const Color whole = fast_color(table1()),
                stripped = fast_color(layers_at(restored_skin(table1(), 1), .2));
    for (int c = 0; c < 3; ++c)
        EXPECT_GT(stripped[c], whole[c]);
    EXPECT_LT(redness(stripped), redness(whole));
}

TEST(Chromophores, ThreeWavelengthsAreNotAColour)
{
    const Spectrum s = spectrum_of(*tissue_preset("light"));
    const Color shortcut(s[21], s[14], s[5]); // 610, 540, 450 nm
    EXPECT_GT(delta_e2000(lab_from_linear(shortcut), lab_from_linear(linear_rgb(s))), 3);
}

TEST(HealingTimeline, AnUninjuredPlaceIsIntactSkinOnEveryDay)
{
    const HealingTissue light = skin(SkinTone::Light);
    const Color intact = fast_color(*tissue_preset("light"));
    for (double day : {0., 1., 7., 20., 60., 365.}) {
        EXPECT_LT(cv::norm(fast_color(layers_at(open_bed(light, day, .5), 0)) - intact), 1e-12);
        EXPECT_LT(cv::norm(fast_color(layers_at(covered_bed(light, day, 21), 0)) - intact), 1e-12);
    }
}

TEST(HealingTimeline, BedIsRedderThanTheRingAndTheRingThanSkin)
{
    for (SkinTone tone : {SkinTone::Light, SkinTone::Medium}) {
        const HealingTissue tissue = skin(tone);
        const double intact = redness(fast_color(skin(tone).layers()));
        for (double day : {7., 14., 20.}) {
            const double bed = redness(fast_color(layers_at(open_bed(tissue, day, .5), 1)));
            const double ring = redness(fast_color(layers_at(covered_bed(tissue, day, 21), 1)));
            EXPECT_GT(bed, ring);
            EXPECT_GT(ring, intact + 2);
        }
    }
}

TEST(HealingTimeline, TissueOfATableGetsBloodInItsRingAsWell)
{
    const SkinLayers table = table1();
    const Color intact = fast_color(table);
    EXPECT_LT(cv::norm(fast_color(layers_at(covered_bed(table, 9, 21), 0)) - intact), 1e-12);
    double before = 1e9;
    for (double day : {5., 20., 60., 200., 700.}) {
        const TissueDay ring = covered_bed(table, day, 21);
        const auto blood = [&](std::size_t c) {
            return ring.regrown.sigma_a[c] - table.layers[1].sigma_a[c];
        };
        EXPECT_GT(blood(1), 5 * blood(0)) << "green more than red, day " << day;
        const double change = cv::norm(fast_color(layers_at(ring, 1)) - intact);
        EXPECT_GT(change, .001) << day;
        EXPECT_LT(change, before) << day;
        before = change;
    }
    // Of one wavelength nobody knows how blood absorbs it.
    const SkinLayers grey{
        .layers = {{.name = "", .sigma_a = {.1}, .sigma_s_reduced = {1}, .thickness_mm = 2}}};
    EXPECT_EQ(covered_bed(grey, 9, 21).regrown.sigma_a, grey.layers[0].sigma_a);
}

TEST(HealingTimeline, TheScarFadesTowardsSkin)
{
    const HealingTissue light = skin(SkinTone::Light);
    const Lab intact = lab_from_linear(fast_color(*tissue_preset("light")));
    double before = 1e9;
    for (double months : {1., 3., 6., 12., 24.}) {
        const Color scar = fast_color(layers_at(covered_bed(light, 21 + 30.44 * months, 21), 1));
        const double excess = lab_from_linear(scar).a - intact.a;
        EXPECT_GT(excess, 0);
        EXPECT_LT(excess, before);
        before = excess;
    }
    EXPECT_LT(before, 4);
}

TEST(HealingTimeline, ColourHasNoStepFromDayToDay)
{
    const HealingTissue dark = skin(SkinTone::Dark);
    for (double depth : {.05, .5, 2.})
        for (double day = 4; day < 90; day += .25) {
            const auto at = [&](double d) { return fast_color(layers_at(covered_bed(dark, d, 21), depth)); };
            EXPECT_LT(cv::norm(at(day + .25) - at(day)), .01) << day;
        }
}

TEST(Bruise, TurnsFromDarkToYellowAndGoes)
{
    const ChromophoreSkin light = skin(SkinTone::Light);
    const auto lab = [&](double day) { return lab_from_linear(fast_color(bruise(light, day))); };
    const Lab intact = lab_from_linear(fast_color(light.layers()));
    EXPECT_LT(lab(1).l, intact.l - 3);
    EXPECT_GT(lab(9).b - lab(9).a, intact.b - intact.a); // yellow
    EXPECT_LT(lab(1).b - lab(1).a, lab(9).b - lab(9).a);
    EXPECT_LT(delta_e2000(lab(40), intact), 1);
}

TEST(Presets, AllNamesGiveTissueThatReflects)
{
    for (std::string_view name : tissue_preset_names()) {
        const auto tissue = tissue_preset(name);
        ASSERT_TRUE(tissue) << name;
        const Color color = fast_color(*tissue);
        for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(color[c] > 0 && color[c] < 1) << name;
    }
    EXPECT_FALSE(tissue_preset("green"));
    EXPECT_FALSE(healing_tissue_named("scar"));
}
