#pragma once
#include "apps/Options.h"
#include "viewer/session/ViewerOptions.h"

namespace tessera::app {

/// How the viewer looks at a scene to begin with: as the options say, else as the scene wishes, else as it is
/// remembered, else as the defaults have it. A remembered name that there is no more counts for nothing, and what the
/// technique cannot do is put aside. `source` is what loadScene() made the scene of. Throws InputError where the scene
/// lacks what was said, and where it wishes for what there is not.
viewer::FirstLook firstLook(const FrameOptions& said, const viewer::Preferences& remembered, const scenes::Scene& scene,
                            const std::string& source);

/// What the options say that does not name things of the first scene.
FrameOptions forAnyScene(FrameOptions said);

} // namespace tessera::app
