#include "viewer/session/State.h"

namespace tessera::viewer {

void State::shareSettings() {
    if (compare == Compare::Off) activeSide = 0;
    const frame::FrameSettings& from = active().settings;
    for (Look& look : looks) {
        frame::FrameSettings& settings = look.settings;
        settings.camera = from.camera;
        settings.timeSeconds = from.timeSeconds;
        settings.soloLight = from.soloLight;
        settings.exposureEV = from.exposureEV;
        settings.toneMap = from.toneMap;
    }
}

} // namespace tessera::viewer
