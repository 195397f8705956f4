#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// The whole contents of a regular file. Throws InputError, naming it, when it is missing, not a regular file or
/// unreadable. The ledger is charged for it, and records it.
std::vector<std::byte> readFileBytes(const std::filesystem::path& file, LoadLedger& ledger);

/// A file that a model names.
struct NamedFile {
    std::filesystem::path path;
    bool isFound = true;
    bool isAsNamed = true; ///< else the spelling differs: `path` is what a message should show
};

/// The regular file that `name` means in `folder`, tried in this order: as it stands, without quotes around it, with
/// '/' for '\', without a query ('?...'), in other letter case or Unicode form (NFC, NFD, Latin-1), and for absolute
/// names its last part in `folder`. The last three count as other spellings.
NamedFile fileNamed(const std::filesystem::path& folder, const std::string& name);

/// Whether two names are equal but for the case of letters and the Unicode form of their accents. A letter with
/// combining characters behind it equals any single character beyond ASCII.
bool isSameName(const std::string& a, const std::string& b);

} // namespace tessera::scenes
