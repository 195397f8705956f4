#pragma once
#include <string>

namespace tessera::app {

/// Throws std::runtime_error if files cannot be written into the folder, which need not exist yet. Creates nothing.
void requireFolderPlace(const std::string& folder);

/// Creates the folder and its missing parents. Throws std::runtime_error naming the folder and the remedy.
void makeFolder(const std::string& folder);

/// File name of an image, without its folder, from the name of a technique or scene: "deferred (packed)" becomes
/// "deferred_packed". Scene names come from files, so path separators are replaced. A long name is truncated and ends
/// in a hash.
std::string pictureFile(const std::string& name, const std::string& extension);

} // namespace tessera::app
