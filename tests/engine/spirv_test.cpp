// Reflection of compiled shaders, and the errors when a pass and its shader do not match. No device.
#include "engine/gpu/device_choice.hpp"
#include "engine/graph/binding_check.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/layout.hpp"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Light
{
    glm::vec3 direction;
    float strength;
};

struct Everything
{
    glm::mat4 view;
    glm::vec3 eye;
    glm::mat3 rotation;
    glm::vec2 pair;
    float list[3];
    Light lights[2];
    std::uint32_t last;
};

const graph::ShaderInterface& layout_shader()
{
    return gpu_test::shaders().find("test_layout.comp")->interface;
}

TEST(Reflection, FindsBindingsByNameWithTypeCountAndSize)
{
    const graph::ShaderInterface& shader = layout_shader();
    EXPECT_EQ(shader.stage, VK_SHADER_STAGE_COMPUTE_BIT);
    EXPECT_THAT(shader.local_size, ElementsAre(16, 4, 1));
    EXPECT_THAT(shader.unsupported, IsEmpty());
    ASSERT_EQ(shader.bindings.size(), 4u);
    const graph::ShaderBinding* uniform = shader.find_binding("everything");
    ASSERT_TRUE(uniform);
    EXPECT_EQ(uniform->type, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    EXPECT_EQ(uniform->size, sizeof(Everything));
    const graph::ShaderBinding* points = shader.find_binding("Points");
    ASSERT_TRUE(points) << "a block without an instance name is found by its block name";
    EXPECT_EQ(points->type, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    EXPECT_EQ(points->size, 4u);
    EXPECT_EQ(points->stride, sizeof(Light));
    const graph::ShaderBinding* maps = shader.find_binding("maps");
    ASSERT_TRUE(maps);
    EXPECT_EQ(maps->type, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    EXPECT_EQ(maps->count, 2u);
    const graph::ShaderBinding* result = shader.find_binding("result");
    ASSERT_TRUE(result);
    EXPECT_EQ(result->type, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    EXPECT_EQ(result->format, VK_FORMAT_R8G8B8A8_UNORM);
}

TEST(Reflection, FindsSpecialisationConstantsWithTheirTypes)
{
    using Type = graph::ShaderConstant::Type;
    const graph::ShaderInterface& shader = layout_shader();
    ASSERT_EQ(shader.constants.size(), 4u);
    EXPECT_EQ(shader.find_constant("on")->type, Type::Bool);
    EXPECT_EQ(shader.find_constant("count")->type, Type::Int);
    EXPECT_EQ(shader.find_constant("flags")->type, Type::Uint);
    EXPECT_EQ(shader.find_constant("weight")->type, Type::Float);
    EXPECT_EQ(shader.find_constant("weight")->id, 7u);
}

TEST(Reflection, FindsTheInputsOfAVertexShaderWithoutTheBuiltInOnes)
{
    const graph::ShaderInterface& mesh = gpu_test::shaders().find("test_mesh.vert")->interface;
    ASSERT_EQ(mesh.inputs.size(), 2u);
    EXPECT_EQ(mesh.inputs[0].name, "position");
    EXPECT_EQ(mesh.inputs[0].components, 3u);
    EXPECT_EQ(mesh.inputs[1].name, "uv");
    EXPECT_EQ(mesh.inputs[1].components, 2u);
    EXPECT_THAT(gpu_test::shaders().find("test_quad.vert")->interface.inputs, IsEmpty());
}

TEST(Reflection, RefusesInvalidModules)
{
    EXPECT_THROW(graph::reflect({}), std::logic_error);
    EXPECT_THROW(graph::reflect(std::vector<std::uint32_t>{1, 2, 3, 4, 5}), std::logic_error);
    std::vector<std::uint32_t> cut(gpu_test::shaders().find("test_quad.vert")->words.begin(),
                                   gpu_test::shaders().find("test_quad.vert")->words.begin() + 8);
    EXPECT_THROW(graph::reflect(cut), std::logic_error);
}

TEST(Layout, OfScalarBlocksEqualsThatOfTheCppStructs)
{
    gpu_test::expect_layout("test_layout.comp", "Everything", sizeof(Everything),
                            {CICATRIX_MEMBER(Everything, view), CICATRIX_MEMBER(Everything, eye),
                             CICATRIX_MEMBER(Everything, rotation), CICATRIX_MEMBER(Everything, pair),
                             CICATRIX_MEMBER(Everything, list), CICATRIX_MEMBER(Everything, lights),
                             CICATRIX_MEMBER(Everything, last)});
    gpu_test::expect_layout("test_layout.comp", "Light", sizeof(Light),
                            {CICATRIX_MEMBER(Light, direction), CICATRIX_MEMBER(Light, strength)});
}

TEST(Layout, ADifferenceFailsTheTest)
{
    EXPECT_NONFATAL_FAILURE(gpu_test::expect_layout("test_layout.comp", "Light", sizeof(Light),
                                                    {CICATRIX_MEMBER(Light, direction), {"strength", 16, 4}}),
                            "Light.strength");
}

// ---- What passes bind, checked against what shaders declare

std::vector<std::string> problems_of(void (*declare)(graph::Graph&))
{
    graph::Graph graph;
    declare(graph);
    return graph::check_bindings(graph, gpu_test::shaders());
}

TEST(Bindings, NoShaderSamplesMoreThanADeviceMustOffer)
{
    std::uint32_t most = 0;
    for (const graph::EmbeddedShader& shader : graph::embedded_shaders()) {
        std::uint32_t textures = 0;
        for (const graph::ShaderBinding& binding : gpu_test::shaders().find(shader.name)->interface.bindings)
            if (binding.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
                textures += binding.count;
        EXPECT_LE(textures, gpu::textures_per_stage) << shader.name;
        most = std::max(most, textures);
    }
    EXPECT_EQ(most, gpu::textures_per_stage) << "the limit refuses devices for no reason";
}

TEST(Bindings, NoProblemIsReportedWhenEverythingIsGiven)
{
    EXPECT_THAT(problems_of([](graph::Graph& graph) {
                    graph::ComputePass& pass = graph.compute("fill", "test_fill.comp");
                    pass.store("result", graph::ImageId{0});
                    pass.uniform("params", glm::vec4(1.0f));
                    pass.buffer<glm::vec2>("Offsets", {});
                    pass.constant("gain", 2.0f);
                }),
                IsEmpty());
}

TEST(Bindings, EveryMistakeIsNamed)
{
    EXPECT_THAT(
        problems_of([](graph::Graph& graph) {
            graph::ComputePass& pass = graph.compute("fill", "test_fill.comp");
            pass.uniform("params", 1.0f);
            pass.buffer<float>("Offsets", std::vector{1.0f});
            pass.uniform("speed", 1.0f);
            pass.constant("gain", 2);
            graph.compute("none", "missing.comp");
            graph.compute("stem", "test_quad");
        }),
        ElementsAre(
            "pass fill: shader test_fill.comp is given no image to store to for result",
            "pass fill: shader test_fill.comp wants 16 bytes for params and is given 4",
            "pass fill: shader test_fill.comp wants elements of 8 bytes for Offsets and is given 4 bytes",
            "pass fill: shader test_fill.comp is given constant gain with another type",
            "pass fill: shader test_fill.comp has no binding or constant speed",
            "pass none: there is no shader missing.comp", "pass stem: test_quad is not a compute shader"));
}

TEST(Bindings, ADrawUsesTheBindingsOfItsPass)
{
    EXPECT_THAT(problems_of([](graph::Graph& graph) {
                    graph::RasterPass& pass = graph.raster("show");
                    pass.sample("source", graph::ImageId{0});
                    pass.draw("test_quad").uniform("Tint", glm::vec4(1.0f));
                }),
                IsEmpty());
    EXPECT_THAT(problems_of([](graph::Graph& graph) {
                    graph::RasterPass& pass = graph.raster("show");
                    pass.sample("source", graph::ImageId{0});
                    pass.uniform("exposure", 1.0f);
                    pass.draw("test_quad").uniform("tint", glm::vec4(1.0f));
                    pass.draw("test_mesh");
                }),
                ElementsAre("pass show: shader test_quad is given no uniform for Tint",
                            "pass show: shader test_quad has no binding or constant tint",
                            "pass show: shader test_mesh is given no uniform for place",
                            "pass show: shader test_mesh is given no uniform for Paint",
                            "pass show: draw test_mesh has no mesh, and its shader reads position",
                            "pass show: no shader of its draws has a binding or constant exposure"));
}

TEST(Bindings, ImagesMustHaveTheFormatAndNumberTheShaderWrites)
{
    EXPECT_THAT(
        problems_of([](graph::Graph& graph) {
            const graph::ImageDesc desc{8, 8, VK_FORMAT_R16G16B16A16_SFLOAT};
            graph::ComputePass& fill = graph.compute("fill", "test_fill.comp");
            fill.store("result", graph.image("half", desc));
            fill.uniform("params", glm::vec4(1.0f));
            fill.buffer<glm::vec2>("Offsets", {});
            graph::RasterPass& show = graph.raster("show");
            show.color(graph.image("first", desc), {});
            show.color(graph.image("second", desc), {});
            show.sample("source", graph::ImageId{0});
            show.draw("test_quad").uniform("Tint", glm::vec4(1.0f));
        }),
        ElementsAre("pass fill: shader test_fill.comp stores RGBA32F to half, which has another format",
                    "pass show: shader test_quad writes 1 colours, the pass has 2 targets"));
}

TEST(Bindings, AnArrayOfSamplersNeedsEveryElement)
{
    EXPECT_THAT(problems_of([](graph::Graph& graph) {
                    graph::ComputePass& pass = graph.compute("all", "test_layout.comp");
                    pass.sample("maps", graph::ImageId{0});
                    pass.store("result", graph::ImageId{1});
                    pass.uniform("everything", Everything{});
                    pass.buffer<std::uint32_t>("Points", std::vector(5, 0u));
                }),
                ElementsAre("pass all: shader test_layout.comp wants 2 images for maps and is given 1"));
}

} // namespace
