#pragma once
#include <string>
#include <vector>

/// A source is an argument of loadScene() from the user: a built-in scene's name, or a path of any form.
namespace tessera::viewer {

/// What two sources of one scene have in common: the built-in scene's name, or the file's absolute path without
/// detours. Links are not followed.
std::string identityOf(const std::string& source);

/// A scene that was opened or saved comes first among the recent files. Built-in scenes and anything that is not a file
/// are left out.
void noteRecent(std::vector<std::string>& recent, const std::string& source);

} // namespace tessera::viewer
