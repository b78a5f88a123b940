// The cubic step between two thresholds.
#pragma once
#include <algorithm>

namespace wound {

/// 0 at `low`, 1 at `high`, with level ends; `low` may be greater than `high`.
inline float smooth(float low, float high, float x)
{
    const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
    return t * t * (3 - 2 * t);
}

} // namespace wound
