#include "base/json_fields.hpp"

#include <cmath>
#include <fmt/ranges.h>

#include "base/input_error.hpp"

namespace base {
using nlohmann::json;

Fields::Fields(const json& object, std::string where) : object_(object), where_(std::move(where))
{
    if (!object.is_object())
        throw InputError(where_, "must be an object", "write { \"field\": value, ... }");
}

bool Fields::has(const std::string& name) const
{
    return object_.contains(name);
}

const json* Fields::get(const std::string& name)
{
    asked_.insert(name);
    const auto found = object_.find(name);
    return found == object_.end() ? nullptr : &*found;
}

void Fields::fail(const std::string& name, const std::string& what, const std::string& cure) const
{
    throw InputError(where(name), what, cure);
}

double Fields::number(const std::string& name, double fallback, double low, double high)
{
    const json* value = get(name);
    if (value == nullptr)
        return fallback;
    const double number = value->is_number() ? value->get<double>() : NAN;
    if (!(number >= low && number <= high)) // also false for NaN
        fail(name, "is " + value->dump(),
             fmt::format("give a number from {} to {}", plain(low), plain(high)));
    return number;
}

double Fields::required_number(const std::string& name, double low, double high)
{
    if (!has(name))
        fail(name, "is missing", "add this field");
    return number(name, low, low, high);
}

std::vector<double> Fields::number_or_list(const std::string& name, double low, double high)
{
    const json* value = get(name);
    if (value == nullptr || !value->is_array())
        return {required_number(name, low, high)};
    if (value->empty())
        fail(name, "is an empty array", "give one number or more");
    check_numbers(name, *value, value->size(), low, high);
    return value->get<std::vector<double>>();
}

std::int64_t Fields::integer(const std::string& name, std::int64_t fallback, std::int64_t low,
                             std::int64_t high)
{
    const json* value = get(name);
    if (value == nullptr)
        return fallback;
    const bool too_large =
        value->is_number_unsigned() && value->get<std::uint64_t>() > std::uint64_t(INT64_MAX);
    if (!value->is_number_integer() || too_large || value->get<std::int64_t>() < low ||
        value->get<std::int64_t>() > high)
        fail(name, "is " + value->dump(), fmt::format("give a whole number from {} to {}", low, high));
    return value->get<std::int64_t>();
}

bool Fields::boolean(const std::string& name, bool fallback)
{
    const json* value = get(name);
    if (value == nullptr)
        return fallback;
    if (!value->is_boolean())
        fail(name, "is " + value->dump(), "write true or false");
    return value->get<bool>();
}

std::string Fields::text(const std::string& name, const std::string& fallback)
{
    const json* value = get(name);
    if (value == nullptr)
        return fallback;
    if (!value->is_string())
        fail(name, "is " + value->dump(), "write a text in quotes");
    return value->get<std::string>();
}

std::string Fields::choice(const std::string& name, const std::string& fallback,
                           const std::vector<std::string>& allowed)
{
    const std::string value = text(name, fallback);
    for (const std::string& one : allowed)
        if (value == one)
            return value;
    fail(name, "is \"" + value + "\"", fmt::format("choose one of {}", fmt::join(allowed, ", ")));
}

void Fields::check_numbers(const std::string& name, const json& value, std::size_t count, double low,
                           double high) const
{
    const std::string cure =
        fmt::format("give an array of {} numbers from {} to {}", count, plain(low), plain(high));
    if (!value.is_array() || value.size() != count)
        fail(name, "is " + value.dump(), cure);
    for (const json& element : value)
        if (const double number = element.is_number() ? element.get<double>() : NAN;
            !(number >= low && number <= high))
            fail(name, "holds " + element.dump(), cure);
}

void Fields::finish() const
{
    for (const auto& [name, value] : object_.items())
        if (!asked_.contains(name))
            throw InputError(where(name), "is not a known field",
                             fmt::format("known fields are {}", fmt::join(asked_, ", ")));
}

} // namespace base
