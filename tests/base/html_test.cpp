// Escaping of text for HTML and SVG.
#include "base/html.hpp"

#include <gtest/gtest.h>

namespace {

using base::escaped;

TEST(Html, MarkupIsEscaped)
{
    EXPECT_EQ(escaped("a < b && c > \"d\""), "a &lt; b &amp;&amp; c &gt; &quot;d&quot;");
    EXPECT_EQ(escaped(""), "");
}

TEST(Html, Utf8StaysAsItIs)
{
    const std::string text = "\xc2\xb5m, \xe2\x89\xa4 1, \xf0\x9f\x99\x82\n\t";
    EXPECT_EQ(escaped(text), text);
}

TEST(Html, CharactersThatXmlForbidsAreReplaced)
{
    const std::string bad = "\xef\xbf\xbd"; // U+FFFD
    EXPECT_EQ(escaped("a\x01z"), "a" + bad + "z");
    EXPECT_EQ(escaped("caf\xe9."), "caf" + bad + ".") << "Latin-1";
    EXPECT_EQ(escaped("\xc0\xaf"), bad + bad) << "overlong";
    EXPECT_EQ(escaped("\xed\xa0\x80"), bad + bad + bad) << "a surrogate";
    EXPECT_EQ(escaped("\xf4\x90\x80\x80"), bad + bad + bad + bad) << "beyond U+10FFFF";
    EXPECT_EQ(escaped("\xe2\x89"), bad + bad) << "cut off";
    EXPECT_EQ(escaped(std::string_view("\0", 1)), bad);
}

} // namespace
