// Compares a C++ struct with a block or struct in a compiled shader: names, offsets and sizes of members.
#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace gpu_test {

struct Member
{
    std::string_view name;
    std::size_t offset, size;
};

/// A `gpu_test::Member` for one member of a C++ struct; list them in the order of declaration.
#define CICATRIX_MEMBER(type, member)                                                                        \
    gpu_test::Member                                                                                         \
    {                                                                                                        \
#member, offsetof(type, member), sizeof(type::member)                                                \
    }

/// Fails the test for every difference. `shader` is a file name, `name` the struct's or block's name in it.
/// `expect_layout("forward.frag", "Light", sizeof(Light), {CICATRIX_MEMBER(Light, direction), ...})`
void expect_layout(std::string_view shader, std::string_view name, std::size_t size,
                   std::initializer_list<Member> members);

} // namespace gpu_test
