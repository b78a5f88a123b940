// Tissue described by chromophores: its colour against measured skin, and its change during healing.
#include <cmath>
#include <gtest/gtest.h>

#include "wound/optics/skin_presets.hpp"

namespace {

const optics::ReflectanceOptions few_angles{.angles = 4};

optics::Spectrum spectrum_of(const optics::SkinLayers& tissue)
{
    const std::vector<double> channels =
        optics::diffuse_color(tissue, optics::ReflectanceModel::AddingDoubling, few_angles);
    optics::Spectrum result{};
    std::copy(channels.begin(), channels.end(), result.begin());
    return result;
}

base::Lab measured_like(std::string_view preset)
{
    return optics::lab_10_degrees(spectrum_of(*optics::tissue_preset(preset)));
}

double redness(const base::Color& color)
{
    return base::lab_from_linear(color).a;
}

base::Color fast_color(const optics::SkinLayers& tissue)
{
    return optics::tissue_color(tissue, optics::ReflectanceModel::Calibrated);
}

} // namespace

TEST(Spectrum, WhiteAndGreyKeepTheirColour)
{
    for (double grey : {0., .18, 1.}) {
        optics::Spectrum flat;
        flat.fill(grey);
        const base::Color color = optics::linear_rgb(flat);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], grey, 1e-12);
        const base::Lab lab = optics::lab_10_degrees(flat);
        EXPECT_NEAR(lab.a, 0, 1e-9);
        EXPECT_NEAR(lab.b, 0, 1e-9);
    }
}

TEST(Spectrum, SingleWavelengthsHaveTheirHue)
{
    const auto line = [](double nm) {
        optics::Spectrum s{};
        s[static_cast<std::size_t>((nm - 400) / 10)] = 1;
        return optics::linear_rgb(s);
    };
    EXPECT_GT(line(640)[0], 5 * std::abs(line(640)[1]));
    EXPECT_GT(line(530)[1], .1);
    EXPECT_LT(line(530)[0], 0); // outside the gamut
    EXPECT_GT(line(450)[2], 5 * std::abs(line(450)[1]));
}

TEST(Spectrum, AcceptsOneThreeOrSpectralChannels)
{
    EXPECT_EQ(optics::channel_weights(1).size(), 1u);
    EXPECT_EQ(optics::channel_weights(3).size(), 3u);
    EXPECT_EQ(optics::channel_weights(optics::wavelength_count).size(), optics::wavelength_count);
    EXPECT_TRUE(optics::channel_weights(4).empty());
}

TEST(Chromophores, BloodAbsorbsAsTabulated)
{
    // Prahl 1999 at 540 nm: 150 g/l haemoglobin, oxygenated 28.5, deoxygenated 24.9 mm^-1. Jacques:
    // melanosomes 67.9 mm^-1 at 500 nm.
    const optics::Layer oxygenated =
        optics::chromophore_layer("", {.blood = 1, .oxygenation = 1, .baseline = 0}, .9, 1.4, 1);
    const optics::Layer deoxygenated =
        optics::chromophore_layer("", {.blood = 1, .oxygenation = 0, .baseline = 0}, .9, 1.4, 1);
    const optics::Layer melanin = optics::chromophore_layer("", {.melanosomes = 1}, .9, 1.4, 1);
    EXPECT_NEAR(oxygenated.sigma_a[14], 28.51, .01);
    EXPECT_NEAR(deoxygenated.sigma_a[14], 24.95, .01);
    EXPECT_NEAR(melanin.sigma_a[10], 67.9, .1);
    const optics::Layer bile =
        optics::chromophore_layer("", {.bilirubin_mmol_l = 1, .water = 0, .baseline = 0}, .9, 1.4, 1);
    EXPECT_NEAR(bile.sigma_a[6], std::log(10.) * 53808 * 1e-4, 1e-9);
}

TEST(Chromophores, SkinPresetsMatchMeasuredSkin)
{
    for (const optics::MeasuredSkin& skin : optics::measured_skins())
        EXPECT_LT(base::delta_e2000(measured_like(skin.preset), skin.lab), skin.preset == "dark" ? 2.3 : 1.0)
            << skin.preset;
}

TEST(Chromophores, GranulationTissueIsRedAndTable1IsNot)
{
    const double bed = redness(fast_color(*optics::tissue_preset("granulation")));
    EXPECT_GT(bed, 25);
    EXPECT_GT(bed, redness(fast_color(*optics::tissue_preset("light"))) + 12);
    // Table 1's skin without its epidermis is lighter in every channel and less red.
    const base::Color whole = fast_color(optics::table1()),
                      stripped =
                          fast_color(optics::layers_at(optics::restored_skin(optics::table1(), 1), .2));
    for (int c = 0; c < 3; ++c)
        EXPECT_GT(stripped[c], whole[c]);
    EXPECT_LT(redness(stripped), redness(whole));
}

TEST(Chromophores, ThreeWavelengthsDoNotGiveTheColour)
{
    const optics::Spectrum s = spectrum_of(*optics::tissue_preset("light"));
    const base::Color shortcut(s[21], s[14], s[5]); // 610, 540, 450 nm
    EXPECT_GT(
        base::delta_e2000(base::lab_from_linear(shortcut), base::lab_from_linear(optics::linear_rgb(s))), 3);
}

TEST(HealingTimeline, AnUninjuredPlaceIsIntactSkinOnEveryDay)
{
    const optics::HealingTissue light = optics::skin(optics::SkinTone::Light);
    const base::Color intact = fast_color(*optics::tissue_preset("light"));
    for (double day : {0., 1., 7., 20., 60., 365.}) {
        EXPECT_LT(cv::norm(fast_color(optics::layers_at(optics::open_bed(light, day, .5), 0)) - intact),
                  1e-12);
        EXPECT_LT(cv::norm(fast_color(optics::layers_at(optics::covered_bed(light, day, 21), 0)) - intact),
                  1e-12);
    }
}

TEST(HealingTimeline, BedIsRedderThanTheRingAndTheRingThanSkin)
{
    for (optics::SkinTone tone : {optics::SkinTone::Light, optics::SkinTone::Medium}) {
        const optics::HealingTissue tissue = optics::skin(tone);
        const double intact = redness(fast_color(optics::skin(tone).layers()));
        for (double day : {7., 14., 20.}) {
            const double bed = redness(fast_color(optics::layers_at(optics::open_bed(tissue, day, .5), 1)));
            const double ring =
                redness(fast_color(optics::layers_at(optics::covered_bed(tissue, day, 21), 1)));
            EXPECT_GT(bed, ring);
            EXPECT_GT(ring, intact + 2);
        }
    }
}

TEST(HealingTimeline, TissueOfATableGetsBloodInItsRingAsWell)
{
    const optics::SkinLayers table = optics::table1();
    const base::Color intact = fast_color(table);
    EXPECT_LT(cv::norm(fast_color(optics::layers_at(optics::covered_bed(table, 9, 21), 0)) - intact), 1e-12);
    double before = 1e9;
    for (double day : {5., 20., 60., 200., 700.}) {
        const optics::TissueDay ring = optics::covered_bed(table, day, 21);
        const auto blood = [&](std::size_t c) {
            return ring.regrown.sigma_a[c] - table.layers[1].sigma_a[c];
        };
        EXPECT_GT(blood(1), 5 * blood(0)) << "green more than red, day " << day;
        const double change = cv::norm(fast_color(optics::layers_at(ring, 1)) - intact);
        EXPECT_GT(change, .001) << day;
        EXPECT_LT(change, before) << day;
        before = change;
    }
    // A single channel has no known wavelength, so no blood is added.
    const optics::SkinLayers grey{
        .layers = {{.name = "", .sigma_a = {.1}, .sigma_s_reduced = {1}, .thickness_mm = 2}}};
    EXPECT_EQ(optics::covered_bed(grey, 9, 21).regrown.sigma_a, grey.layers[0].sigma_a);
}

TEST(HealingTimeline, TheScarFadesTowardsSkin)
{
    const optics::HealingTissue light = optics::skin(optics::SkinTone::Light);
    const base::Lab intact = base::lab_from_linear(fast_color(*optics::tissue_preset("light")));
    double before = 1e9;
    for (double months : {1., 3., 6., 12., 24.}) {
        const base::Color scar =
            fast_color(optics::layers_at(optics::covered_bed(light, 21 + 30.44 * months, 21), 1));
        const double excess = base::lab_from_linear(scar).a - intact.a;
        EXPECT_GT(excess, months < 24 ? 0 : -1);
        EXPECT_LT(excess, before);
        before = excess;
    }
    EXPECT_NEAR(before, 0, 1) << "an old scar may be a little paler than skin, as its collagen is denser";
}

TEST(HealingTimeline, ColourHasNoStepFromDayToDay)
{
    const optics::HealingTissue dark = optics::skin(optics::SkinTone::Dark);
    for (double depth : {.05, .5, 2.})
        for (double day = 4; day < 90; day += .25) {
            const auto at = [&](double d) {
                return fast_color(optics::layers_at(optics::covered_bed(dark, d, 21), depth));
            };
            EXPECT_LT(cv::norm(at(day + .25) - at(day)), .01) << day;
        }
}

TEST(Bruise, TurnsFromDarkToYellowAndFades)
{
    const optics::ChromophoreSkin light = optics::skin(optics::SkinTone::Light);
    const auto lab = [&](double day) {
        return base::lab_from_linear(fast_color(optics::bruise(light, day)));
    };
    const base::Lab intact = base::lab_from_linear(fast_color(light.layers()));
    EXPECT_LT(lab(1).l, intact.l - 3);
    EXPECT_GT(lab(9).b - lab(9).a, intact.b - intact.a); // yellow
    EXPECT_LT(lab(1).b - lab(1).a, lab(9).b - lab(9).a);
    EXPECT_LT(base::delta_e2000(lab(40), intact), 1);
}

TEST(Presets, AllNamesGiveTissueThatReflects)
{
    for (std::string_view name : optics::tissue_preset_names()) {
        const auto tissue = optics::tissue_preset(name);
        ASSERT_TRUE(tissue) << name;
        const base::Color color = fast_color(*tissue);
        for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(color[c] > 0 && color[c] < 1) << name;
    }
    EXPECT_FALSE(optics::tissue_preset("green"));
    EXPECT_FALSE(optics::healing_tissue_named("scar"));
}
