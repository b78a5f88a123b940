#include "base/json_fields.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"

namespace base {
namespace {

TEST(JsonFields, RefusesAnIntegerThatOnlyFitsUnsigned)
{
    const auto fields =
        nlohmann::json::parse(R"({"wrapped": 18446744073709551615, "largest": 9223372036854775807})");
    Fields read(fields, "a.json: /");
    EXPECT_THROW(read.integer("wrapped", 0, -10, 10), InputError); // -1 when it wraps
    EXPECT_EQ(read.integer("largest", 0, 0, INT64_MAX), INT64_MAX);
}

} // namespace
} // namespace base
