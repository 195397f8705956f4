#pragma once
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/TempFolder.h"

namespace tessera::viewer::test {

/// A test whose working directory is an empty folder.
class InEmptyFolder : public testing::Test {
protected:
    InEmptyFolder() { std::filesystem::current_path(folder_.path()); }
    ~InEmptyFolder() override { std::filesystem::current_path(before_); }
    const tessera::test::TempFolder& folder() const { return folder_; }

private:
    std::filesystem::path before_ = std::filesystem::current_path();
    tessera::test::TempFolder folder_;
};

} // namespace tessera::viewer::test
