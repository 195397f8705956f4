#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

namespace tessera::scenes {

/// The whole contents of a regular file. Throws InputError, naming it, when it is missing, not a regular file or
/// unreadable.
std::vector<std::byte> readFileBytes(const std::filesystem::path& file);

} // namespace tessera::scenes
