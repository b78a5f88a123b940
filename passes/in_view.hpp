// What of a head a camera may see, found on the CPU before a frame is declared, so that nothing is made for
// what the frame cannot show. All tests are cautious: they may keep too much, never too little.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "head/model.hpp"

namespace passes {

struct Bounds
{
    glm::vec3 min, max; // metres
};

std::array<glm::dvec3, 8> corners(const Bounds& box);

/// Some hundred boxes that together hold all triangles: each holds those whose middle lies in one cell of a
/// grid.
std::vector<Bounds> boxes_around(const head::Model& model);

/// The boxes that reach into the view. They stay the same while a camera moves a little.
std::vector<Bounds> boxes_in_view(std::span<const Bounds> boxes, const glm::mat4& clip_from_world);

struct Triangle
{
    std::array<glm::vec3, 3> corners; // counter-clockwise seen from the front
    bool double_sided = false;
};

/// Whether some pixel of the view, `size` pixels wide and high, may show one of the triangles: false when
/// each is outside the picture or turns its back to the camera.
bool may_show(std::span<const Triangle> triangles, const glm::mat4& clip_from_world,
              std::array<std::uint32_t, 2> size);

} // namespace passes
