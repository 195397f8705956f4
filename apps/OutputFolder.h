#pragma once
#include <string>

namespace tessera::app {

/// Throws std::runtime_error when no files can be written into a folder of that name, which need not exist yet; makes
/// nothing.
void requireFolderPlace(const std::string& folder);

/// Makes the folder and those above it where they are missing. Throws std::runtime_error naming it and the remedy.
void makeFolder(const std::string& folder);

/// The name of a picture's file, without its folder, from that of a technique or a scene, which a file may give:
/// "deferred (packed)" is "deferred_packed", and no name leads out of the folder. A name that is
/// too long for a file is cut, and ends in a number that tells it from others.
std::string pictureFile(const std::string& name, const std::string& extension);

} // namespace tessera::app
