// Everything that rays need of a scene on a day.
#pragma once
#include "reference/path_tracer.hpp"

namespace reference {

struct Traceable
{
    DayWounds wounds;
    Surfaces surfaces;
    PathTracer tracer;

    /// Keeps a reference to the scene. With subsurface scattering all cores work for some seconds when a
    /// tissue is first seen.
    Traceable(const scene::LoadedScene& scene, const Levels& levels, double day)
        : wounds(scene, day, levels.subsurface ? std::optional(levels.medium) : std::nullopt),
          surfaces(scene, wounds), tracer(scene, surfaces, wounds, levels)
    {
    }
    Traceable(const Traceable&) = delete;
    Traceable& operator=(const Traceable&) = delete;
};

} // namespace reference
