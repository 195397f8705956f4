#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// The whole contents of a regular file. Throws InputError, naming it, when it is missing, not a regular file or
/// unreadable. The ledger is charged for it, and records it.
std::vector<std::byte> readFileBytes(const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes
