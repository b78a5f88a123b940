// The analytic models against published values and against properties that hold for any tissue.
#include "wound/optics/reflectance.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/input_error.hpp"
#include "wound/optics/fresnel.hpp"
#include "wound/optics/healing_tissue.hpp"
#include "wound/optics/skin_presets.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/optics/tissue_file.hpp"

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

auto rgb(double r, double g, double b, double tolerance)
{
    return ElementsAre(DoubleNear(r, tolerance), DoubleNear(g, tolerance), DoubleNear(b, tolerance));
}

} // namespace

TEST(Fresnel, DiffuseReflectanceHasThePublishedValues)
{
    EXPECT_NEAR(optics::diffuse_fresnel(1.1, 1), .194345, 1e-6);
    EXPECT_NEAR(optics::diffuse_fresnel(1.4, 1), .528985, 1e-6);
    EXPECT_NEAR(optics::diffuse_fresnel(1.5, 1), .596346, 1e-6);
    EXPECT_NEAR(optics::diffuse_fresnel(1, 1.4), .076812, 1e-6);
    EXPECT_NEAR(optics::diffuse_fresnel(1, 1.5), .091778, 1e-6);
}

TEST(Fresnel, ClosedFormIsTheIntegralOverTheHemisphere)
{
    for (double ratio : {1.0001, 1.01, 1.049, 1.051, 1.1, 1.333, 1.5, 2.0, 3.0}) {
        // F_dr = 2 integral F(mu) mu dmu, by the midpoint rule in sqrt(mu), which is smooth at grazing light.
        double sum = 0;
        const int count = 200000;
        for (int i = 0; i < count; ++i) {
            const double mu = (i + .5) / count * (i + .5) / count;
            sum += 2 * optics::fresnel(1, ratio, mu) * mu * 2 * (i + .5) / count / count;
        }
        EXPECT_NEAR(optics::diffuse_fresnel(1, ratio), sum, 1e-8) << ratio;
    }
}

TEST(Fresnel, IsContinuousAndNonNegativeTowardsEqualIndices)
{
    EXPECT_EQ(optics::diffuse_fresnel(1.4, 1.4), 0);
    for (double x = 1e-12; x < .2; x *= 1.3) {
        EXPECT_GE(optics::diffuse_fresnel(1, 1 + x), 0);
        EXPECT_LE(optics::diffuse_fresnel(1, 1 + x), x);
        EXPECT_NEAR(optics::diffuse_fresnel(1 + x, 1), 7 * x / 3, 10 * x * x + 3e-6); // from the series
    }
    EXPECT_NEAR(optics::diffuse_fresnel(1, 1.05 - 1e-9), optics::diffuse_fresnel(1, 1.05 + 1e-9), 1e-9);
}

TEST(Fresnel, PolynomialStaysWithinItsStatedError)
{
    for (double n = 1; n <= 2; n += .01)
        EXPECT_NEAR(optics::diffuse_fresnel_polynomial(n, 1), optics::diffuse_fresnel(n, 1), .0017) << n;
}

TEST(BackwardFraction, HasTheValuesOfTheIntegralAndIsStable)
{
    EXPECT_NEAR(optics::backward_fraction(.2), .353394, 1e-6);
    EXPECT_NEAR(optics::backward_fraction(.73), .073473, 1e-6);
    EXPECT_NEAR(optics::backward_fraction(.76), .063355, 1e-6);
    EXPECT_DOUBLE_EQ(optics::backward_fraction(0), .5);
    EXPECT_DOUBLE_EQ(optics::backward_fraction(1), 0);
    EXPECT_DOUBLE_EQ(optics::backward_fraction(-1), 1);
    for (double g = 1e-16; g < 1; g *= 1.5)
        EXPECT_NEAR(optics::backward_fraction(g) + optics::backward_fraction(-g), 1, 1e-15);
}

TEST(Printed, ReproducesThePrintedEquationsOnTable1)
{
    EXPECT_THAT(optics::diffuse_color(optics::table1(), optics::ReflectanceModel::Printed),
                rgb(.399, .211, .168, .001));
    EXPECT_THAT(optics::diffuse_color(optics::table1(.2, 1, 9), optics::ReflectanceModel::Printed),
                rgb(.43, -.05, -.21, .006));
    EXPECT_THAT(optics::diffuse_color(optics::table1(.2, 4, 9), optics::ReflectanceModel::Printed),
                rgb(.33, 1.80, 2.73, .02));
}

TEST(Published, LimitsEveryLayerToTheDomainThatThePaperStates)
{
    // With the paper's thicknesses: the epidermis in G and B, the whole dermis at 4 mm, the whole subcutis.
    std::vector<optics::OutsideDomain> thin = optics::outside_domain(optics::table1(.2, 1, 4)),
                                       thick = optics::outside_domain(optics::table1(.2, 4, 9));
    ASSERT_EQ(thin.size(), 5u);
    EXPECT_EQ(thin[0].layer, 0u);
    EXPECT_EQ(thin[0].channel, 1u);
    EXPECT_NEAR(thin[0].limit_mm, 1 / (1.44 + .353394 * 11), 1e-6);
    EXPECT_EQ(thick.size(), 8u);
    EXPECT_TRUE(optics::outside_domain(optics::table1(.01, .1, .1)).empty());

    // A layer at its limit, made thicker, changes nothing; inside the domain the equations are as printed.
    for (const double subcutis : {4., 9., infinity})
        EXPECT_EQ(optics::diffuse_color(optics::table1(.2, 1, subcutis), optics::ReflectanceModel::Published),
                  optics::diffuse_color(optics::table1(.2, 1, 2), optics::ReflectanceModel::Published));
    EXPECT_EQ(optics::diffuse_color(optics::table1(.1, .5, .5), optics::ReflectanceModel::Published),
              optics::diffuse_color(optics::table1(.1, .5, .5), optics::ReflectanceModel::Printed));
}

TEST(Published, NoteNamesTheLimitedLayersAndChannels)
{
    const auto note = [](const optics::SkinLayers& tissue, optics::ReflectanceModel model) {
        return optics::domain_note(tissue, model).value_or("none");
    };
    EXPECT_THAT(note(optics::table1(), optics::ReflectanceModel::Published),
                AllOf(HasSubstr("5 of 9 layers and channels"), HasSubstr("published takes the limit"),
                      HasSubstr("epidermis 0.2 mm: G 0.188, B 0.162; subcutis 4 mm: R 1.96,")));
    EXPECT_THAT(
        note(optics::table1(), optics::ReflectanceModel::Printed),
        AllOf(HasSubstr("printed goes on"), HasSubstr("epidermis 0.2 mm: G 0.188, B 0.162; subcutis")));
    EXPECT_THAT(note(*optics::tissue_preset("light"), optics::ReflectanceModel::Published),
                AllOf(HasSubstr("dermis 1.8 mm: "), HasSubstr(" of 31 wavelengths, down to ")));
    EXPECT_EQ(note(optics::table1(.01, .1, .1), optics::ReflectanceModel::Published), "none");
    EXPECT_EQ(note(optics::table1(), optics::ReflectanceModel::TwoStream), "none");
}

TEST(Published, TransmittanceIsThatOfEquationTwo)
{
    // T = (1 - sa d - ss' P d)(1 - F_b): of the light inside, so without the first surface's reflection.
    const optics::Stack slab{.layers = {{.1, 2, .3, 1.4, .5}}, .n_above = 1, .n_below = 1.5};
    const double expected =
        (1 - .1 * .5 - 2 * optics::backward_fraction(.3) * .5) * (1 - optics::diffuse_fresnel(1.4, 1.5));
    for (const auto model : {optics::ReflectanceModel::Printed, optics::ReflectanceModel::Published})
        for (const auto light : {optics::Incidence::Diffuse, optics::Incidence::Normal}) {
            const optics::Response response = optics::reflectance(slab, model, {.incidence = light});
            EXPECT_NEAR(response.t, expected, 1e-15);
            EXPECT_GT(response.absorbed.at(0), 0);
        }
    // Layers in turn: the light that one transmits enters the next.
    const optics::Stack two{.layers = {slab.layers[0], {.2, 1, 0, 1.5, .3}}, .n_above = 1, .n_below = 1.5};
    EXPECT_NEAR(optics::reflectance(two, optics::ReflectanceModel::Published).t,
                expected * (1 - .2 * .3 - .5 * .3), 1e-15);
}

TEST(Models, ReachTheStatedColoursOnTable1)
{
    EXPECT_THAT(optics::diffuse_color(optics::table1(), optics::ReflectanceModel::Published),
                rgb(.373, .222, .188, .001));
    EXPECT_THAT(optics::diffuse_color(optics::table1(), optics::ReflectanceModel::Exponential),
                rgb(.584, .400, .371, .001));
    EXPECT_THAT(optics::diffuse_color(optics::table1(), optics::ReflectanceModel::TwoStreamPaper),
                rgb(.455, .211, .185, .001));
    EXPECT_THAT(optics::diffuse_color(optics::table1(), optics::ReflectanceModel::TwoStream),
                rgb(.702, .227, .185, .001));
}

TEST(TwoStream, KubelkaMunkLimitsHold)
{
    EXPECT_DOUBLE_EQ(optics::slab(2, 0, 3).r_top, 6. / 7);
    EXPECT_DOUBLE_EQ(optics::slab(2, 0, 3).t_down, 1. / 7);
    EXPECT_DOUBLE_EQ(optics::slab(0, 2, 3).t_down, std::exp(-6.));
    EXPECT_EQ(optics::slab(0, 2, 3).r_top, 0);
    const double a = 1.5, b = std::sqrt(a * a - 1); // S = 2, K = 1
    EXPECT_NEAR(optics::slab(2, 1, infinity).r_top, a - b, 1e-15);
    EXPECT_NEAR(optics::slab(2, 1, .7).r_top, 1 / (a + b / std::tanh(b * 2 * .7)), 1e-15);
}

TEST(HealingTissue, AnInjuryRemovesLayersFromTheTop)
{
    const optics::TissueDay fresh = optics::restored_skin(optics::table1(), 1);
    EXPECT_EQ(optics::layers_at(fresh, 0).layers.size(), 3u);
    EXPECT_NEAR(optics::layers_at(fresh, .1).layers[0].thickness_mm, .1, 1e-15);
    const optics::SkinLayers bed = optics::layers_at(fresh, .7);
    ASSERT_EQ(bed.layers.size(), 2u);
    EXPECT_EQ(bed.layers[0].name, "dermis");
    EXPECT_NEAR(bed.layers[0].thickness_mm, .5, 1e-12);
    EXPECT_EQ(optics::layers_at(fresh, 1e9).layers.back().thickness_mm, 2);
    // Table 1's skin without its epidermis is lighter, not red.
    EXPECT_THAT(optics::diffuse_color(optics::layers_at(fresh, .2), optics::ReflectanceModel::TwoStream),
                rgb(.732, .422, .423, .025));
}

TEST(HealingTissue, ColourIsContinuousInTheDepth)
{
    const optics::TissueDay fresh = optics::restored_skin(optics::table1(), 1);
    std::vector<double> before =
        optics::diffuse_color(optics::layers_at(fresh, 0), optics::ReflectanceModel::TwoStream);
    for (double depth = 0; depth < optics::deepest_injury_mm(fresh.intact); depth += 1e-3) {
        const std::vector<double> now =
            optics::diffuse_color(optics::layers_at(fresh, depth), optics::ReflectanceModel::TwoStream);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(now[c], before[c], .006) << depth;
        before = now;
    }
}

TEST(HealingTissue, PaperKeepsTheIndexOfWhatIsLeftOfALayer)
{
    const optics::TissueDay fresh = optics::restored_skin(optics::table1(), 1);
    for (const double depth : {.05, .16, .199}) {
        EXPECT_EQ(optics::layers_at(fresh, depth, true).layers[0].n, 1.5) << depth;
        EXPECT_EQ(optics::layers_at(fresh, depth).layers[0].n == 1.5, depth < .15) << depth;
    }
}

TEST(HealingTissue, RestoredSkinIsIntactSkinAtDepthZero)
{
    EXPECT_EQ(optics::diffuse_color(optics::layers_at(optics::restored_skin(optics::table1(), 0), 2),
                                    optics::ReflectanceModel::TwoStream),
              optics::diffuse_color(optics::table1(), optics::ReflectanceModel::TwoStream));
    EXPECT_EQ(optics::diffuse_color(optics::layers_at(optics::restored_skin(optics::table1(), .5), 2),
                                    optics::ReflectanceModel::TwoStream),
              optics::diffuse_color(optics::layers_at(optics::restored_skin(optics::table1(), 1), 1),
                                    optics::ReflectanceModel::TwoStream));
}

TEST(HealingTissue, RegrownTissueAndCoverLieOnTheRemainingTissue)
{
    optics::TissueDay day = optics::restored_skin(optics::table1(), .25);
    day.regrown_ratio = .75;
    day.regrown.name = "granulation";
    day.cover.name = "new epithelium";
    day.cover.thickness_mm = .05;
    const optics::SkinLayers layers = optics::layers_at(day, .8);
    ASSERT_EQ(layers.layers.size(), 4u);
    EXPECT_EQ(layers.layers[0].name, "new epithelium");
    EXPECT_EQ(layers.layers[1].name, "granulation");
    EXPECT_NEAR(layers.layers[1].thickness_mm, .6, 1e-12);
    EXPECT_NEAR(layers.layers[2].thickness_mm, .4, 1e-12);
}

namespace {

std::string message_of(const std::string& text)
{
    try {
        optics::parse_tissue(nlohmann::json::parse(text), "t.json");
    } catch (const base::InputError& error) {
        return error.what();
    }
    return "no error";
}

const std::string good_layer =
    R"({"name":"a","sigma_a":[1,2,3],"sigma_s":10,"g":0.8,"n":1.4,"thickness_mm":"inf"})";

std::string tissue_with(const std::string& layer)
{
    return R"({"unit":"1/cm","layers":[)" + layer + "]}";
}

} // namespace

TEST(TissueFile, UnitsAndScatteringAreConverted)
{
    const optics::SkinLayers tissue =
        optics::parse_tissue(nlohmann::json::parse(tissue_with(good_layer)), "t.json");
    ASSERT_EQ(tissue.channels(), 3u);
    EXPECT_DOUBLE_EQ(tissue.layers[0].sigma_a[1], .2);
    EXPECT_NEAR(tissue.layers[0].sigma_s_reduced[2], .2, 1e-15);
    EXPECT_EQ(tissue.layers[0].thickness_mm, infinity);
    EXPECT_EQ(tissue.n_below, 1);
}

TEST(TissueFile, MistakesAreNamedWithFileAndField)
{
    const auto layer_with = [](const std::string& from, const std::string& to) {
        std::string text = good_layer;
        return message_of(tissue_with(text.replace(text.find(from), from.size(), to)));
    };
    EXPECT_THAT(message_of(R"({"layers":[]})"), HasSubstr("t.json: /unit: is missing"));
    EXPECT_THAT(message_of(R"({"unit":"1/m","layers":[]})"),
                HasSubstr("t.json: /unit: is \"1/m\"; choose one of 1/mm, 1/cm"));
    EXPECT_THAT(message_of(R"({"unit":"1/mm","layers":[]})"), HasSubstr("t.json: /layers: is not a list"));
    EXPECT_THAT(message_of("[1]"), HasSubstr("t.json: : must be an object"));
    EXPECT_THAT(message_of(R"({"unit":"1/mm","colour":1,"layers":[)" + good_layer + "]}"),
                HasSubstr("/colour: is not a known field"));
    EXPECT_THAT(layer_with("0.8", "1.5"),
                HasSubstr("t.json: /layers/0/g: is 1.5; give a number from -1 to 1"));
    EXPECT_THAT(layer_with("[1,2,3]", "[1,-2,3]"), HasSubstr("/layers/0/sigma_a: holds -2; give"));
    EXPECT_THAT(layer_with("[1,2,3]", "\"red\""), HasSubstr("/layers/0/sigma_a: is \"red\"; give a number"));
    EXPECT_THAT(layer_with("[1,2,3]", "[]"), HasSubstr("/layers/0/sigma_a: is an empty array"));
    EXPECT_THAT(layer_with("\"inf\"", "-1"),
                HasSubstr("/layers/0/thickness_mm: is -1; give a number from 0"));
    EXPECT_THAT(layer_with("\"n\":1.4,", ""), HasSubstr("/layers/0/n: is missing"));
    EXPECT_THAT(layer_with("\"n\":1.4", "\"n\":0.5"),
                HasSubstr("/layers/0/n: is 0.5; give a number from 1 to 3"));
    EXPECT_THAT(layer_with("\"sigma_s\":10,", ""), HasSubstr("scattering is given twice or not at all"));
    EXPECT_THAT(layer_with("\"name\":\"a\"", "\"name\":1"), HasSubstr("/layers/0/name: is 1; write a text"));
    EXPECT_THAT(
        message_of(tissue_with(good_layer + R"(,{"sigma_a":[1,2],"sigma_s":1,"n":1,"thickness_mm":1})")),
        HasSubstr("/layers/1: 2 channels where another layer has 3"));
    EXPECT_THAT(layer_with(R"("sigma_s":10)", R"("chromophores":{})"),
                HasSubstr("/layers/0/sigma_a: is given beside chromophores"));
    EXPECT_THROW(optics::read_tissue("/nonexistent/tissue.json"), base::InputError);
}

TEST(TissueFile, ChromophoresMakeASpectrum)
{
    const auto parse = [](const std::string& content) {
        return optics::parse_tissue(
            nlohmann::json::parse(R"({"unit":"1/mm","layers":[{"n":1.4,"thickness_mm":1,"chromophores":)" +
                                  content + R"(},{"n":1.4,"thickness_mm":1,"sigma_a":0.2,"sigma_s":3}]})"),
            "t.json");
    };
    const optics::SkinLayers tissue =
        parse(R"({"blood":1,"oxygenation":1,"baseline":0,"scattering_500nm_per_mm":2})");
    ASSERT_EQ(tissue.channels(), 31u);
    EXPECT_NEAR(tissue.layers[0].sigma_a[14], 28.51, .01);
    EXPECT_NEAR(tissue.layers[0].sigma_s_reduced[10], 2, 1e-12);
    EXPECT_EQ(tissue.layers[1].sigma_a[30], .2);
    EXPECT_THROW(parse(R"({"blood":1.5})"), base::InputError);
    EXPECT_THROW(parse(R"({"wine":1})"), base::InputError);
}

TEST(HenyeyGreenstein, HasItsAnisotropyAsMeanCosine)
{
    for (const double g : {-.9, -.3, 0.0, .5, .8, .95}) {
        double sum = 0;
        constexpr int count = 20'000;
        for (int i = 0; i < count; ++i)
            sum += optics::henyey_greenstein_cosine(g, (i + .5) / count);
        EXPECT_NEAR(sum / count, g, 1e-3);
    }
}
