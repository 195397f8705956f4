#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "tests/support/TempFolder.h"

namespace tessera::scenes::test {

using testing::AllOf, testing::ElementsAre, testing::HasSubstr, testing::IsEmpty, testing::StartsWith;

/// A temporary folder that can also hold images.
class TempFolder : public tessera::test::TempFolder {
public:
    TempFolder() {} // clang makes no constant by an implicit constructor
    /// Writes a TGA image of `texels` RGBA texels, rows from the top.
    std::filesystem::path writePicture(const std::string& name, int width, int height,
                                       const std::vector<std::array<std::uint8_t, 4>>& texels) const {
        std::string bytes(18, '\0');
        bytes[2] = 2; // uncompressed true colour
        bytes[12] = char(width);
        bytes[14] = char(height);
        bytes[16] = 32;   // bits per texel
        bytes[17] = 0x28; // 8 bits of alpha, first row on top
        for (const auto& [r, g, b, a] : texels)
            for (const std::uint8_t value : {b, g, r, a}) bytes += char(value);
        return write(name, bytes);
    }
};

/// Returns the text of the InputError that `action` must throw.
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
