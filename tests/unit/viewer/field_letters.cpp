#include "viewer/session/FieldLetters.h"

#include <gtest/gtest.h>

#include "base/Utf8.h"

namespace tessera::viewer {
namespace {

TEST(FieldLetters, whatAFieldCanHoldStaysAsItIs) {
    FieldLetters letters;
    for (const char* text : {"", "lamp 3.json", "~/B\xc3\xa4r/\xe5\xae\xb6.glb"}) {
        EXPECT_EQ(letters.inField(text), text);
        EXPECT_EQ(letters.fromField(text), text);
    }
}

TEST(FieldLetters, allOtherLettersAndBytesComeBack) {
    FieldLetters letters;
    const std::string text = "a\n\x01\x7f \xf0\x9f\x98\x80\xf0\x9f\x98\x81\xf0\x9f\x98\x80 \xff\xc3 \xee\x80\x80 b";
    const std::string held = letters.inField(text);
    for (std::string_view rest = held; !rest.empty(); rest.remove_prefix(letterBytes(rest))) {
        ASSERT_GT(letterBytes(rest), 0u);
        ASSERT_LT(letterBytes(rest), 4u);
        EXPECT_GE(static_cast<unsigned char>(rest[0]), 0x20);
        EXPECT_NE(rest[0], '\x7f');
    }
    EXPECT_EQ(letters.fromField(held), text);
    EXPECT_EQ(letters.fromField(held.substr(0, held.size() - 1) + "c"), text.substr(0, text.size() - 1) + "c")
        << "also of a text that was edited since";
    EXPECT_EQ(letters.inField(text), held) << "the same letter is the same again";
}

} // namespace
} // namespace tessera::viewer
