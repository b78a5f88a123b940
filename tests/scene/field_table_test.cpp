// The table of a scene's fields: its documentation, its sliders, and the keys computed from it.
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/input_error.hpp"
#include "scene/field_table.hpp"
#include "scene/file.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(FieldTable, EqualsTheDocumentation)
{
    const std::vector<std::uint8_t> bytes = base::read_file(CICATRIX_DOCS "/scene.md", 1 << 20);
    const std::string document(bytes.begin(), bytes.end());
    for (const auto& [name, table] : scene::field_documentation())
        EXPECT_THAT(document, HasSubstr(fmt::format("<!-- table {} -->\n{}<!-- end -->", name, table)))
            << "regenerate it: cicatrix-lab scene-fields docs/scene.md";
}

TEST(FieldTable, EveryFieldIsWrittenUnderItsNameAndReadBack)
{
    scene::Scene scene;
    scene.wounds.resize(2);
    scene.wounds[1].photo = "/a/photo.png";
    scene.wounds[1].segmentation.rect = cv::Rect(1, 2, 30, 40);
    scene.wounds[1].place = head::FacePoint{.25, -.1};
    scene.wounds[1].healing.model = wound::HealingModel::Contraction;
    scene.views = {{"front", std::nullopt}, {"own", scene::Camera{{1, 2}, .5, 30, {.1, .2, .3}}}};
    const json written = scene::to_json(scene);
    EXPECT_EQ(scene::scene_of(written, "/a/scene.json", "scene"), scene);
    for (const auto& field : scene::scene_fields())
        if (field.name != "healing") { // written with each wound instead
            EXPECT_TRUE(written.contains(field.name)) << field.name;
        }
    for (const auto& field : scene::shading_fields())
        EXPECT_TRUE(written.at("shading").contains(field.name)) << field.name;
}

/// A field with a slider must accept every value of the slider.
template <typename Object>
void expect_sliders_within_range(const std::vector<scene::Field<Object>>& fields,
                                 const std::function<json(const std::string&, double)>& scene_with)
{
    for (const scene::Field<Object>& field : fields)
        if (field.slider)
            for (const double value : {field.slider->low, field.slider->high}) {
                EXPECT_NO_THROW(scene::scene_of(scene_with(field.name, value), "scene.json", "scene"))
                    << field.name << " " << value;
            }
}

TEST(FieldTable, SlidersStayWithinTheRanges)
{
    expect_sliders_within_range(scene::scene_fields(), [](const auto& name, double value) {
        return json{{name, value}};
    });
    expect_sliders_within_range(scene::wound_fields(), [](const auto& name, double value) {
        return json{{"wounds", {{{name, value}}}}};
    });
    expect_sliders_within_range(scene::healing_fields(), [](const auto& name, double value) {
        return json{{"healing", {{name, value}}}};
    });
    expect_sliders_within_range(scene::light_fields(), [](const auto& name, double value) {
        return json{{"lights", {{{name, value}}}}};
    });
}

TEST(FieldTable, SlidersStandWhereTheWindowDrawsThem)
{
    for (const auto& field : scene::camera_fields())
        EXPECT_FALSE(field.slider) << field.name << ": the window has no section for the camera's sliders";
    const auto of_face = [](const auto& field) {
        wound::Healing contraction;
        contraction.model = wound::HealingModel::Contraction;
        return field.shown_when && field.shown_when({}) && !field.shown_when(contraction);
    };
    for (const auto& field : scene::healing_fields())
        EXPECT_EQ(of_face(field), field.name == "residual_border" || field.name == "age_days") << field.name;
}

std::uint64_t key(const scene::Wound& wound, scene::Affects affects)
{
    base::Hash hash;
    scene::hash_fields(hash, wound, affects);
    return hash.value();
}

TEST(FieldTable, KeysOfPreparedWoundsChangeWithEveryFieldThatMattersToThem)
{
    struct Change
    {
        const char* name;
        std::function<void(scene::Wound&)> make;
        bool photograph, preparation; // whether the narrower keys change, too
    };
    const Change changes[] = {
        {"photo", [](auto& w) { w.photo = "a.png"; }, true, true},
        {"mask", [](auto& w) { w.mask = "b.png"; }, true, true},
        {"segmentation", [](auto& w) { w.segmentation.seed = cv::Point(3, 4); }, true, true},
        {"kind", [](auto& w) { w.kind = "abrasion"; }, true, true},
        {"seed", [](auto& w) { ++w.seed; }, true, true},
        {"width_mm", [](auto& w) { w.width_mm += 1e-9; }, false, true},
        {"at", [](auto& w) { w.place = glm::dvec3(.1); }, false, false},
        {"roll_deg", [](auto& w) { w.roll_deg = 1; }, false, false},
        {"depth_factor", [](auto& w) { w.depth_factor = 2; }, false, false},
        {"healing", [](auto& w) { w.healing.curve.gamma = 2; }, false, false},
    };
    EXPECT_EQ(std::size(changes), scene::wound_fields().size()) << "a new field: add it to the table above";
    const scene::Wound wound;
    for (const Change& change : changes) {
        scene::Wound other = wound;
        change.make(other);
        using scene::Affects;
        EXPECT_NE(key(other, Affects::Fit), key(wound, Affects::Fit)) << change.name;
        EXPECT_EQ(key(other, Affects::Preparation) != key(wound, Affects::Preparation), change.preparation)
            << change.name;
        EXPECT_EQ(key(other, Affects::Photograph) != key(wound, Affects::Photograph), change.photograph)
            << change.name;
    }
}

TEST(SceneVersion, OtherThanTheCurrentOneIsRefused)
{
    EXPECT_NO_THROW(scene::scene_of(json{{"version", 1}}, "scene.json", "scene.json"));
    for (const json& version : {json(2), json(0), json("1"), json(1.5)})
        try {
            scene::scene_of(json{{"version", version}}, "scene.json", "scene.json");
            ADD_FAILURE() << version;
        } catch (const base::InputError& error) {
            EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("scene.json: /version"), HasSubstr("; ")));
        }
}

TEST(Files, OfASceneAreAllRenamed)
{
    scene::Scene scene;
    scene.head = "h.glb";
    scene.tissue = "t.json";
    scene.wounds[0].photo = "p.png";
    const scene::Scene moved =
        scene::with_files(scene, [](const std::filesystem::path& file) { return "/new" / file; });
    EXPECT_EQ(moved.head, "/new/h.glb");
    EXPECT_EQ(moved.tissue, "/new/t.json");
    EXPECT_EQ(moved.wounds[0].photo, "/new/p.png");
    EXPECT_TRUE(moved.wounds[0].mask.empty());
    scene.tissue = "dark";
    EXPECT_EQ(scene::with_files(scene, [](const auto& file) { return "/new" / file; }).tissue, "dark");
}

} // namespace
