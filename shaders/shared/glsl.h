// GLSL's types by their own names in C++, so that the structs of shaders/shared/ are written once. Blocks that hold them
// are layout(scalar): the C++ packing.
#ifndef SHARED_GLSL_H
#define SHARED_GLSL_H
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace shared {
using glm::ivec2;
using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
} // namespace shared
#endif
#endif
