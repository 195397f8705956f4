#pragma once
#include <string_view>

#include <gtest/gtest.h>

namespace tessera::test {

/// Whether the running test goes through every case of its sweep: in suites whose names end in Slow, which only
/// ./test --all runs. Elsewhere a part that holds every value of every axis is enough.
inline bool isWholeSweep() {
    return std::string_view(testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()).ends_with("Slow");
}

} // namespace tessera::test
