// Lets a header of plain structs be read by C++ and by GLSL. With layout(scalar) both pack them alike, so no padding members.
// Such a header includes this file, wraps its structs in SHARED_BEGIN ... SHARED_END and uses vec2, vec3, vec4, mat4, uint, float.
#ifndef CICATRIX_SHARED_GLSL_H
#define CICATRIX_SHARED_GLSL_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#define SHARED_BEGIN                                                                                                   \
    namespace shared {                                                                                                 \
    using glm::mat4, glm::vec2, glm::vec3, glm::vec4, glm::ivec2, glm::uvec2;                                          \
    using uint = std::uint32_t;
#define SHARED_END }
#else
#define SHARED_BEGIN
#define SHARED_END
#endif

#endif
