// A scene loaded, placed and evaluated without a graphics device.
#include <gmock/gmock.h>

#include "base/input_error.hpp"
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
