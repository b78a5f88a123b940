// GLSL's type names for C++, so that the structs of shaders/shared/ are written once. Blocks that contain
// them use layout(scalar), which packs like C++.
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
