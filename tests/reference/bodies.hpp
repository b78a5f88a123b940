// Bodies whose surface is a formula.
#pragma once
#include <cmath>

#include "reference/random_walk.hpp"

namespace reference {

/// About the origin.
struct Ball : Body
{
    double radius = 1;

    explicit Ball(double metres) : radius(metres) {}
    std::optional<SurfaceHit> first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                           double reach) const override
    {
        const double along = glm::dot(origin, direction);
        const double rest = along * along - glm::dot(origin, origin) + radius * radius;
        if (rest < 0)
            return std::nullopt;
        for (const double distance : {-along - std::sqrt(rest), -along + std::sqrt(rest)})
            if (distance > 1e-9 * radius && distance <= reach)
                return SurfaceHit{.distance = distance, .normal = (origin + distance * direction) / radius};
        return std::nullopt;
    }
};

} // namespace reference
