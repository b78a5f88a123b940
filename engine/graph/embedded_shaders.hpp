// The SPIR-V of every file in shaders/, compiled and validated at build time.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace graph {

struct EmbeddedShader
{
    std::string_view name;                // file name of the source, e.g. "forward.frag"
    std::span<const std::uint32_t> words; // SPIR-V 1.6
};

std::span<const EmbeddedShader> embedded_shaders();

} // namespace graph
