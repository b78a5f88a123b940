// Where a slab that is lit on one half is dark: the share of full brightness, by two programs that walk
// photons.
#pragma once
#include <array>

struct SlabEdge
{
    double x_mm; // from the light
    std::array<double, 3> share;
};
inline constexpr SlabEdge slab_edges[] = {{.1, {.395, .343, .285}},
                                          {.5, {.222, .137, .074}},
                                          {1, {.126, .054, .019}},
                                          {2, {.048, .011, .0016}},
                                          {3, {.020, .0024, .0002}}};
