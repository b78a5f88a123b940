// A scene loaded, placed and evaluated without a graphics device.
#include <gmock/gmock.h>

#include "base/input_error.hpp"
#include "head/vectors.hpp"
#include "scene/loaded_scene.hpp"
#include "tests/support/small_head.hpp"

namespace {

TEST(LoadedScene, EvaluatesItsWoundsOnAnyDay)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds.resize(2);
    scene.wounds[1].place = std::string("forehead");
    scene.wounds[1].healing.model = wound::HealingModel::Contraction;
    const scene::LoadedScene loaded = scene::load(scene);
    ASSERT_TRUE(loaded.complete);
    ASSERT_EQ(loaded.wounds.size(), 2u);
    EXPECT_EQ(loaded.lights.size(), scene.lights.size());
    double before = 1;
    for (const double day : {0., 5., 10., 20.}) {
        const std::vector<wound::WoundDay> today = loaded.wounds_on(day);
        ASSERT_EQ(today.size(), 2u);
        EXPECT_LE(today[0].unhealed_ratio, before);
        EXPECT_EQ(today[1].unhealed_ratio, today[1].border_ratio) << "contraction";
        before = today[0].unhealed_ratio;
    }
    EXPECT_LT(before, .5);
}

TEST(LoadedScene, PlacesWoundsWhereACameraSeesThem)
{
    const scene::LoadedScene loaded = scene::load(small::scene(small::head()));
    const head::Camera close = loaded.close_up(0);
    const auto seen = loaded.pick(close, 0, 0, 1);
    ASSERT_TRUE(seen);
    EXPECT_EQ(loaded.wound_near(*seen), 0u);
    EXPECT_LT(glm::distance(*seen, loaded.wounds[0].anchor.centre), 5e-3);
    const cv::Mat1f surface = loaded.surface_mm2(0);
    EXPECT_EQ(surface.size(), loaded.wounds[0].region.size());
}

TEST(LoadedScene, PublishedModeTakesTableOneAtThePlaceAndSaysWhatItLimits)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds.resize(3);
    scene.wounds[1].place = std::string("nose");
    scene.wounds[2] = scene.wounds[1];
    scene::make_published(scene);
    const scene::LoadedScene loaded = scene::load(scene);
    const auto dermis_mm = [&](std::size_t i) {
        return std::get<optics::SkinLayers>(loaded.tissue_at(loaded.wounds.at(i))).layers.at(1).thickness_mm;
    };
    EXPECT_GT(std::abs(dermis_mm(1) - dermis_mm(0)), .05);
    EXPECT_FALSE(loaded.same_tissue(loaded.wounds[0], loaded.wounds[1]));
    EXPECT_TRUE(loaded.same_tissue(loaded.wounds[1], loaded.wounds[2]));
    using testing::Contains, testing::HasSubstr, testing::StartsWith;
    EXPECT_THAT(loaded.notes, Contains(testing::AllOf(StartsWith("wound 1: "), HasSubstr("published takes the limit"),
                                                      HasSubstr("epidermis 0.2 mm: G 0.188, B 0.162"))));
    EXPECT_THAT(loaded.notes, Contains(StartsWith("wound 2: ")));
    EXPECT_THAT(loaded.notes, testing::Not(Contains(StartsWith("wound 3: ")))) << "one note for each thickness";
    scene.tissue = "light";
    scene.reflectance_model = optics::ReflectanceModel::Calibrated;
    const scene::LoadedScene corrected = scene::load(scene);
    EXPECT_THAT(corrected.notes, testing::Not(Contains(StartsWith("wound"))));
    EXPECT_TRUE(corrected.same_tissue(corrected.wounds[0], corrected.wounds[1]));
}

TEST(LoadedScene, PublishedLightIsAtThePapersDistanceAndAMovedLightIsNot)
{
    scene::Scene scene = small::scene(small::head());
    scene::make_published(scene);
    const auto d = [&](double distance_m) {
        scene.lights[0].distance_m = distance_m;
        const scene::LoadedScene loaded = scene::load(scene);
        return loaded.lights[0].paper_units_per_m *
               cv::norm(loaded.lights[0].position - head::to_cv(scene::face_middle(loaded.head->face)));
    };
    const double published_m = scene.lights[0].distance_m;
    EXPECT_NEAR(d(published_m), optics::paper_light_distance, .7) << "exact for a head of the default's size";
    EXPECT_NEAR(d(4 * published_m), 4 * d(published_m), 1e-9);
}

TEST(LoadedScene, ErrorsSayWhyASceneCannotBeLoaded)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds[0].place = head::FacePoint{2.9, 2.9};
    EXPECT_THROW(scene::load(scene), base::InputError);
    scene = small::scene(small::head());
    scene.wounds[0].photo = "there/is/none.png";
    try {
        scene::load(scene);
        ADD_FAILURE();
    } catch (const base::InputError& error) {
        EXPECT_THAT(error.where(), testing::HasSubstr("none.png"));
    }
}

} // namespace
