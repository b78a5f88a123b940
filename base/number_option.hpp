// Numbers on the command line: finite, within a range, in any notation (10000, 1e4).
#pragma once
#include <CLI/CLI.hpp>

namespace base {

/// For Option::check() of a floating-point option. CLI::Range takes NaN.
CLI::Validator number_from(double low, double high);

/// For Option::transform() of an integer option, signed or not, within 0..2^53 in size: rewrites 1e4 as the
/// digits that CLI11 reads.
CLI::Validator whole_number_from(double low, double high);

} // namespace base
