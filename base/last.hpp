// The last result of a costly function, for an argument that seldom changes.
#pragma once
#include <optional>
#include <utility>

namespace base {

/// Not for several threads at once: where functions keep one, it is thread_local.
template <class Argument, class Result>
class Last
{
  public:
    template <class Function>
    const Result& of(const Argument& argument, const Function& function)
    {
        if (!known_ || !(known_->first == argument))
            known_.emplace(argument, function(argument));
        return known_->second;
    }

  private:
    std::optional<std::pair<Argument, Result>> known_;
};

} // namespace base
