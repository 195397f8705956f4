#pragma once
#include <span>
#include <string>

#include "scenes/CameraChange.h"
#include "scenes/Hook.h"
#include "scenes/ImportOptions.h"

/// Parts of a command line as text for a shell.
namespace tessera::viewer {

/// A word for a shell, quoted if necessary.
std::string shellWord(const std::string& word);

/// The change of a camera as options: " --eye 1,2,3 --target 0,1,0". Empty if nothing changes.
std::string poseText(const scenes::CameraChange& change);
/// " --background R,G,B", or empty.
std::string backgroundText(const std::optional<glm::dvec3>& radiance);

/// The values of a hook's parameters as options: " --hook wind=1.5". Empty if there are none.
std::string hookText(std::span<const scenes::HookValue> values);
/// Import settings as options: " --variant 'deep red' --strict". Empty if none is requested.
std::string importText(const scenes::ImportOptions& importOptions);

} // namespace tessera::viewer
