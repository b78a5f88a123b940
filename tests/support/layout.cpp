#include "tests/support/layout.hpp"

#include "tests/support/gpu.hpp"

namespace gpu_test {

void expect_layout(std::string_view shader, std::string_view name, std::size_t size,
                   std::initializer_list<Member> members)
{
    const graph::Shader* found = shaders().find(shader);
    ASSERT_TRUE(found) << "there is no shader " << shader;
    const graph::ShaderStruct* block = found->interface.find_struct(name);
    ASSERT_TRUE(block) << shader << " has no struct " << name;
    EXPECT_EQ(block->size, size) << shader << ": " << name;
    ASSERT_EQ(block->members.size(), members.size()) << shader << ": " << name;
    auto actual = block->members.begin();
    for (const Member& member : members) {
        EXPECT_EQ(actual->name, member.name) << shader << ": " << name;
        EXPECT_EQ(actual->offset, member.offset) << shader << ": " << name << "." << member.name;
        EXPECT_EQ(actual->size, member.size) << shader << ": " << name << "." << member.name;
        ++actual;
    }
}

} // namespace gpu_test
