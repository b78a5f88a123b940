// Reflection of a compiled shader: bindings, vertex inputs, specialisation
// constants, block layouts. Reads only the SPIR-V instructions that declare
// these; all modules are compiled from shaders/ and validated at build time.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include <volk.h>

namespace graph {

struct ShaderMember
{
    std::string name;
    std::uint32_t offset = 0, size = 0; // bytes; size of an unsized array: 0
    bool operator==(const ShaderMember&) const = default;
};

/// A struct with member offsets: a block, or a struct inside a block.
struct ShaderStruct
{
    std::string name;
    std::uint32_t size = 0; // bytes up to the end of the last member
    std::vector<ShaderMember> members;
};

struct ShaderBinding
{
    std::string name; // instance name, or the block's name without one
    std::uint32_t set = 0, binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    std::uint32_t count = 1;  // elements of a sampler array; else 1
    std::uint32_t size = 0;   // bytes of a uniform block, or of a storage block before its unsized array
    std::uint32_t stride = 0; // bytes of one element of the unsized array
    VkFormat format = VK_FORMAT_UNDEFINED; // of a storage image
};

struct ShaderInput
{
    std::string name;
    std::uint32_t location = 0, components = 0; // components: 32-bit floats
};

struct ShaderConstant
{
    enum class Type : std::uint8_t
    {
        Bool,
        Int,
        Uint,
        Float
    };
    std::string name;
    std::uint32_t id = 0;
    Type type = Type::Bool;
};

struct ShaderInterface
{
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_ALL;
    std::array<std::uint32_t, 3> local_size{1, 1, 1};
    std::vector<ShaderBinding> bindings;
    std::vector<ShaderInput> inputs; // of a vertex shader, without built-ins
    std::uint32_t outputs = 0;       // number of colours a fragment shader writes
    std::vector<ShaderConstant> constants;
    std::vector<ShaderStruct> structs;
    std::vector<std::string>
        unsupported; // interface the engine does not support: push constants, sets other than 0, ...

    const ShaderBinding* find_binding(std::string_view name) const;
    const ShaderConstant* find_constant(std::string_view name) const;
    const ShaderStruct* find_struct(std::string_view name) const;
};

/// Throws std::logic_error when the words are not a SPIR-V module.
ShaderInterface reflect(std::span<const std::uint32_t> words);

} // namespace graph
