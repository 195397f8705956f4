#pragma once
#include <filesystem>
#include <string>

namespace tessera::viewer {

/// A file in the current folder that does not exist yet: "tessera-STEM-001ENDING", or the first free number. Characters
/// with a special meaning for file systems or shells become "-", as does invalid UTF-8.
std::filesystem::path freePath(const std::string& stem, const std::string& ending);

} // namespace tessera::viewer
