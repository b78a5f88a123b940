// Raster passes on a device: meshes, facing, depth, blending, multisampling. Every test runs under
// validation.
#include "engine/gpu/executor.hpp"
#include "engine/gpu/mesh_buffer.hpp"
#include "tests/support/gpu.hpp"

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace {

struct Vertex
{
    glm::vec3 position, normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};
constexpr std::array<graph::VertexAttribute, 4> attributes{{
    {"position", 3, offsetof(Vertex, position)},
    {"normal", 3, offsetof(Vertex, normal)},
    {"tangent", 4, offsetof(Vertex, tangent)},
    {"uv", 2, offsetof(Vertex, uv)},
}};
constexpr graph::VertexLayout layout{sizeof(Vertex), attributes};

gpu::MeshBuffer mesh_of(const std::vector<Vertex>& vertices, const std::string& name)
{
    return {gpu_test::device(), layout, std::as_bytes(std::span(vertices)),
            std::vector<std::uint32_t>{0, 1, 2}, name};
}

/// A triangle over the lower left half of the picture, counter-clockwise on the screen.
gpu::MeshBuffer lower_left_triangle()
{
    std::vector<Vertex> vertices(3);
    vertices[0] = {.position = {-1, -1, 0}, .normal = {}, .tangent = {}, .uv = {0, 0}}; // top left: y is down
    vertices[1] = {.position = {-1, 1, 0}, .normal = {}, .tangent = {}, .uv = {0, 1}};
    vertices[2] = {.position = {1, 1, 0}, .normal = {}, .tangent = {}, .uv = {1, 1}};
    return mesh_of(vertices, "triangle");
}

struct MeshScene
{
    explicit MeshScene(std::uint32_t samples)
    {
        const VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
        const graph::ImageId color = graph.image("color", {16, 16, format, samples});
        picture = samples > 1 ? graph.image("resolved", {16, 16, format}) : color;
        pass = &graph.raster("mesh");
        pass->color(color, {0, 0, 0, 1}, samples > 1 ? picture : graph::ImageId{});
        pass->depth(graph.image("depth", {16, 16, VK_FORMAT_D32_SFLOAT, samples}));
        graph.readback("picture", picture);
    }

    graph::Draw& draw(const gpu::MeshBuffer& mesh, float depth, glm::vec4 paint)
    {
        graph::Draw& added = pass->draw("test_mesh");
        added.mesh = &mesh;
        added.uniform("place", depth);
        added.uniform("Paint", paint);
        return added;
    }

    cv::Mat4b run() const
    {
        gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
        return executor.run(graph).mat(graph::ReadbackId{0}).clone();
    }

    graph::Graph graph;
    graph::ImageId picture;
    graph::RasterPass* pass = nullptr;
};

using RasterTest = gpu_test::Test;

TEST_F(RasterTest, DrawsCounterClockwiseTrianglesAndCullsTheirBacks)
{
    const gpu::MeshBuffer front = lower_left_triangle();
    MeshScene scene(1);
    scene.draw(front, 0.5f, glm::vec4(1, 0, 0, 1));
    const cv::Mat4b picture = scene.run();
    EXPECT_EQ(picture(15, 0), cv::Vec4b(255, 0, 0, 255));
    EXPECT_EQ(picture(0, 15), cv::Vec4b(0, 0, 0, 255));

    std::vector<Vertex> turned(3);
    turned[0].position = {-1, -1, 0};
    turned[1].position = {1, 1, 0};
    turned[2].position = {-1, 1, 0};
    const gpu::MeshBuffer back = mesh_of(turned, "back");
    MeshScene culled(1), shown(1);
    culled.draw(back, 0.5f, glm::vec4(1));
    shown.draw(back, 0.5f, glm::vec4(1)).cull_back_faces = false;
    EXPECT_EQ(culled.run()(15, 0), cv::Vec4b(0, 0, 0, 255));
    EXPECT_EQ(shown.run()(15, 0), cv::Vec4b(255, 255, 255, 255));
}

TEST_F(RasterTest, TheNearerSurfaceWinsUnlessDepthIsNotTested)
{
    const gpu::MeshBuffer mesh = lower_left_triangle();
    MeshScene scene(1);
    scene.draw(mesh, 0.2f, glm::vec4(1, 0, 0, 1));
    graph::Draw& far = scene.draw(mesh, 0.7f, glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(scene.run()(15, 0), cv::Vec4b(255, 0, 0, 255));
    far.depth_test = false;
    EXPECT_EQ(scene.run()(15, 0), cv::Vec4b(0, 255, 0, 255));
}

TEST_F(RasterTest, DepthCanBeSampledAndReadBack)
{
    const gpu::MeshBuffer mesh = lower_left_triangle();
    MeshScene scene(1);
    scene.draw(mesh, 0.25f, glm::vec4(1));
    const graph::ImageId shown = scene.graph.image("shown", {16, 16, VK_FORMAT_R32_SFLOAT});
    graph::RasterPass& show = scene.graph.raster("show");
    show.color(shown, {});
    show.sample("source", scene.pass->depth_image, graph::Sampler::NearestClamp);
    show.uniform("Tint", glm::vec4(2.0f));
    show.draw("test_quad").index_count = 3;
    const graph::ReadbackId depth = scene.graph.readback("depth", scene.pass->depth_image);
    const graph::ReadbackId doubled = scene.graph.readback("doubled", shown);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    const gpu::FrameResult result = executor.run(scene.graph);
    EXPECT_EQ(result.mat(depth).at<float>(15, 0), 0.25f);
    EXPECT_EQ(result.mat(depth).at<float>(0, 15), 1.0f);
    EXPECT_EQ(result.mat(doubled).at<float>(15, 0), 0.5f);
}

TEST_F(RasterTest, BlendsSourceAlphaOver)
{
    const gpu::MeshBuffer mesh = lower_left_triangle();
    MeshScene scene(1);
    scene.draw(mesh, 0.5f, glm::vec4(1, 0, 0, 1));
    scene.draw(mesh, 0.5f, glm::vec4(0, 1, 0, 0.2f)).blend = true;
    EXPECT_EQ(scene.run()(15, 0), cv::Vec4b(204, 51, 0, 255));
}

TEST_F(RasterTest, GivesTheShaderTheVertexAttributesItNames)
{
    const gpu::MeshBuffer mesh = lower_left_triangle();
    MeshScene scene(1);
    scene.draw(mesh, 0.5f, glm::vec4(0)).constant("show_uv", true);
    const cv::Vec4b texel = scene.run()(12, 4);
    EXPECT_NEAR(texel[0], 255 * 4.5 / 16, 1.0);
    EXPECT_NEAR(texel[1], 255 * 12.5 / 16, 1.0);
}

TEST_F(RasterTest, MultisamplingSmoothsTheEdgeAndOnlyTheEdge)
{
    const gpu::MeshBuffer mesh = lower_left_triangle();
    MeshScene scene(4);
    scene.draw(mesh, 0.5f, glm::vec4(1));
    const cv::Mat4b picture = scene.run();
    EXPECT_EQ(picture(15, 0)[0], 255);
    EXPECT_EQ(picture(0, 15)[0], 0);
    EXPECT_GT(picture(8, 8)[0], 50);
    EXPECT_LT(picture(8, 8)[0], 205);
}

TEST_F(RasterTest, TwoExecutorsGiveTheSameBits)
{
    const auto bytes = [] {
        const gpu::MeshBuffer mesh = lower_left_triangle();
        MeshScene scene(4);
        scene.draw(mesh, 0.5f, glm::vec4(0)).constant("show_uv", true);
        gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
        return executor.run(scene.graph).readbacks[0].bytes;
    };
    EXPECT_EQ(bytes(), bytes());
}

} // namespace
