// Labels against known answers: a disc on a wall, points projected by the camera, silhouettes, occlusion.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/image_io.hpp"
#include "head/albedo_under.hpp"
#include "passes/labels.hpp"
#include "stage/camera_record.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

/// A frame's labels, the wounds' maps and the picture.
struct Labelled
{
    cv::Mat4b picture;
    cv::Mat2b kinds;
    cv::Mat4f measures;
    passes::LabelMaps maps;
    std::vector<passes::VisibleWound> visible;
    std::vector<passes::WoundSize> size;
    nlohmann::json camera; // as in capture.json
    double focal_px() const { return camera.at("intrinsics").at("fx"); }
};

cv::Mat4f floats(const cv::Mat& halves)
{
    cv::Mat4f values;
    halves.convertTo(values, CV_32F);
    return values;
}

/// Looks at the centre of the wall from `degrees` off its normal; the view is 126 mm across.
head::Camera before_the_wall(double degrees = 0)
{
    const double angle = glm::radians(degrees);
    return {0.6 * glm::dvec3(std::sin(angle), 0, std::cos(angle)), glm::dvec3(0), 12};
}

Labelled labelled(const stage::Stage& stage, double day, const head::Camera& camera)
{
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const scene::Scene& scene = stage.scene();
    graph::Graph graph;
    const passes::FrameImages images =
        stage.declare(graph, {.day = day, .tile = scene.size, .camera = camera, .shading = scene.shading})
            .images;
    const auto picture = graph.readback("picture", images.picture);
    const auto kinds = graph.readback("kinds", images.labels.kinds);
    const auto measures = graph.readback("measures", images.labels.measures);
    std::vector<std::array<graph::ReadbackId, 2>> wounds;
    for (const passes::WoundTexture& wound : images.wounds)
        wounds.push_back({graph.readback(fmt::format("state {}", wounds.size()), wound.state),
                          graph.readback(fmt::format("relief {}", wounds.size()), wound.relief)});
    const gpu::FrameResult frame = executor.run(graph);

    Labelled result{frame.mat(picture).clone(),
                    frame.mat(kinds).clone(),
                    frame.mat(measures).clone(),
                    {},
                    {},
                    {},
                    stage::camera_record(stage, camera, scene.size)};
    result.maps = passes::label_maps(result.kinds, result.measures);
    result.visible = passes::visible_wounds(result.kinds, result.measures, wounds.size());
    for (std::size_t i = 0; i < wounds.size(); ++i) {
        const cv::Mat4f state = floats(frame.mat(wounds[i][0])), relief = floats(frame.mat(wounds[i][1]));
        result.size.push_back(passes::wound_size(stage.loaded().surface_mm2(i), state, relief));
    }
    return result;
}

Labelled labelled(const stage::Stage& stage, double day)
{
    return labelled(stage, day, stage.loaded().camera());
}

stage::Stage stage_of(const scene::Scene& scene)
{
    return {gpu_test::device(), stage::Stage::prepare(scene)};
}

/// A round wound of `width_mm` in the middle of the front view.
scene::Scene disc_scene(const head::Model& model, double width_mm, std::uint32_t side = 512)
{
    static const TemporaryFolder folder;
    cv::Mat3b photo(512, 512, cv::Vec3b(208, 162, 140));
    cv::Mat1b mask = cv::Mat1b::zeros(512, 512);
    for (int y = 0; y < 512; ++y) // by pixel centres: cv::circle is half a pixel too wide
        for (int x = 0; x < 512; ++x)
            mask(y, x) = std::hypot(x - 255.5, y - 255.5) < 100 ? 255 : 0;
    photo.setTo(cv::Vec3b(140, 40, 36), mask);
    base::write_png(folder / "disc.png", photo);
    base::write_png(folder / "disc_mask.png", mask);
    scene::Scene scene = small::scene(model, side);
    scene.wounds[0].photo = folder / "disc.png";
    scene.wounds[0].mask = folder / "disc_mask.png";
    scene.wounds[0].place = glm::dvec3(0, 0, 0);
    scene.wounds[0].width_mm = width_mm;
    scene.camera.from = {0, 0};
    return scene;
}

double disc_mm2(double width_mm)
{
    return std::numbers::pi * width_mm * width_mm / 4;
}

std::int64_t count(const cv::Mat1b& kinds, std::uint32_t kind)
{
    return cv::countNonZero(kinds == kind);
}

class Labels : public gpu_test::Test
{
};

TEST_F(Labels, OnAWallPixelsAndSurfaceAgreeWithTheDisc)
{
    const stage::Stage stage = stage_of(disc_scene(small::wall({.6f, .4f, .3f}), 40));
    const Labelled day = labelled(stage, 0, before_the_wall());
    const double mm_per_px = day.maps.distance_mm(256, 256) / day.focal_px();
    EXPECT_NEAR(day.size[0].inside_mm2 / disc_mm2(40), 1, .01);
    EXPECT_NEAR(day.size[0].bed_mm2 / disc_mm2(40), 1, .01);
    EXPECT_NEAR(day.visible[0].inside_mm2 / day.size[0].inside_mm2, 1, .01);
    EXPECT_NEAR(double(day.visible[0].bed_px) * mm_per_px * mm_per_px / disc_mm2(40), 1, .01);
    EXPECT_NEAR(day.visible[0].box.width * mm_per_px, 40, 2 * mm_per_px);
    EXPECT_EQ(day.visible[0].bed_px + day.visible[0].epithelium_px, cv::countNonZero(day.maps.wounds == 1));
    EXPECT_GT(day.size[0].deepest_mm, .2);
    EXPECT_GT(day.size[0].volume_mm3, .1 * day.size[0].deepest_mm * disc_mm2(40));
    EXPECT_LT(day.size[0].volume_mm3, day.size[0].deepest_mm * disc_mm2(40));
}

TEST_F(Labels, FromTheSideTheSurfaceIsUnchangedAndThePixelsAreFewer)
{
    const stage::Stage stage = stage_of(disc_scene(small::wall({.6f, .4f, .3f}), 40));
    const Labelled day = labelled(stage, 0, before_the_wall(60));
    EXPECT_NEAR(day.visible[0].inside_mm2 / disc_mm2(40), 1, .01);
    const double mm_per_px = day.maps.distance_mm(256, 256) / day.focal_px();
    EXPECT_NEAR(double(day.visible[0].bed_px) * mm_per_px * mm_per_px / disc_mm2(40), .5, .04);
}

TEST_F(Labels, OnARoundHeadTheSurfaceIsLargerThanItsPicture)
{
    scene::Scene scene = disc_scene(small::head(), 70, 1024);
    scene.wounds[0].place = head::FacePoint{0, .35};
    const stage::Stage stage = stage_of(scene);
    const Labelled day = labelled(stage, 0);
    const double mm_per_px = day.maps.distance_mm(512, 512) / day.focal_px();
    const double pictured = double(day.visible[0].bed_px) * mm_per_px * mm_per_px;
    EXPECT_GT(day.size[0].bed_mm2, 1.05 * disc_mm2(70)); // the flat disc is projected onto a curved head
    EXPECT_GT(day.size[0].bed_mm2, 1.1 * pictured);
    // The whole wound is visible except for its fading flanks, so both ways of measuring agree.
    EXPECT_NEAR(day.visible[0].bed_mm2 / day.size[0].bed_mm2, 1, .02);
}

TEST_F(Labels, AnalyticSurfaceOfASphericalCapIsFound)
{
    // A height field z = sqrt(R^2 - r^2) - R over the plane of the patch: the cap over a disc of radius a has
    // the area 2 pi R (R - sqrt(R^2 - a^2)).
    head::Model model = small::wall({.6f, .4f, .3f});
    constexpr double radius = .2;
    for (head::Vertex& vertex : model.vertices) {
        const glm::dvec2 at(vertex.position.x, vertex.position.y);
        vertex.position.z = float(std::sqrt(std::max(radius * radius - glm::dot(at, at), 0.0)) - radius);
        vertex.normal = glm::normalize(vertex.position + glm::vec3(0, 0, float(radius)));
    }
    head::update_bounds(model);
    head::Anchor anchor;
    anchor.half_width_m = .05;
    const cv::Mat1f surface = head::surface_under(model, 0, anchor, 256);
    double sum = 0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            if (std::hypot(x - 127.5, y - 127.5) < 128)
                sum += surface(y, x);
    const double exact = 2e6 * std::numbers::pi * radius * (radius - std::sqrt(radius * radius - .0025));
    EXPECT_NEAR(sum / exact, 1, .003);
    EXPECT_GT(exact, 1.01e6 * std::numbers::pi * .0025); // so the area of the flat disc would fail
}

TEST_F(Labels, EveryTexelOfAWallIsCountedOnce)
{
    head::Anchor anchor;
    anchor.half_width_m = .03; // texel centres fall on the mesh's diagonals
    const cv::Mat1f surface = head::surface_under(small::wall({1, 1, 1}), 0, anchor, 64);
    double low = 0, high = 0;
    cv::minMaxLoc(surface, &low, &high);
    EXPECT_NEAR(low, 60.0 * 60 / 64 / 64, 1e-4);
    EXPECT_NEAR(high, 60.0 * 60 / 64 / 64, 1e-4);
}

TEST_F(Labels, TheCameraMatrixPutsKnownPointsOnTheirPixels)
{
    scene::Scene scene = disc_scene(small::head(), 20);
    scene.wounds[0].place = head::FacePoint{.2, .1};
    scene.camera.from = {25, -10};
    scene.size = {400, 300};
    const stage::Stage stage = stage_of(scene);
    const Labelled day = labelled(stage, 0);
    const nlohmann::json &pose = day.camera.at("camera_from_world"), &k = day.camera.at("intrinsics");
    glm::dmat3 rotation;
    glm::dvec3 translation;
    for (int row = 0; row < 3; ++row) {
        translation[row] = pose[row][3];
        for (int column = 0; column < 3; ++column)
            rotation[column][row] = pose[row][column];
    }
    const glm::dvec2 focal(k.at("fx"), k.at("fy")), principal(k.at("cx"), k.at("cy"));
    const glm::dvec3 centre = rotation * stage.loaded().wounds[0].anchor.centre + translation;
    const glm::dvec2 at = focal * glm::dvec2(centre) / centre.z + principal;
    const cv::Moments moments = cv::moments(day.maps.wounds == 1, true);
    EXPECT_NEAR(at.x, moments.m10 / moments.m00 + .5, 1.5); // pixel centres are at + .5
    EXPECT_NEAR(at.y, moments.m01 / moments.m00 + .5, 1.5);
    EXPECT_NEAR(day.maps.distance_mm(int(at.y), int(at.x)), 1e3 * centre.z, .5);
    // A pixel, unprojected by its distance, lies on the head.
    const cv::Point pixel(180, 140);
    const double z = 1e-3 * day.maps.distance_mm(pixel);
    ASSERT_GT(z, 0);
    const glm::dvec3 seen((glm::dvec2(pixel.x + .5, pixel.y + .5) - principal) / focal * z, z);
    const glm::dvec3 point = glm::transpose(rotation) * (seen - translation);
    double nearest = 1;
    for (const head::Vertex& vertex : stage.loaded().head->model->vertices)
        nearest = std::min(nearest, glm::distance(glm::dvec3(vertex.position), point));
    EXPECT_LT(nearest, .004); // the mesh's spacing
}

TEST_F(Labels, SilhouetteEqualsThatOfThePicture)
{
    scene::Scene scene = small::scene(small::head());
    scene.lights.clear(); // the head is black in front of the studio's gray
    scene.shading.ambient = base::Color::all(0);
    const stage::Stage stage = stage_of(scene);
    const Labelled day = labelled(stage, 4);
    cv::Mat1b gray;
    cv::cvtColor(day.picture, gray, cv::COLOR_RGBA2GRAY);
    const cv::Mat1b head = gray == 0;
    EXPECT_GT(cv::countNonZero(head), 10000);
    EXPECT_EQ(cv::countNonZero(head != (day.maps.kinds != shared::LABEL_BACKGROUND)), 0);
    EXPECT_EQ(cv::countNonZero((day.maps.distance_mm > 0) != (day.maps.kinds != shared::LABEL_BACKGROUND)),
              0);
}

TEST_F(Labels, RunOnlyWhenTheyAreRead)
{
    const stage::Stage stage = stage_of(small::scene(small::head()));
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    graph.readback("picture", stage.declare(graph, {.day = 3, .tile = stage.scene().size}).images.picture);
    EXPECT_EQ(executor.run(graph).pass("labels").state, graph::PassState::Culled);
}

TEST_F(Labels, SeveralWoundsAreDistinguishedAndRingsAppear)
{
    scene::Scene scene = small::scene(small::head());
    scene.wounds.resize(2);
    scene.wounds[1].place = std::string("forehead");
    scene.wounds[1].width_mm = 20;
    const stage::Stage stage = stage_of(scene);
    const Labelled fresh = labelled(stage, 0), later = labelled(stage, 9);
    for (int i = 0; i < 2; ++i) {
        EXPECT_GT(fresh.visible[i].bed_px, 50);
        EXPECT_GT(later.visible[i].epithelium_px, 20) << "new epithelium around the open bed";
        EXPECT_LT(later.visible[i].bed_px, .7 * double(fresh.visible[i].bed_px));
        const double ratio = (*stage.wounds_on(9))[i].unhealed_ratio;
        EXPECT_NEAR(later.size[i].bed_mm2 / fresh.size[i].bed_mm2 / ratio, 1, .05);
    }
    EXPECT_EQ((fresh.visible[0].box & fresh.visible[1].box).area(), 0);
    EXPECT_EQ(count(fresh.maps.kinds, shared::LABEL_OPEN_BED),
              fresh.visible[0].bed_px + fresh.visible[1].bed_px);
}

/// The wall with a plate of another material in front of its right half.
head::Model wall_with_plate(head::AlphaMode alpha)
{
    head::Model model = small::wall({.6f, .4f, .3f});
    const auto first = std::uint32_t(model.vertices.size());
    for (const glm::vec2 at :
         {glm::vec2(0, -.05f), glm::vec2(.05f, -.05f), glm::vec2(.05f, .05f), glm::vec2(0, .05f)})
        model.vertices.push_back({{at.x, at.y, .03f}, {0, 0, 1}, {1, 0, 0, 1}, {0, 0}});
    head::Material plate;
    plate.name = "plate";
    plate.alpha = alpha;
    plate.base_color_factor = glm::vec4(.2f, .2f, .2f, alpha == head::AlphaMode::Opaque ? 1.0f : .5f);
    model.materials.push_back(plate);
    model.primitives.push_back({std::uint32_t(model.indices.size()), 6, 1});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        model.indices.push_back(first + corner);
    head::update_bounds(model);
    return model;
}

TEST_F(Labels, OpaquePartsHideAWoundAndBlendedOnesDoNot)
{
    const stage::Stage solid = stage_of(disc_scene(wall_with_plate(head::AlphaMode::Opaque), 40));
    const Labelled hidden = labelled(solid, 0, before_the_wall());
    EXPECT_NEAR(hidden.visible[0].inside_mm2 / hidden.size[0].inside_mm2, .5, .03);
    EXPECT_GT(count(hidden.maps.kinds, shared::LABEL_OTHER), 1000);
    const stage::Stage thin = stage_of(disc_scene(wall_with_plate(head::AlphaMode::Blend), 40));
    const Labelled open = labelled(thin, 0, before_the_wall());
    EXPECT_NEAR(open.visible[0].inside_mm2 / open.size[0].inside_mm2, 1, .01);
    EXPECT_EQ(count(open.maps.kinds, shared::LABEL_OTHER), 0);
}

} // namespace
