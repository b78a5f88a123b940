// The exception for errors of the user's files or machine.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace base {

/// what() is one line: "WHERE: PROBLEM; CURE". WHERE names the file and, if there is one, the field
/// ("scene.json: /wounds/0/width_mm"). what() is printable(), the parts are as given.
class InputError : public std::runtime_error
{
  public:
    InputError(std::string_view where, std::string_view problem, std::string_view cure);

    const std::string& where() const { return where_; }
    const std::string& problem() const { return problem_; }
    const std::string& cure() const { return cure_; }

  private:
    std::string where_, problem_, cure_;
};

/// A number in its shortest notation, for messages: 0.5, 4294967295, 1e10.
std::string plain(double number);

} // namespace base
