// Escapes text for HTML and SVG.
#pragma once
#include <string>
#include <string_view>

namespace base {

/// Replaces &, <, > and double quotes by entities, and control characters and invalid UTF-8 by U+FFFD, so
/// that a page that contains a user's file names is well-formed.
std::string escaped(std::string_view text);

} // namespace base
