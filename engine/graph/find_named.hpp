// Linear search by name in the short lists of declarations and reflections.
#pragma once
#include <algorithm>
#include <string_view>

namespace graph {

/// Null when nothing in the list has that name.
template <typename List>
const typename List::value_type* find_named(const List& list, std::string_view name)
{
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
    return found == list.end() ? nullptr : &*found;
}

} // namespace graph
