// Text inside HTML and SVG.
#pragma once
#include <string>
#include <string_view>

namespace base {

/// &, <, > and quotes as entities; what XML does not allow (control characters, bytes that are no UTF-8)
/// becomes U+FFFD, so that a page with a user's file names in it is still well-formed.
std::string escaped(std::string_view text);

} // namespace base
