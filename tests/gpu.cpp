#include "tests/gpu.hpp"

namespace gpu {

engine::Device& device()
{
    static engine::Device shared({.validation = true});
    return shared;
}

const engine::ShaderLibrary& shaders()
{
    static const engine::ShaderLibrary library = []
    {
        engine::ShaderLibrary all;
        all.add(engine::test_shaders());
        return all;
    }();
    return library;
}

void Test::TearDown()
{
    for (const std::string& message : device().validation_messages())
        ADD_FAILURE() << "validation: " << message;
}

} // namespace gpu
