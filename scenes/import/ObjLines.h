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
    std::string_view rest;               ///< all after the keyword, trimmed: names may hold spaces and '#'
    std::vector<std::string_view> words; ///< those of `rest` before a comment
};

/// Calls `visit` for every statement, without comment lines and empty ones; a backslash at a line's end continues it.
void forEachLine(std::string_view text, const std::function<void(const Line&)>& visit);

/// Appends the words of a text.
void addWords(std::string_view text, std::vector<std::string_view>& words);

/// A name without the comment that a '#' begins at its start or behind a blank.
std::string_view withoutComment(std::string_view name);

/// The whole word as a number; "nan" and "inf" are numbers here, so that callers can name them.
std::optional<double> parseNumber(std::string_view word);
std::optional<long long> parseInteger(std::string_view word);

/// The number, where it is finite in single precision; else the reason in `flaw`.
std::optional<double> finiteNumber(std::string_view keyword, std::string_view word, std::string& flaw);

/// A file's text as UTF-8 or in an encoding with ASCII's characters, without a byte order mark. UTF-16 is converted,
/// also without its mark. Throws InputError when the file is missing, unreadable or empty.
std::string readText(const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes::obj
