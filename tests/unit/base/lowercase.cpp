#include "base/Lowercase.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(Lowercase, countsLettersOfAsciiAlone) {
    EXPECT_EQ(inLowercase(std::string("@AZ[`az{\xc3\x84")), "@az[`az{\xc3\x84");
    EXPECT_TRUE(isSameWord("Linear", "lINEAR"));
    EXPECT_FALSE(isSameWord("linear", "linea"));
    EXPECT_TRUE(startsWithWord("DATA:x", "data:"));
    EXPECT_FALSE(startsWithWord("dat", "data"));
}

} // namespace
} // namespace tessera
