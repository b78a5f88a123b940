// Text of unknown origin: names of files, cells of tables, values of fields.
#pragma once
#include <string>
#include <string_view>

namespace base {

/// Whether `text` is well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, up to U+10FFFF).
bool is_utf8(std::string_view text);

/// `text` on one line, as a terminal may show it: line ends and tabs become blanks; other control characters
/// (among them NUL and the escapes that move the cursor) and bytes that are not UTF-8 become \xNN.
std::string printable(std::string_view text);

} // namespace base
