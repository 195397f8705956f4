#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/Error.h"

namespace tessera::scenes::test {

/// A folder of the running test's own, removed with it.
class TempFolder {
public:
    TempFolder() {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) /
                (std::string("tessera_") + info->test_suite_name() + "_" + info->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view text) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }

    /// A TGA picture of `texels` RGBA texels, rows from the top.
    std::filesystem::path writePicture(const std::string& name, int width, int height,
                                       const std::vector<std::array<std::uint8_t, 4>>& texels) const {
        std::string bytes(18, '\0');
        bytes[2] = 2; // uncompressed true colour
        bytes[12] = static_cast<char>(width);
        bytes[14] = static_cast<char>(height);
        bytes[16] = 32;   // bits a texel
        bytes[17] = 0x28; // 8 bits of alpha, first row on top
        for (const auto& [r, g, b, a] : texels)
            for (const std::uint8_t value : {b, g, r, a}) bytes += static_cast<char>(value);
        return write(name, bytes);
    }

private:
    std::filesystem::path path_;
};

/// The text of the InputError that `action` must throw.
inline std::string inputErrorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError was thrown";
    return {};
}

} // namespace tessera::scenes::test
