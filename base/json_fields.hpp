// Strict reading of one JSON object. The caller requests each field by name. A wrong type, a number out of
// range or an unrequested field is an error that names file and field.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/file.hpp"

namespace base {

class Fields
{
  public:
    /// `where` is "FILE: /path/in/json". Throws when `object` is not a JSON object.
    Fields(const nlohmann::json& object, std::string where);

    bool has(const std::string& name) const;
    /// Returns the field, or null when it is absent, and marks its name as known.
    const nlohmann::json* get(const std::string& name);
    double number(const std::string& name, double fallback, double low, double high);
    /// Like number(), but a missing field is an error.
    double required_number(const std::string& name, double low, double high);
    /// A required field: a number, or an array of at least one number.
    std::vector<double> number_or_list(const std::string& name, double low, double high);
    std::int64_t integer(const std::string& name, std::int64_t fallback, std::int64_t low, std::int64_t high);
    bool boolean(const std::string& name, bool fallback);
    std::string text(const std::string& name, const std::string& fallback);
    /// A text that must be one of `allowed`.
    std::string choice(const std::string& name, const std::string& fallback,
                       const std::vector<std::string>& allowed);
    /// An array of exactly N finite numbers in [low, high].
    template <std::size_t N>
    std::array<double, N> numbers(const std::string& name, std::array<double, N> fallback, double low,
                                  double high)
    {
        const nlohmann::json* value = get(name);
        if (value != nullptr) {
            check_numbers(name, *value, N, low, high);
            for (std::size_t i = 0; i < N; ++i)
                fallback[i] = (*value)[i].get<double>();
        }
        return fallback;
    }
    std::string where(const std::string& name) const { return where_ + "/" + name; }
    /// Call last: throws when the object has a field that was not requested, and lists the known fields.
    void finish() const;

    [[noreturn]] void fail(const std::string& name, const std::string& what, const std::string& cure) const;

  private:
    void check_numbers(const std::string& name, const nlohmann::json& value, std::size_t count, double low,
                       double high) const;

    const nlohmann::json& object_;
    std::string where_;
    std::set<std::string> asked_;
};

} // namespace base
