#include "viewer/session/State.h"

namespace tessera::viewer {

void State::shareSettings() {
    if (compare == Compare::Off) activeSide = 0;
    for (Look& look : looks)
        for (const engine::Setting& setting : engine::settingTable())
            if (setting.isShared && &look != &active()) setting.value.copy(look, active());
}

void State::noteSelection() {
    if (selectedMaterial != notedMaterial_) selectedLast = Selected::Material;
    if (selectedLight != notedLight_) selectedLast = Selected::Light;
    notedLight_ = selectedLight;
    notedMaterial_ = selectedMaterial;
}

} // namespace tessera::viewer
