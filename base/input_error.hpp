// The one exception for what the machine or the user's files do wrong.
#pragma once
#include <cstdlib>
#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <string_view>

namespace base {

/// what() is one line: "WHERE: PROBLEM; CURE". WHERE names the file and, where there is one, the field
/// ("scene.json: /wounds/0/width_mm").
class InputError : public std::runtime_error
{
  public:
    InputError(std::string_view where, std::string_view problem, std::string_view cure)
        : std::runtime_error(fmt::format("{}: {}; {}", where, problem, cure)), where_(where),
          problem_(problem), cure_(cure)
    {
    }
    const std::string& where() const { return where_; }
    const std::string& problem() const { return problem_; }
    const std::string& cure() const { return cure_; }

  private:
    std::string where_, problem_, cure_;
};

/// A number as people write it, for messages: 0.5, 4294967295, 1e10.
inline std::string plain(double number)
{
    std::string text = fmt::format("{:g}", number);
    if (std::strtod(text.c_str(), nullptr) != number)
        return fmt::format("{}", number);
    if (const std::size_t exponent = text.find("e+"); exponent != std::string::npos)
        text.erase(exponent + 1, text[exponent + 2] == '0' ? 2 : 1);
    return text;
}

} // namespace base
