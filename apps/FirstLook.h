#pragma once
#include "apps/Request.h"
#include "viewer/session/ViewerOptions.h"

namespace tessera::app {

/// How the viewer looks at a scene to begin with: as the options say, else as the scene wishes, else as it is
/// remembered, else as the defaults have it. A remembered name that no longer exists is ignored, and so are values that
/// the technique does not take. `source` is what loadScene() made the scene of. Throws InputError if an option names a
/// thing that the scene lacks, or the scene's own options are invalid.
viewer::FirstLook firstLook(const FrameOptions& said, const viewer::Preferences& remembered, const scenes::Scene& scene,
                            const std::string& source);

/// What the options say that does not name things of the first scene.
FrameOptions forAnyScene(FrameOptions said);

} // namespace tessera::app
