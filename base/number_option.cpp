#include "base/number_option.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>

#include "base/input_error.hpp"

namespace base {

namespace {

/// NaN when the text is not a number or exceeds the range of a double.
double number(const std::string& text)
{
    double value = NAN;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && rest == end ? value : NAN;
}

std::string range(double low, double high)
{
    return fmt::format("{} to {}", plain(low), plain(high));
}

} // namespace

CLI::Validator number_from(double low, double high)
{
    return {[low, high](std::string& text) -> std::string {
                const double value = number(text);
                if (value >= low && value <= high) // false for NaN
                    return {};
                return fmt::format("\"{}\" is not a number from {}", text, range(low, high));
            },
            range(low, high)};
}

CLI::Validator whole_number_from(double low, double high)
{
    return {[low, high](std::string& text) -> std::string {
                const double value = number(text);
                if (!(value >= low && value <= high && value == std::floor(value)))
                    return fmt::format("\"{}\" is not a whole number from {}", text, range(low, high));
                text = fmt::format("{}", static_cast<std::int64_t>(value));
                return {};
            },
            range(low, high)};
}

} // namespace base
