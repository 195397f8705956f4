#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace tessera {

/// The text as one line without terminal control codes. Lines are joined by "; ". Control characters and invalid UTF-8
/// from files and file names are written as \x1b. "..." replaces the text beyond `mostBytes`, since one word of a file
/// may have megabytes. Source of the C1 controls, U+0080 to U+009F: ECMA-48.
std::string oneLine(std::string_view text, std::size_t mostBytes = 2000);

} // namespace tessera
