// Transports that spread light in the picture, on a head: tiles, several samples per pixel, regions, and what
// they are near to.
#include <algorithm>
#include <gmock/gmock.h>

#include "base/color.hpp"
#include "passes/viewport_tile.hpp"
#include "stage/stage.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/small_head.hpp"

namespace {

using optics::Transport;

/// Close enough to the head that light spreads over several pixels.
struct CloseUp
{
    explicit CloseUp(Transport transport, std::uint32_t samples = 1)
        : stage(gpu_test::device(), prepared(samples))
    {
        request = {.day = 3, .tile = stage.scene().size, .camera = stage.loaded().close_up(0)};
        show(transport);
    }
    static stage::Stage::Preparation prepared(std::uint32_t samples)
    {
        scene::Scene scene = small::scene(small::head());
        scene.samples = samples;
        return stage::Stage::prepare(scene);
    }
    void show(Transport transport)
    {
        request.shading = stage.scene().shading;
        request.shading->transport = transport;
    }
    gpu::FrameResult draw()
    {
        graph::Graph graph;
        graph.readback("picture", stage.declare(graph, request).images.picture);
        return executor.run(graph);
    }
    cv::Mat4b picture() { return draw().mat({0}).clone(); }

    stage::Stage stage;
    stage::FrameRequest request;
    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
};

/// Mean CIEDE2000.
double difference(const cv::Mat4b& a, const cv::Mat4b& b)
{
    const auto lab = [](const cv::Vec4b& p) {
        return base::lab_from_linear(base::linear_from_srgb8({p[0], p[1], p[2]}));
    };
    double sum = 0;
    for (int y = 0; y < a.rows; ++y)
        for (int x = 0; x < a.cols; ++x)
            sum += base::delta_e2000(lab(a(y, x)), lab(b(y, x)));
    return sum / double(a.total());
}

using ChangSamples = gpu_test::Test;

class SpreadInPicture : public gpu_test::Test, public testing::WithParamInterface<Transport>
{
};
INSTANTIATE_TEST_SUITE_P(Transports, SpreadInPicture,
                         testing::Values(Transport::Separable, Transport::Burley, Transport::Chang),
                         [](const auto& tested) {
                             return optics::transport_names[std::size_t(tested.param)];
                         });

TEST_P(SpreadInPicture, IsNearerToLightThatSpreadsOnTheSkinThanLambert)
{
    CloseUp studio(Transport::Diffused);
    const cv::Mat4b diffused = studio.picture();
    studio.show(Transport::Lambert);
    const double lambert = difference(studio.picture(), diffused);
    studio.show(GetParam());
    const double spread = difference(studio.picture(), diffused);
    // A dipole shows less of what is near than walks do, and its samples are few.
    EXPECT_LT(spread, (GetParam() == Transport::Chang ? .9 : .8) * lambert);
    RecordProperty("spread", std::to_string(spread));
    RecordProperty("lambert", std::to_string(lambert));
}

TEST_P(SpreadInPicture, HasNoSeamsBetweenTiles)
{
    CloseUp studio(GetParam());
    const cv::Mat4b whole = studio.picture();
    const auto tiled = [&](std::uint32_t apron) {
        cv::Mat picture;
        for (const passes::ViewportTile& tile : passes::tiles(studio.stage.scene().size, 64, apron)) {
            studio.request.tile = tile;
            passes::place(picture, studio.picture(), tile);
        }
        studio.request.tile = studio.stage.scene().size;
        return picture;
    };
    studio.stage.update([&] {
        scene::Scene scene = studio.stage.scene();
        scene.shading = *studio.request.shading;
        return scene;
    }());
    const std::uint32_t apron = studio.stage.apron(*studio.request.camera, studio.stage.scene().size[1]);
    EXPECT_GT(apron, 8u);
    EXPECT_LE(cv::norm(tiled(apron), whole, cv::NORM_INF), 1);
    EXPECT_GT(cv::norm(tiled(0), whole, cv::NORM_INF), 4) << "without an apron there are seams";
}

TEST_P(SpreadInPicture, SeveralSamplesSmoothEdgesAndLeaveTheRestAlone)
{
    CloseUp one(GetParam()), four(GetParam(), 4);
    one.request.camera = four.request.camera =
        one.stage.loaded().camera(); // the whole head, with its outline
    cv::Mat apart;
    cv::absdiff(one.picture(), four.picture(), apart);
    int differing = 0;
    for (const cv::Vec4b& pixel : cv::Mat4b(apart))
        differing += std::max({pixel[0], pixel[1], pixel[2]}) > 16;
    EXPECT_GT(differing, 60);
    EXPECT_LT(differing, 2000); // of 65536
}

TEST_P(SpreadInPicture, RunsItsPassesForACameraAndItsRegionsHoldAllThatADayChanges)
{
    CloseUp studio(GetParam());
    studio.request.every_frame = false;
    studio.executor.measure({.check_regions = true}); // throws where the picture is not the whole frame's
    for (const double day : {2., 3., 9., 40.}) {
        studio.request.day = day;
        EXPECT_NO_THROW(studio.draw()) << day;
    }
    EXPECT_THAT(gpu_test::ran(studio.draw()), testing::IsEmpty());
    studio.request.camera->eye.x += .001;
    const std::vector<std::string> ran = gpu_test::ran(studio.draw());
    std::vector<std::string> expected{"forward", "tonemap"};
    if (GetParam() != Transport::Separable)
        expected.push_back(optics::transport_names[std::size_t(GetParam())]);
    else
        expected.insert(expected.end(), {"separable x", "separable y"});
    EXPECT_THAT(ran, testing::IsSupersetOf(expected));
}

// All samples together are the light on all the skin: here its area, as far as it is open to the light around
// it.
TEST_F(ChangSamples, AreTheLightOnAllTheSkin)
{
    const head::Model model = small::head();
    scene::Scene scene = small::scene(model);
    scene.wounds.clear();
    scene.lights.clear();
    scene.shading.transport = Transport::Chang;
    scene.shading.ambient = {1, 1, 1};
    const stage::Stage stage(gpu_test::device(), stage::Stage::prepare(scene));
    graph::Graph graph;
    graph.readback("picture", stage.declare(graph, {.tile = scene.size}).images.picture);
    const auto back = [&](const char* name) {
        const auto found = std::ranges::find(graph.images, name, &graph::Graph::Image::name);
        return graph.readback(name, {std::uint32_t(found - graph.images.begin())});
    };
    const graph::ReadbackId lights = back("sample lights"), places = back("sample places");
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const gpu::FrameResult frame = executor.run(graph);
    const cv::Mat4f light = frame.mat(lights), place = frame.mat(places);

    double area_mm2 = 0;
    glm::dvec3 middle(0);
    for (std::size_t i = 0; i + 2 < model.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return 1e3 * glm::dvec3(model.vertices[model.indices[i + k]].position);
        };
        const double area = .5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        area_mm2 += area;
        middle += area / 3 * (at(0) + at(1) + at(2));
    }
    middle /= area_mm2;
    double sum = 0;
    glm::dvec3 mean(0);
    for (int i = 0; i < light.cols; ++i) {
        sum += light(0, i)[1];
        mean += glm::dvec3(place(0, i)[0], place(0, i)[1], place(0, i)[2]) / double(light.cols);
    }
    EXPECT_GT(sum, .85 * area_mm2);
    EXPECT_LT(sum, 1.01 * area_mm2);
    EXPECT_LT(glm::distance(mean, middle), 8); // mm, of a head of 230
}

} // namespace
