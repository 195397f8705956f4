#include <gtest/gtest.h>
TEST(Build, works) {}
