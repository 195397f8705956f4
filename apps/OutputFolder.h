#pragma once
#include <string>

namespace tessera::app {

/// Throws std::runtime_error when no files can be written into a folder of that name, which need not exist yet; makes
/// nothing.
void requireFolderPlace(const std::string& folder);

/// Makes the folder and those above it where they are missing. Throws std::runtime_error naming it and the remedy.
void makeFolder(const std::string& folder);

} // namespace tessera::app
