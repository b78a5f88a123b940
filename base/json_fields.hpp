// Strict reading of one JSON object: each field is asked for by name, wrong types and out-of-range numbers
// are errors that name file and field, and what was not asked for is an error too.
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
    /// `where` is "FILE: /path/in/json". Throws when `object` is no object.
    Fields(const nlohmann::json& object, std::string where);

    bool has(const std::string& name) const;
    /// The field as it is, marked as known; null when absent.
    const nlohmann::json* get(const std::string& name);
    double number(const std::string& name, double fallback, double low, double high);
    /// The same, and its absence is an error.
    double required_number(const std::string& name, double low, double high);
    /// Required: a number, or an array of at least one.
    std::vector<double> number_or_list(const std::string& name, double low, double high);
    std::int64_t integer(const std::string& name, std::int64_t fallback, std::int64_t low, std::int64_t high);
    bool boolean(const std::string& name, bool fallback);
    std::string text(const std::string& name, const std::string& fallback);
    /// One of `allowed`.
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
    /// Call last: throws when the object holds a field that nobody asked for, and lists those that exist.
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
