// The scene file and the options that override it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "scene/command_line.hpp"
#include "scene/file.hpp"
#include "scene/scene.hpp"
#include "shaders/shared/frame.h"
#include "tests/support/temporary_folder.hpp"

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename Read>
std::string refusal(Read&& read)
{
    try {
        read();
        return "accepted";
    } catch (const base::InputError& error) {
        return error.what();
    }
}

class SceneFile : public testing::Test
{
  protected:
    scene::Scene read(const std::string& text) const
    {
        return scene::read_scene(folder_.with("scene.json", text));
    }
    std::string refused(const std::string& text) const
    {
        return refusal([&] { read(text); });
    }
    TemporaryFolder folder_;
};

} // namespace

TEST_F(SceneFile, EmptyObjectIsTheDefaultScene)
{
    EXPECT_EQ(scene::to_json(read("{}")), scene::to_json(scene::Scene{}));
}

TEST_F(SceneFile, AWoundClosesAsItsKindDoesWhereTheSceneSaysNothingOfTheCurve)
{
    EXPECT_EQ(scene::Wound{}.healing, scene::usual_healing({}));
    const auto closed = [&](const char* text) {
        return wound::closure_day(read(text).wounds.at(0).healing.curve);
    };
    const double day = closed(R"({"wounds": [{"kind": "abrasion"}]})");
    EXPECT_NEAR(day, 10, 2);
    EXPECT_EQ(closed(R"({"wounds": [{"kind": "abrasion", "healing": {"model": "contraction"}}]})"), day);
    EXPECT_EQ(closed(R"({"healing": {"residual_border": 0.5}, "wounds": [{"kind": "abrasion"}]})"), day);
    const double usual = wound::closure_day({});
    EXPECT_EQ(closed(R"({"wounds": [{"kind": "abrasion", "healing": {"gamma": 1.5}}]})"), usual);
    EXPECT_EQ(closed(R"({"healing": {"delta": 0.02822}, "wounds": [{"kind": "abrasion"}]})"), usual);
    EXPECT_GT(closed(R"({"wounds": [{"width_mm": 60}]})"), 1.2 * usual);
    EXPECT_GT(closed(R"({"wounds": [{"at": "forehead"}]})"), 1.01 * usual);
}

TEST_F(SceneFile, AUsualCourseIsNotWrittenSoThatItFollowsTheKind)
{
    nlohmann::json written = scene::to_json(read(R"({"wounds": [{"kind": "ulcer"}]})"));
    EXPECT_EQ(written["wounds"][0]["healing"], (nlohmann::json{{"model", "face"}}));
    written["wounds"][0]["kind"] = "abrasion";
    EXPECT_NEAR(wound::closure_day(scene::scene_of(written, "s.json", "s").wounds[0].healing.curve), 10, 2);
    written = scene::to_json(read(R"({"wounds": [{"kind": "ulcer", "healing": {"delta": 0.1}}]})"));
    EXPECT_EQ(written["wounds"][0]["healing"]["delta"], .1);
}

TEST(UsualCourse, FollowsAnEditOfTheWoundUnlessItWasEditedItself)
{
    const scene::Wound before;
    scene::Wound edited = before;
    edited.kind = "abrasion";
    scene::follow_usual_course(before, edited);
    EXPECT_EQ(edited.healing, scene::usual_healing(edited));
    scene::Wound own = before;
    own.healing.curve.delta = .1;
    edited = own;
    edited.kind = "abrasion";
    scene::follow_usual_course(own, edited);
    EXPECT_EQ(edited.healing, own.healing);
    scene::Wound contracting = before;
    contracting.healing.model = wound::HealingModel::Contraction;
    edited = contracting;
    edited.photo = "photo.png";
    scene::follow_usual_course(contracting, edited);
    EXPECT_EQ(edited.healing.curve, wound::H3{});
    EXPECT_EQ(edited.healing.model, wound::HealingModel::Contraction);
}

TEST_F(SceneFile, AreasGiveTheHealingCurveAndWoundsInheritTheScenesHealing)
{
    folder_.with("areas.csv",
                 "wound,day,area\nold-1,0,20\nold-1,5,12.13\nold-1,20,2.71\nold-2,0,20\nold-2,5,12.13\n"
                 "old-2,20,2.71\nyoung-1,0,20\nyoung-1,5,7.36\nyoung-1,20,.366\n");
    const auto half = [](const scene::Wound& wound) { return wound::half_time(wound.healing.curve); };
    EXPECT_NEAR(half(read(R"({"healing": {"areas": "areas.csv", "series": "mean old"}})").wounds.at(0)), 6.93,
                .05);
    const scene::Scene scene =
        read(R"({"healing": {"areas": "areas.csv", "series": "young-1", "model": "contraction"},
        "wounds": [{}, {"healing": {"areas": "areas.csv", "series": "old-1"}}, {"healing": {"model": "face"}}]})");
    EXPECT_NEAR(half(scene.wounds.at(0)), 3.47, .05);
    EXPECT_NEAR(half(scene.wounds.at(1)), 6.93, .05);
    EXPECT_EQ(scene.wounds.at(1).healing.model, wound::HealingModel::Contraction);
    EXPECT_NEAR(half(scene.wounds.at(2)), 3.47, .05);
    EXPECT_EQ(scene.wounds.at(2).healing.model, wound::HealingModel::Face);
    EXPECT_THAT(refused(R"({"healing": {"areas": "areas.csv", "series": "none"}})"),
                HasSubstr("mean old, mean"));
    EXPECT_THAT(refused(R"({"healing": {"series": "old-1"}})"), HasSubstr("/healing/series"));
    EXPECT_THAT(refused(R"({"healing": {"areas": "other.csv"}})"),
                HasSubstr("other.csv: there is no such file"));
}

TEST_F(SceneFile, WhatIsWrittenReadsBackAsTheSameScene)
{
    scene::Scene scene;
    scene.head = folder_ / "head.glb";
    scene.wounds.resize(3);
    scene.wounds[0].place = head::FacePoint{0.25, -0.5};
    scene.wounds[1].place = glm::dvec3(0.01, 0.02, 0.03);
    scene.wounds[1].kind = "abrasion";
    scene.wounds[1].seed = 4294967295u;
    scene.wounds[2].photo = folder_ / "photo.jpg";
    scene.wounds[2].mask = folder_ / "mask.png";
    scene.wounds[1].photo = folder_ / "other.jpg";
    scene.wounds[1].segmentation = {cv::Point(3, 4), cv::Rect(1, 2, 30, 40)};
    scene.wounds[2].healing = {{0.05, 1.2, -0.1, 0}, wound::HealingModel::Contraction, 0.3};
    scene.reflectance_model = optics::ReflectanceModel::Published;
    scene.shading = optics::published_shading();
    scene.shading.ambient = base::Color(0.25f, 0.5f, 0.75f);
    scene.lights.resize(1);
    scene.lights[0].directional = true;
    scene.lights[0].intensity = 3;
    scene.camera = {{-30, 10}, 0.7, 35};
    scene.size = {320, 200};
    scene.samples = 4;
    scene.exposure_stops = -1.5;
    scene.days = {0, 5, 5, 12.25};
    const json written = scene::to_json(scene);
    EXPECT_EQ(scene::to_json(read(written.dump())), written);
}

TEST_F(SceneFile, ReflectanceModelKeepsItsEarlierName)
{
    const auto model = [&](const char* name) {
        return read(fmt::format(R"({{"reflectance_model": "{}"}})", name)).reflectance_model;
    };
    EXPECT_EQ(model("published"), optics::ReflectanceModel::Published);
    EXPECT_EQ(model("clamped"), optics::ReflectanceModel::Published);
    EXPECT_EQ(model("printed"), optics::ReflectanceModel::Printed);
    EXPECT_THAT(refused(R"({"reflectance_model": "clampt"})"), HasSubstr("/reflectance_model"));
}

TEST_F(SceneFile, RelativePathsStartAtTheFolderOfTheScene)
{
    const scene::Scene scene =
        read(R"({"head": "a.glb", "wounds": [{"photo": "b.jpg", "mask": "/elsewhere/c.png"}]})");
    EXPECT_EQ(scene.head, folder_ / "a.glb");
    EXPECT_EQ(scene.wounds.at(0).photo, folder_ / "b.jpg");
    EXPECT_EQ(scene.wounds.at(0).mask, "/elsewhere/c.png");
}

TEST_F(SceneFile, EachMistakeNamesFileAndField)
{
    std::string too_many = R"({"wounds": [{})";
    for (std::uint32_t i = 0; i < shared::MAX_WOUNDS; ++i)
        too_many += ",{}";
    too_many += "]}";
    const std::pair<const char*, const char*> mistakes[] = {
        {R"({"haed": "a.glb"})", "/haed"},
        {R"({"head": 3})", "/head"},
        {R"({"wounds": {}})", "/wounds"},
        {too_many.c_str(), "/wounds"},
        {R"({"wounds": [3]})", "/wounds/0"},
        {R"({"wounds": [{}, {"widht_mm": 3}]})", "/wounds/1/widht_mm"},
        {R"({"wounds": [{"width_mm": -3}]})", "/wounds/0/width_mm"},
        {R"({"wounds": [{"width_mm": "wide"}]})", "/wounds/0/width_mm"},
        {R"({"wounds": [{"seed": 1.5}]})", "/wounds/0/seed"},
        {R"({"wounds": [{"seed": -1}]})", "/wounds/0/seed"},
        {R"({"wounds": [{"kind": "bite"}]})", "/wounds/0/kind"},
        {R"({"wounds": [{"at": [1]}]})", "/wounds/0/at"},
        {R"({"wounds": [{"at": [1, 99]}]})", "/wounds/0/at"},
        {R"({"wounds": [{"mask": "m.png"}]})", "/wounds/0/mask"},
        {R"({"wounds": [{"segmentation": {"seed": [1, 2]}}]})", "/wounds/0/segmentation"},
        {R"({"wounds": [{"photo": "p", "mask": "m", "segmentation": {"seed": [1, 2]}}]})",
         "/wounds/0/segmentation"},
        {R"({"wounds": [{"photo": "p", "segmentation": {"seed": [1]}}]})", "/wounds/0/segmentation/seed"},
        {R"({"wounds": [{"photo": "p", "segmentation": {"rect": [0, 0, -5, 5]}}]})",
         "/wounds/0/segmentation/rect"},
        {R"({"wounds": [{"photo": "p", "segmentation": {"point": [0, 0]}}]})",
         "/wounds/0/segmentation/point"},
        {R"({"wounds": [{"healing": {"gamma": 0}}]})", "/wounds/0/healing/gamma"},
        {R"({"wounds": [{"healing": {"model": "magic"}}]})", "/wounds/0/healing/model"},
        {R"({"wounds": [{"healing": {"speed": 1}}]})", "/wounds/0/healing/speed"},
        {R"({"reflectance_model": "guess"})", "/reflectance_model"},
        {R"({"shading": {"rho_s": 2}})", "/shading/rho_s"},
        {R"({"shading": {"shadow": 1}})", "/shading/shadow"},
        {R"({"shading": {"ward_model": "phong"}})", "/shading/ward_model"},
        {R"({"shading": {"ambient": [1, 2]}})", "/shading/ambient"},
        {R"({"shading": {"ambient": [1, 2, -3]}})", "/shading/ambient"},
        {R"({"lights": [{"intensity": -1}]})", "/lights/0/intensity"},
        {R"({"lights": [{"intensity": 100000}]})", "/lights/0/intensity"},
        {R"({"lights": [{}, {"intensity": 100, "color": [1, 1, 101]}]})", "/lights/1/intensity"},
        {R"({"lights": [{"elevation_deg": 90}]})", "/lights/0/elevation_deg"},
        {R"({"camera": {"fov_deg": 0}})", "/camera/fov_deg"},
        {R"({"camera": null})", "/camera"},
        {R"({"size": "0x0"})", "/size"},
        {R"({"size": [64, 64]})", "/size"},
        {R"({"msaa": 4})", "/msaa"},
        {R"({"exposure_stops": 21})", "/exposure_stops"},
        {R"({"days": []})", "/days"},
        {R"({"days": [0, -1]})", "/days"},
        {R"({"days": [0, "x"]})", "/days"},
        {R"({"days": "0:30"})", "/days"},
        {R"([1])", "must be an object"},
        {R"({"head": "a.glb")", "not valid JSON"},
        {R"({"exposure_stops": NaN})", "not valid JSON"},
        {R"({"exposure_stops": 1e999})", "out of range"},
    };
    for (const auto& [text, field] : mistakes)
        EXPECT_THAT(refused(text), AllOf(HasSubstr("scene.json: "), HasSubstr(field), HasSubstr("; ")))
            << text;
}

TEST_F(SceneFile, AMissingFileIsNamed)
{
    EXPECT_THAT(refusal([&] { scene::read_scene(folder_ / "none.json"); }), HasSubstr("none.json"));
    EXPECT_THAT(refusal([&] { scene::read_scene(folder_.path()); }), HasSubstr(folder_.path().string()));
}

TEST(Days, AreARangeOrAList)
{
    EXPECT_THAT(scene::parse_days("0:30:10", "--days"), ElementsAre(0, 10, 20, 30));
    EXPECT_THAT(scene::parse_days("0:1:0.1", "--days"), testing::SizeIs(11));
    EXPECT_THAT(scene::parse_days("4:4:1", "--days"), ElementsAre(4));
    EXPECT_THAT(scene::parse_days("5,5,0.5", "--days"), ElementsAre(5, 5, 0.5));
    EXPECT_THAT(scene::parse_days("3650", "--days"), ElementsAre(3650));
}

TEST(Days, InvalidOnesAreRefused)
{
    for (const char* text : {"", ",", "5,", "a", "1,b", "-1", "nan", "inf", "3651", "1e99", "0:30", "0:30:0",
                             "0:30:-1", "30:0:1", "0:3650:1e-9", "1:2:3:4", "0:nan:1", "5 "})
        EXPECT_THAT(refusal([&] { scene::parse_days(text, "--days"); }), HasSubstr("--days: ")) << text;
}

TEST(PictureSize, IsWidthByHeight)
{
    EXPECT_THAT(scene::parse_size("1280x720", "--size"), ElementsAre(1280, 720));
    EXPECT_THAT(scene::parse_size("16x16384", "--size"), ElementsAre(16, 16384));
    for (const char* text : {"", "x", "640", "640x", "x480", "0x0", "15x16", "100000x100000", "-64x64",
                             "64x-64", "64X64", "64x64x64", "64.5x64", " 64x64", "99999999999x64", "nanxnan"})
        EXPECT_THAT(refusal([&] { scene::parse_size(text, "--size"); }), HasSubstr("--size: ")) << text;
}

TEST(SceneOptions, OverrideTheScene)
{
    const TemporaryFolder folder;
    scene::SceneOptions options;
    options.scene = folder.with("scene.json", R"({"wounds": [], "days": [1], "size": "64x64"})").string();
    options.head = "other.glb";
    options.wound = "photo.png";
    options.mask = "mask.png";
    options.days = "0,5";
    options.size = "128x96";
    options.msaa = true;
    const scene::Scene scene = scene::chosen_scene(options);
    EXPECT_EQ(scene.head, "other.glb");
    ASSERT_EQ(scene.wounds.size(), 1u);
    EXPECT_EQ(scene.wounds[0].photo, "photo.png");
    EXPECT_EQ(scene.wounds[0].mask, "mask.png");
    EXPECT_THAT(scene.days, ElementsAre(0, 5));
    EXPECT_THAT(scene.size, ElementsAre(128, 96));
    EXPECT_EQ(scene.samples, 4u);
}

TEST(SceneOptions, PublishedModeUsesThePapersModelInEveryPart)
{
    scene::SceneOptions options;
    options.mode = "published";
    const scene::Scene scene = scene::chosen_scene(options);
    EXPECT_EQ(scene.shading.ward_model, optics::WardModel::Published);
    EXPECT_EQ(scene.shading.translucency_model, optics::TranslucencyModel::Published);
    EXPECT_EQ(scene.shading.blend_model, optics::BlendModel::Published);
    EXPECT_EQ(scene.reflectance_model, optics::ReflectanceModel::Published);
    EXPECT_EQ(scene.wounds.at(0).healing.model, wound::HealingModel::Contraction);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_FALSE(scene.lights[0].falloff);
}

TEST(SceneOptions, MaskWithoutAPhotoIsRefused)
{
    scene::SceneOptions options;
    options.mask = "mask.png";
    EXPECT_THAT(refusal([&] { scene::chosen_scene(options); }), HasSubstr("--mask"));
}

TEST(SceneOptions, HintsReplaceTheScenesMask)
{
    const TemporaryFolder folder;
    scene::SceneOptions options;
    options.scene =
        folder.with("scene.json", R"({"wounds": [{"photo": "p.png", "mask": "m.png"}]})").string();
    options.hints.rect = {1, 2, 30, 40};
    const scene::Wound wound = scene::chosen_scene(options).wounds.at(0);
    EXPECT_EQ(wound.photo, folder / "p.png");
    EXPECT_EQ(wound.mask, "");
    EXPECT_EQ(wound.segmentation.rect, cv::Rect(1, 2, 30, 40));
    options.mask = "mask.png";
    EXPECT_THAT(refusal([&] { scene::chosen_scene(options); }),
                AllOf(HasSubstr("--rect"), HasSubstr("mask")));
    options = {};
    options.hints.seed = {3, 4};
    EXPECT_THAT(refusal([&] { scene::chosen_scene(options); }), HasSubstr("--wound"));
}
