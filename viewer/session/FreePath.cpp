#include "viewer/session/FreePath.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/Utf8.h"

namespace tessera::viewer {
namespace {

constexpr int kMostNumbers = 100000;
constexpr std::size_t kLongestStem = 120; ///< file systems limit names to 255 bytes, including our additions

/// Whether a non-ASCII character is invisible or changes the direction of the text: C1 controls and U+00A0, and U+2000
/// to U+206F with spaces, line ends and direction marks.
bool isUnseen(std::string_view letter) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(letter[i]); };
    return (letter.size() == 2 && byte(0) == 0xc2 && byte(1) <= 0xa0) ||
           (letter.size() == 3 && byte(0) == 0xe2 && (byte(1) == 0x80 || byte(1) == 0x81));
}

/// Keeps visible non-ASCII characters that are valid UTF-8.
std::string plain(std::string_view stem) {
    stem = beginningOf(stem, kLongestStem);
    std::string name;
    while (!stem.empty()) {
        const std::size_t letter = letterBytes(stem), bytes = std::max<std::size_t>(letter, 1);
        const char first = stem.front();
        const bool isPlain = letter > 1
                                 ? !isUnseen(stem.substr(0, letter))
                                 : std::isalnum(static_cast<unsigned char>(first)) || first == '_' || first == '.';
        if (isPlain)
            name += stem.substr(0, bytes);
        else
            name += '-';
        stem.remove_prefix(bytes);
    }
    return name;
}

} // namespace

std::filesystem::path freePath(const std::string& stem, const std::string& ending) {
    for (int number = 1; number < kMostNumbers; ++number) {
        const std::filesystem::path path = fmt::format("tessera-{}-{:03}{}", plain(stem), number, ending);
        std::error_code error;
        if (!std::filesystem::exists(std::filesystem::symlink_status(path, error))) return path;
    }
    throw std::runtime_error(
        fmt::format("cannot write tessera-{}{}: every number is taken; empty the folder", plain(stem), ending));
}

} // namespace tessera::viewer
