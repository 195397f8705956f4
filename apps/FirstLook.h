#pragma once
#include "apps/Request.h"
#include "viewer/session/ViewerOptions.h"

namespace tessera::app {

/// Initial view of a scene in the viewer. Precedence: command-line options, the scene's options, remembered values,
/// defaults. Remembered names that no longer exist and values that the technique does not support are ignored. `source`
/// is the argument of loadScene(). Throws InputError if an option names something that the scene lacks, or the scene's
/// options are invalid.
viewer::FirstLook firstLook(const FrameOptions& said, const viewer::Preferences& remembered, const scenes::Scene& scene,
                            const std::string& source);

/// The options without those that refer to the first scene.
FrameOptions forAnyScene(FrameOptions said);

} // namespace tessera::app
