// Text of unknown origin neither cuts a message nor moves the cursor of a terminal.
#include "base/text.hpp"

#include <gtest/gtest.h>

using namespace std::string_literals;

TEST(Text, Utf8IsAsRfc3629HasIt)
{
    for (const std::string& good :
         {""s, "a"s, "\0"s, "\u00e9"s, "\u20ac"s, "\U0001f600"s, "\xed\x9f\xbf"s, "\xf4\x8f\xbf\xbf"s})
        EXPECT_TRUE(base::is_utf8(good)) << base::printable(good);
    // A lone continuation, cut characters, overlong forms, a surrogate, above U+10FFFF.
    for (const std::string& bad :
         {"\x80"s, "\xff"s, "\xc3"s, "\xc3z"s, "\xe2\x82"s, "\xf0\x9f\x98"s, "\xc0\x80"s, "\xe0\x80\x80"s,
          "\xf0\x80\x80\x80"s, "\xed\xa0\x80"s, "\xf4\x90\x80\x80"s, "ok\xfe"s})
        EXPECT_FALSE(base::is_utf8(bad)) << base::printable(bad);
}

TEST(Text, PrintableIsOneLineWithoutControlCharacters)
{
    EXPECT_EQ(base::printable("caf\u00e9 \u20ac, a\\b"), "caf\u00e9 \u20ac, a\\b");
    EXPECT_EQ(base::printable("a\nb\tc\r\n"), "a b c  ");
    EXPECT_EQ(base::printable("a\0b"s), "a\\x00b");
    EXPECT_EQ(base::printable("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
    EXPECT_EQ(base::printable("\xc2\x9b"
                              "31m"),
              "\\xc2\\x9b31m"); // CSI in one character
    EXPECT_EQ(base::printable("\xff\xe2\x82"), "\\xff\\xe2\\x82");
    for (int byte = 0; byte < 256; ++byte)
        EXPECT_TRUE(base::is_utf8(base::printable(std::string(1, char(byte)))));
}
