#pragma once
#include <filesystem>
#include <string>

namespace tessera::viewer {

/// A file of the present folder that is not there yet: "tessera-STEM-001ENDING", or the first number that is free.
/// Characters of the stem that file systems or shells take for something else become "-", as does what is no UTF-8.
std::filesystem::path freePath(const std::string& stem, const std::string& ending);

} // namespace tessera::viewer
