#include "viewer/session/State.h"

namespace tessera::viewer {

void Magnification::zoom(int steps, const glm::vec2& share) {
    const glm::vec2 place = placeAt(share);
    for (; steps > 0 && times < kMost; --steps) times *= 2;
    for (; steps < 0 && times > 1; ++steps) times /= 2;
    corner = place - share / float(times);
    pan(glm::vec2(0.0f));
}

void Magnification::pan(const glm::vec2& share) {
    corner = glm::clamp(corner - share / float(times), 0.0f, 1.0f - 1.0f / float(times));
}

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
