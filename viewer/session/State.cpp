#include "viewer/session/State.h"

namespace tessera::viewer {

void State::shareSettings() {
    if (compare == Compare::Off) activeSide = 0;
    for (Look& look : looks)
        for (const engine::Setting& setting : engine::settingTable())
            if (setting.isShared && &look != &active()) setting.value.copy(look, active());
}

void State::viewEnvironmentBy(const scenes::EnvironmentView& view) {
    for (Look& look : looks) setEnvironmentSeenBy(look, view);
}

std::set<int> State::allSelectedLights() const {
    if (selectedLight == scenes::kNone) return {};
    return selectedLights.contains(selectedLight) ? selectedLights : std::set<int>{selectedLight};
}

bool State::isLightSelected(int index) const {
    if (selectedLight == scenes::kNone) return false;
    return index == selectedLight || (selectedLights.contains(selectedLight) && selectedLights.contains(index));
}

void State::noteSelection() {
    const auto note = [this](int selected, int noted, Selected kind) {
        if (selected == noted) return;
        selectedLast = kind;
        if (selected != scenes::kNone) reveals = kind;
    };
    note(selectedMaterial, notedMaterial_, Selected::Material);
    note(selectedLight, notedLight_, Selected::Light);
    if (!selectedLights.contains(selectedLight)) selectedLights.clear();
    notedLight_ = selectedLight;
    notedMaterial_ = selectedMaterial;
}

} // namespace tessera::viewer
