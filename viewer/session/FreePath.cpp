#include "viewer/session/FreePath.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace tessera::viewer {
namespace {

constexpr int kMostNumbers = 100000;
constexpr std::size_t kLongestStem = 120; ///< file systems end names at 255 bytes, of which some are ours

std::string plain(std::string stem) {
    stem.resize(std::min(stem.size(), kLongestStem));
    for (char& c : stem)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '.') c = '-';
    return stem;
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
