// The cubic step between two thresholds.
#pragma once
#include <algorithm>

namespace base {

/// 0 at `low`, 1 at `high`, with zero slope at both; `low` may be greater than `high`.
inline double smoothstep(double low, double high, double x)
{
    const double t = std::clamp((x - low) / (high - low), 0., 1.);
    return t * t * (3 - 2 * t);
}
inline float smoothstep(float low, float high, float x)
{
    const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
    return t * t * (3 - 2 * t);
}

} // namespace base
