// Work on many equal things with all cores.
#pragma once
#include <cstddef>
#include <functional>

namespace base {

/// Calls work(i) for every i below `count`, in no particular order, by so many threads (0: one per core), the
/// caller's among them. What one of them throws stops the others and is thrown on.
void in_parallel(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work);

} // namespace base
