#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace tessera {

/// The text as one line that a terminal only shows: lines are joined by "; ", control characters and bytes that are
/// no UTF-8, which file names and files may bring, are written \x1b, and beyond so many bytes "..." stands for the
/// rest: one word of a file may have megabytes. Source of the C1 controls, U+0080 to U+009F: ECMA-48.
std::string oneLine(std::string_view text, std::size_t mostBytes = 2000);

} // namespace tessera
