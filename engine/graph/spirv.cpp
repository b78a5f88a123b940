#include "engine/graph/spirv.hpp"

#include "engine/graph/find_named.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <spirv/unified1/spirv.hpp>
#include <stdexcept>

namespace graph {

namespace {

struct Instruction
{
    spv::Op op;
    std::span<const std::uint32_t> words; // operands, without the first word
};

std::string text_at(std::span<const std::uint32_t> words)
{
    std::string text;
    for (const std::uint32_t word : words)
        for (int byte = 0; byte < 4; ++byte) {
            const char c = static_cast<char>(word >> (8 * byte) & 0xffu);
            if (c == '\0')
                return text;
            text.push_back(c);
        }
    return text;
}

VkFormat storage_format(spv::ImageFormat format)
{
    switch (format) {
    case spv::ImageFormatR8:
        return VK_FORMAT_R8_UNORM;
    case spv::ImageFormatRg8:
        return VK_FORMAT_R8G8_UNORM;
    case spv::ImageFormatRgba8:
        return VK_FORMAT_R8G8B8A8_UNORM;
    case spv::ImageFormatR16f:
        return VK_FORMAT_R16_SFLOAT;
    case spv::ImageFormatRg16f:
        return VK_FORMAT_R16G16_SFLOAT;
    case spv::ImageFormatRgba16f:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case spv::ImageFormatR32f:
        return VK_FORMAT_R32_SFLOAT;
    case spv::ImageFormatRg32f:
        return VK_FORMAT_R32G32_SFLOAT;
    case spv::ImageFormatRgba32f:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    default:
        return VK_FORMAT_UNDEFINED;
    }
}

class Reflector
{
  public:
    explicit Reflector(std::span<const std::uint32_t> words)
    {
        if (words.size() < 5 || words[0] != spv::MagicNumber)
            throw std::logic_error("not a SPIR-V module");
        for (words = words.subspan(5); !words.empty();) {
            const std::uint32_t count = words[0] >> spv::WordCountShift;
            if (count == 0 || count > words.size())
                throw std::logic_error("truncated SPIR-V module");
            take({static_cast<spv::Op>(words[0] & spv::OpCodeMask), words.subspan(1, count - 1)});
            words = words.subspan(count);
        }
    }

    ShaderInterface result()
    {
        for (const auto& [id, type] : types_)
            if (type.op == spv::OpTypeStruct && member_decoration(id, 0, spv::DecorationOffset))
                out_.structs.push_back(describe_struct(id));
        for (std::size_t axis = 0; axis < local_size_ids_.size(); ++axis)
            out_.local_size[axis] = values_.at(local_size_ids_[axis]);
        for (const Variable& variable : variables_)
            describe(variable);
        std::sort(out_.bindings.begin(), out_.bindings.end(),
                  [](const ShaderBinding& a, const ShaderBinding& b) { return a.binding < b.binding; });
        std::sort(out_.inputs.begin(), out_.inputs.end(),
                  [](const ShaderInput& a, const ShaderInput& b) { return a.location < b.location; });
        return std::move(out_);
    }

  private:
    using Id = std::uint32_t;
    struct Variable
    {
        Id id, pointer_type;
        spv::StorageClass storage;
    };

    void take(const Instruction& i)
    {
        switch (i.op) {
        case spv::OpEntryPoint:
            take_stage(static_cast<spv::ExecutionModel>(i.words[0]));
            break;
        case spv::OpExecutionMode:
            if (i.words[1] == spv::ExecutionModeLocalSize)
                std::copy_n(i.words.begin() + 2, 3, out_.local_size.begin());
            break;
        case spv::OpExecutionModeId:
            if (i.words[1] == spv::ExecutionModeLocalSizeId) // the form of SPIR-V 1.6
                local_size_ids_ = i.words.subspan(2, 3);
            break;
        case spv::OpName:
            names_[i.words[0]] = text_at(i.words.subspan(1));
            break;
        case spv::OpMemberName:
            member_names_[{i.words[0], i.words[1]}] = text_at(i.words.subspan(2));
            break;
        case spv::OpDecorate:
            decorations_[{i.words[0], i.words[1]}] = i.words.size() > 2 ? i.words[2] : 1;
            break;
        case spv::OpMemberDecorate:
            member_decorations_[{i.words[0], i.words[1], i.words[2]}] = i.words.size() > 3 ? i.words[3] : 1;
            break;
        case spv::OpConstant:
            values_[i.words[1]] = i.words[2];
            break;
        case spv::OpSpecConstantTrue:
        case spv::OpSpecConstantFalse:
        case spv::OpSpecConstant:
            take_constant(i);
            break;
        case spv::OpVariable:
            variables_.push_back({i.words[1], i.words[0], static_cast<spv::StorageClass>(i.words[2])});
            break;
        default:
            if (i.op >= spv::OpTypeVoid && i.op <= spv::OpTypePointer)
                types_.emplace(i.words[0], i);
        }
    }

    void take_stage(spv::ExecutionModel model)
    {
        switch (model) {
        case spv::ExecutionModelVertex:
            out_.stage = VK_SHADER_STAGE_VERTEX_BIT;
            break;
        case spv::ExecutionModelFragment:
            out_.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
            break;
        case spv::ExecutionModelGLCompute:
            out_.stage = VK_SHADER_STAGE_COMPUTE_BIT;
            break;
        default:
            out_.unsupported.push_back("a stage other than vertex, fragment and compute");
        }
    }

    void take_constant(const Instruction& i)
    {
        const Id id = i.words[1];
        if (i.op == spv::OpSpecConstant)
            values_[id] = i.words[2]; // default value; array lengths may be specialisation constants
        const auto number = decoration(id, spv::DecorationSpecId);
        if (!number)
            return;
        using Type = ShaderConstant::Type;
        const Instruction& type = types_.at(i.words[0]);
        Type kind = Type::Bool;
        if (type.op == spv::OpTypeInt)
            kind = type.words[2] ? Type::Int : Type::Uint;
        else if (type.op == spv::OpTypeFloat)
            kind = Type::Float;
        if (type.op != spv::OpTypeBool && type.words[1] != 32)
            out_.unsupported.push_back("constant " + names_[id] + " of a type that is not 32 bits wide");
        out_.constants.push_back({names_[id], *number, kind});
    }

    std::optional<std::uint32_t> decoration(Id id, spv::Decoration what) const
    {
        const auto found = decorations_.find({id, what});
        return found == decorations_.end() ? std::nullopt : std::optional(found->second);
    }

    std::optional<std::uint32_t> member_decoration(Id id, std::uint32_t member, spv::Decoration what) const
    {
        const auto found = member_decorations_.find({id, member, what});
        return found == member_decorations_.end() ? std::nullopt : std::optional(found->second);
    }

    /// Bytes of a value of this type as member `member` of struct
    /// `parent`, which decorates matrices with their stride.
    std::uint32_t size_of(Id id, Id parent = 0, std::uint32_t member = 0) const
    {
        const Instruction& type = types_.at(id);
        switch (type.op) {
        case spv::OpTypeBool:
            return 4;
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
            return type.words[1] / 8;
        case spv::OpTypeVector:
            return size_of(type.words[1]) * type.words[2];
        case spv::OpTypeMatrix: {
            // Columns (or rows) are `stride` apart; the last has no padding after it.
            const std::uint32_t column = size_of(type.words[1]);
            const auto stride = member_decoration(parent, member, spv::DecorationMatrixStride);
            return stride.value_or(column) * (type.words[2] - 1) + column;
        }
        case spv::OpTypeArray: {
            const std::uint32_t stride =
                decoration(id, spv::DecorationArrayStride).value_or(size_of(type.words[1]));
            return stride * values_.at(type.words[2]);
        }
        case spv::OpTypeStruct:
            return struct_size(id);
        default:
            return 0;
        }
    }

    std::uint32_t struct_size(Id id) const
    {
        const Instruction& type = types_.at(id);
        std::uint32_t size = 0;
        for (std::uint32_t m = 0; m + 1 < type.words.size(); ++m)
            size = std::max(size, member_decoration(id, m, spv::DecorationOffset).value_or(0) +
                                      size_of(type.words[m + 1], id, m));
        return size;
    }

    ShaderStruct describe_struct(Id id) const
    {
        ShaderStruct described{.name = name_of(id), .size = struct_size(id), .members = {}};
        const Instruction& type = types_.at(id);
        for (std::uint32_t m = 0; m + 1 < type.words.size(); ++m) {
            const auto name = member_names_.find({id, m});
            described.members.push_back({name == member_names_.end() ? "" : name->second,
                                         member_decoration(id, m, spv::DecorationOffset).value_or(0),
                                         size_of(type.words[m + 1], id, m)});
        }
        return described;
    }

    std::string name_of(Id id) const
    {
        const auto name = names_.find(id);
        return name == names_.end() ? "" : name->second;
    }

    void describe(const Variable& variable)
    {
        const Id pointee = types_.at(variable.pointer_type).words[2];
        switch (variable.storage) {
        case spv::StorageClassUniformConstant:
        case spv::StorageClassUniform:
        case spv::StorageClassStorageBuffer:
            describe_binding(variable, pointee);
            break;
        case spv::StorageClassPushConstant:
            out_.unsupported.push_back("push constants");
            break;
        case spv::StorageClassInput:
            if (out_.stage == VK_SHADER_STAGE_VERTEX_BIT && !decoration(variable.id, spv::DecorationBuiltIn))
                describe_input(variable, pointee);
            break;
        case spv::StorageClassOutput:
            if (out_.stage == VK_SHADER_STAGE_FRAGMENT_BIT &&
                !decoration(variable.id, spv::DecorationBuiltIn))
                ++out_.outputs;
            break;
        default:
            break;
        }
    }

    void describe_input(const Variable& variable, Id pointee)
    {
        const Instruction& type = types_.at(pointee);
        ShaderInput input{.name = name_of(variable.id),
                          .location = decoration(variable.id, spv::DecorationLocation).value_or(0)};
        if (type.op == spv::OpTypeVector && types_.at(type.words[1]).op == spv::OpTypeFloat)
            input.components = type.words[2];
        else if (type.op == spv::OpTypeFloat)
            input.components = 1;
        else
            out_.unsupported.push_back("vertex input " + input.name + " that is not made of floats");
        out_.inputs.push_back(input);
    }

    void describe_binding(const Variable& variable, Id pointee)
    {
        ShaderBinding binding{.name = name_of(variable.id),
                              .set = decoration(variable.id, spv::DecorationDescriptorSet).value_or(0),
                              .binding = decoration(variable.id, spv::DecorationBinding).value_or(0)};
        Id element = pointee;
        if (types_.at(pointee).op == spv::OpTypeArray) {
            element = types_.at(pointee).words[1];
            binding.count = values_.at(types_.at(pointee).words[2]);
        }
        const Instruction& type = types_.at(element);
        if (type.op == spv::OpTypeSampledImage)
            binding.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        else if (type.op == spv::OpTypeImage && type.words[6] == 2) // 2: used without a sampler
        {
            binding.type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            binding.format = storage_format(static_cast<spv::ImageFormat>(type.words[7]));
        } else if (type.op == spv::OpTypeStruct) {
            binding.type = variable.storage == spv::StorageClassUniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                                        : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            binding.size = struct_size(element);
            binding.stride = unsized_stride(type);
            if (binding.name.empty())
                binding.name = name_of(element);
        }
        if (binding.type == VK_DESCRIPTOR_TYPE_MAX_ENUM ||
            (binding.count != 1 && binding.type != VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER))
            out_.unsupported.push_back("binding " + binding.name + " of a kind the engine does not support");
        if (binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE && binding.format == VK_FORMAT_UNDEFINED)
            out_.unsupported.push_back("storage image " + binding.name +
                                       " of a format the engine does not support");
        if (binding.set != 0)
            out_.unsupported.push_back("binding " + binding.name + " in a set other than 0");
        out_.bindings.push_back(std::move(binding));
    }

    std::uint32_t unsized_stride(const Instruction& block) const
    {
        const Id last = block.words.back();
        return types_.at(last).op == spv::OpTypeRuntimeArray
                   ? decoration(last, spv::DecorationArrayStride).value_or(0)
                   : 0;
    }

    ShaderInterface out_;
    std::map<Id, std::string> names_;
    std::map<std::pair<Id, std::uint32_t>, std::string> member_names_;
    std::map<std::pair<Id, std::uint32_t>, std::uint32_t> decorations_;
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> member_decorations_;
    std::map<Id, std::uint32_t> values_; // of 32-bit constants
    std::span<const Id> local_size_ids_;
    std::map<Id, Instruction> types_;
    std::vector<Variable> variables_;
};

} // namespace

const ShaderBinding* ShaderInterface::find_binding(std::string_view name) const
{
    return find_named(bindings, name);
}
const ShaderConstant* ShaderInterface::find_constant(std::string_view name) const
{
    return find_named(constants, name);
}
const ShaderStruct* ShaderInterface::find_struct(std::string_view name) const
{
    return find_named(structs, name);
}

ShaderInterface reflect(std::span<const std::uint32_t> words)
{
    return Reflector(words).result();
}

} // namespace graph
