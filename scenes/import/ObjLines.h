#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::obj {

// Bytes that are charged for what a file's statements make.
/// A vector that doubles has room for twice its elements, and holds them three times while it grows.
inline constexpr std::size_t kRoom = 2;
inline constexpr std::size_t kGrown = 3;
/// An element of a node-based container: its links, the allocator's word and the table's slots beside it.
template <typename Element>
constexpr std::size_t kNodeBytes = sizeof(Element) + 56;
/// A part of the text that is kept, and named in a message.
constexpr std::size_t keptTextBytes(std::string_view text) {
    return kNodeBytes<std::string> + kRoom * text.size();
}

/// One statement of an OBJ or MTL file. The views hold during the call that receives them.
struct Line {
    int number = 0;                      ///< counted from 1; the first of several joined by a backslash
    std::string_view keyword;            ///< first word
    std::vector<std::string_view> words; ///< those after it
    std::string_view rest;               ///< all after the keyword, trimmed: names may hold spaces
};

/// Calls `visit` for every statement, without comments and empty lines; a backslash at a line's end continues it.
void forEachLine(std::string_view text, const std::function<void(const Line&)>& visit);

/// The whole word as a number; "nan" and "inf" are numbers here, so that callers can name them.
std::optional<double> parseNumber(std::string_view word);
std::optional<long long> parseInteger(std::string_view word);

/// The number, which must be finite in single precision. Throws InputError naming file and line otherwise.
float finiteNumber(const std::filesystem::path& file, const Line& line, std::string_view word);

/// Throws InputError "file:line: what".
[[noreturn]] void failAt(const std::filesystem::path& file, int line, const std::string& what);

/// A file's text without a byte order mark. Throws InputError when it is missing, unreadable or empty.
std::string readText(const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes::obj
