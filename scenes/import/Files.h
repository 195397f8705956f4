#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// Reads a regular file, charges the ledger for it and records it there. Throws InputError naming the file if it is
/// missing, not a regular file or unreadable.
std::vector<std::byte> readFileBytes(const std::filesystem::path& file, LoadLedger& ledger);

/// A file that a model names.
struct NamedFile {
    std::filesystem::path path;
    bool isFound = true;
    bool isAsNamed = true; ///< else the spelling differs; messages should show `path`
};

/// Finds the regular file `name` in `folder`. Tries in this order: verbatim, without surrounding quotes, with '/' for
/// '\', without a query ('?...'), in other letter case or Unicode form (NFC, NFD, Latin-1), and for absolute names the
/// last component in `folder`. The last three count as other spellings.
NamedFile fileNamed(const std::filesystem::path& folder, const std::string& name);

/// Whether two names are equal except for letter case and the Unicode form of accents. A letter followed by combining
/// characters equals any single non-ASCII character.
bool isSameName(const std::string& a, const std::string& b);

} // namespace tessera::scenes
