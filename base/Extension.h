#pragma once
#include <filesystem>
#include <string>

#include "base/Lowercase.h"

namespace tessera {

/// What a file's name ends in, with its dot and in small letters: ".png" for "a.PNG". Names mean the same in any case.
inline std::string extensionOf(const std::filesystem::path& file) {
    return inLowercase(file.extension().string());
}

} // namespace tessera
