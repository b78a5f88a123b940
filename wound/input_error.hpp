// The one exception for what the machine or the user's files do wrong. It lives in wound/ because wound/
// depends on nothing else of ours and everything else may depend on wound/.
#pragma once
#include <fmt/format.h>
#include <stdexcept>
#include <string_view>

namespace cicatrix {

/// what() is one line: "WHERE: WHAT; CURE". WHERE names the file and, where there is one, the field
/// ("scene.json: /wounds/0/width_mm").
class InputError : public std::runtime_error
{
  public:
    InputError(std::string_view where, std::string_view what, std::string_view cure)
        : std::runtime_error(fmt::format("{}: {}; {}", where, what, cure))
    {
    }
};

} // namespace cicatrix
