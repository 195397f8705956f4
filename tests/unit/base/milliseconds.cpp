#include "base/Milliseconds.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(Milliseconds, haveThreeDigitsOrAreWholeAndNeverAPowerOfTen) {
    EXPECT_EQ(millisecondsText(0.0), "0");
    EXPECT_EQ(millisecondsText(1e-5), "0");
    EXPECT_EQ(millisecondsText(0.0001234), "0.000123");
    EXPECT_EQ(millisecondsText(0.01234), "0.0123");
    EXPECT_EQ(millisecondsText(12.345), "12.3");
    EXPECT_EQ(millisecondsText(999.4), "999");
    EXPECT_EQ(millisecondsText(999.6), "1000");
    EXPECT_EQ(millisecondsText(6750.4), "6750");
    EXPECT_EQ(millisecondsText(1234567.0), "1234567");
}

} // namespace
} // namespace tessera
