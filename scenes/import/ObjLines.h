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

// Bytes charged for the results of a file's statements.
/// A doubling vector has capacity for twice its elements, and holds them three times while it grows.
inline constexpr std::size_t kRoom = 2;
inline constexpr std::size_t kGrown = 3;
/// An element of a node-based container, with its links, the allocator's header and the table's slots.
template <typename Element>
constexpr std::size_t kNodeBytes = sizeof(Element) + 56;
/// A part of the text that is kept and named in a message.
constexpr std::size_t keptTextBytes(std::string_view text) {
    return kNodeBytes<std::string> + kRoom * text.size();
}

/// One statement of an OBJ or MTL file. The views are valid only during the call that receives them.
struct Line {
    int number = 0;                      ///< counted from 1; the first of several joined by a backslash
    std::string_view keyword;            ///< first word
    std::string_view rest;               ///< all after the keyword, trimmed: names may hold spaces and '#'
    std::vector<std::string_view> words; ///< words of `rest` before a comment
};

/// Calls `visit` for every statement, without comment lines and empty ones; a backslash at a line's end continues it.
void forEachLine(std::string_view text, const std::function<void(const Line&)>& visit);

/// Appends the words of a text.
void addWords(std::string_view text, std::vector<std::string_view>& words);

/// A name without its comment, which a '#' begins at the start or after a blank.
std::string_view withoutComment(std::string_view name);

/// Parses the whole word as a number; accepts "nan" and "inf", so that callers can report them.
std::optional<double> parseNumber(std::string_view word);
std::optional<long long> parseInteger(std::string_view word);

/// Parses a number that is finite in single precision; else sets `flaw` to the reason.
std::optional<double> finiteNumber(std::string_view keyword, std::string_view word, std::string& flaw);

/// Reads a text file without its byte order mark, in UTF-8 or another superset of ASCII. UTF-16 is converted, also
/// without its mark. Throws InputError if the file is missing, unreadable or empty.
std::string readText(const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes::obj
