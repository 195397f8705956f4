#pragma once
#include <filesystem>
#include <string>

namespace tessera {

/// What a file's name ends in, with its dot and in small letters: ".png" for "a.PNG". Names mean the same in any case.
inline std::string extensionOf(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

} // namespace tessera
