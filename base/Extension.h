#pragma once
#include <filesystem>
#include <string>

#include "base/Lowercase.h"

namespace tessera {

/// File extension with its dot, in lower case: ".png" for "a.PNG". Extensions are case-insensitive.
inline std::string extensionOf(const std::filesystem::path& file) {
    return inLowercase(file.extension().string());
}

} // namespace tessera
