// Validators of numbers on the command line: finite, in a range, in any notation (10000, 1e4).
#pragma once
#include <CLI/CLI.hpp>

namespace base {

/// For Option::check() of a floating-point option. Unlike CLI::Range it rejects NaN.
CLI::Validator number_from(double low, double high);

/// For Option::transform() of a signed or unsigned integer option of magnitude up to 2^53: rewrites 1e4 as
/// the digits that CLI11 reads.
CLI::Validator whole_number_from(double low, double high);

} // namespace base
