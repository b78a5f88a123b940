#include "wound/synthetic/kind.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/smoothstep.hpp"

namespace wound {

WoundKind abrasion(), laceration(), avulsion(), excision(), punch(), burn(), ulcer();

const std::vector<WoundKind>& wound_kinds()
{
    // A kind's place here is part of its seed: add at the end.
    static const std::vector<WoundKind> kinds{abrasion(), laceration(), avulsion(), excision(),
                                              punch(),    burn(),       ulcer()};
    return kinds;
}

const std::vector<std::string>& kind_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const WoundKind& kind : wound_kinds())
            all.emplace_back(kind.name);
        return all;
    }();
    return names;
}

const WoundKind& kind_named(std::string_view name)
{
    const auto found = std::ranges::find(wound_kinds(), name, &WoundKind::name);
    assert(found != wound_kinds().end());
    return *found;
}

Healing usual_healing(const WoundKind& kind, double width_mm, const TissueThickness& tissue)
{
    const Course& course = kind.course;
    const double bony = base::smoothstep(5, 3, tissue.subcutis);
    const double longer =
        std::pow(width_mm / course.width_mm, course.size_exponent) * std::lerp(1, course.over_bone, bony);
    Healing healing = course.healing;
    healing.curve.delta = std::clamp(healing.curve.delta / std::pow(longer, healing.curve.gamma), 0., 10.);
    return healing;
}

} // namespace wound
