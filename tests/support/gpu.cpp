#include "tests/support/gpu.hpp"

#ifdef __SANITIZE_ADDRESS__
// Synchronisation validation of the 1.3.239 layer leaks command buffer states that refer to each other.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libVkLayer_khronos_validation.so\n";
}
#endif

namespace gpu_test {

gpu::Device& device()
{
    static gpu::Device shared({.validation = true});
    return shared;
}

const graph::ShaderLibrary& shaders()
{
    static const graph::ShaderLibrary library = [] {
        graph::ShaderLibrary all;
        all.add(graph::test_shaders());
        return all;
    }();
    return library;
}

std::vector<std::string> passes_in(const gpu::FrameResult& frame, graph::PassState state)
{
    std::vector<std::string> names;
    for (const gpu::PassResult& pass : frame.passes)
        if (pass.state == state)
            names.push_back(pass.name);
    return names;
}

void Test::TearDown()
{
    for (const std::string& message : device().validation_messages())
        ADD_FAILURE() << "validation: " << message;
}

} // namespace gpu_test
