#include "viewer/session/Remember.h"

namespace tessera::viewer {

void recall(const Preferences& preferences, State& state) {
    state.recent = preferences.recent;
    state.automaticScale = preferences.automaticScale;
    state.fixedScale = preferences.fixedScale;
    state.smooths = preferences.smooths;
    state.showsPanel = preferences.showsPanel;
    state.panelWidth = preferences.panelWidth;
    state.sections = preferences.sections;
    state.showsMarkers = preferences.showsMarkers;
}

void rememberLook(Preferences& preferences, const Look& look, const Look& begun) {
    const Look now = requested(look), before = requested(begun);
    for (const engine::Setting& setting : engine::settingTable()) {
        if (!setting.isRemembered || setting.value.equal(now, before)) continue;
        const std::string key(setting.key), text = setting.text(now);
        // Unset values are not saved, and values without a command-line name cannot be saved.
        if (text.empty() || text == setting.value.open)
            preferences.settings.erase(key);
        else
            preferences.settings.insert_or_assign(key, text);
    }
}

void remember(Preferences& preferences, const State& state, const Look& begun, glm::ivec2 windowSize) {
    rememberLook(preferences, state.looks[0], begun);
    if (windowSize != state.firstWindowSize) preferences.windowSize = windowSize;
    // Neither the command line nor scenes set these, so they began with their saved values.
    preferences.recent = state.recent;
    preferences.automaticScale = state.automaticScale;
    preferences.fixedScale = state.fixedScale;
    preferences.smooths = state.smooths;
    preferences.showsPanel = state.showsPanel;
    preferences.panelWidth = state.panelWidth;
    preferences.sections = state.sections;
    preferences.showsMarkers = state.showsMarkers;
}

} // namespace tessera::viewer
