#include "wound/synthetic/kind.hpp"

#include <algorithm>
#include <cassert>

namespace wound {

WoundKind abrasion(), laceration(), avulsion();

const std::vector<WoundKind>& wound_kinds()
{
    // A kind's place here is part of its seed: add at the end.
    static const std::vector<WoundKind> kinds{abrasion(), laceration(), avulsion()};
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

} // namespace wound
