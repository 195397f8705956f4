#include "base/Utf8.h"

#include <gtest/gtest.h>

#include "base/OneLine.h"

namespace tessera {
namespace {

TEST(Utf8, aLetterIsOneThatUnicodeHas) {
    EXPECT_EQ(letterBytes(""), 0u);
    for (const std::string_view letter :
         {"a", "\xc2\x80", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
        EXPECT_EQ(letterBytes(letter), letter.size()) << letter;
        EXPECT_EQ(letterBytes(letter.substr(0, letter.size() - 1)), 0u) << letter;
    }
    // Two overlong forms of U+009B, a surrogate, and a code point beyond U+10FFFF.
    for (const std::string_view none : {"\xe0\x82\x9b", "\xf0\x80\x82\x9b", "\xed\xa0\x80", "\xf4\x90\x80\x80"})
        EXPECT_EQ(letterBytes(none), 0u) << oneLine(none);
    EXPECT_EQ(oneLine("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
}

} // namespace
} // namespace tessera
