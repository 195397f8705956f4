#include "base/OneLine.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(OneLine, anErrorIsOneLineThatNoTerminalObeys) {
    EXPECT_EQ(oneLine("a.png: broken"), "a.png: broken");
    EXPECT_EQ(oneLine("log:\n\nline 1\r\nline 2\n"), "log:; line 1; line 2");
    EXPECT_EQ(oneLine("a\x1b[2Jb\tc\x7f"), "a\\x1b[2Jb\\x09c\\x7f");
    EXPECT_EQ(oneLine("a\xc2\x9b"
                      "2J"),
              "a\\x9b2J");                          // U+009B begins an escape sequence
    EXPECT_EQ(oneLine("f\xc3\xbcr"), "f\xc3\xbcr"); // other letters stay
    EXPECT_EQ(oneLine("a\x9b"
                      "31m\xff\xc3"),
              "a\\x9b31m\\xff\\xc3")
        << "bytes that are no UTF-8";
}

TEST(OneLine, aLineIsNotLongerThanTwoThousandBytesAndDotsAndEndsWithAWholeLetter) {
    EXPECT_EQ(oneLine(std::string(2000, 'a')), std::string(2000, 'a'));
    EXPECT_EQ(oneLine(std::string(2001, 'a')), std::string(2000, 'a') + "...");
    EXPECT_EQ(oneLine(std::string(1999, 'a') + "\xc3\xbcr"), std::string(1999, 'a') + "...");
    EXPECT_EQ(oneLine(std::string(1'000'000, '\x80')).size(), 2003u) << "no UTF-8";
}

} // namespace
} // namespace tessera
