#pragma once
#include <string>
#include <vector>

/// A source is an argument of loadScene() from the user: a built-in scene's name, or a path of any form.
namespace tessera::viewer {

/// The canonical form of a source: the built-in scene's name, or the file's absolute, normalised path. Links are not
/// followed.
std::string identityOf(const std::string& source);

/// Moves a scene that was opened or saved to the front of the recent files. Built-in scenes and anything that is not a
/// file are ignored.
void noteRecent(std::vector<std::string>& recent, const std::string& source);

} // namespace tessera::viewer
