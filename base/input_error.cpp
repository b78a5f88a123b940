#include "base/input_error.hpp"

#include <cstdlib>
#include <fmt/format.h>

#include "base/text.hpp"

namespace base {

InputError::InputError(std::string_view where, std::string_view problem, std::string_view cure)
    : std::runtime_error(printable(fmt::format("{}: {}; {}", where, problem, cure))), where_(where),
      problem_(problem), cure_(cure)
{
}

std::string plain(double number)
{
    std::string text = fmt::format("{:g}", number);
    if (std::strtod(text.c_str(), nullptr) != number)
        return fmt::format("{}", number);
    if (const std::size_t exponent = text.find("e+"); exponent != std::string::npos)
        text.erase(exponent + 1, text[exponent + 2] == '0' ? 2 : 1);
    return text;
}

} // namespace base
