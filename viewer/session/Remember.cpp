#include "viewer/session/Remember.h"

#include <algorithm>

namespace tessera::viewer {
namespace {

/// `now` as `stored` has it, where it is something else than what the window began with.
template <typename Stored, typename Value, typename StoredAs>
void keep(Stored& stored, const Value& now, const Value& begun, const StoredAs& storedAs) {
    if (now != begun) stored = storedAs(now);
}

std::optional<std::string> nameOf(const std::optional<culling::Method>& method) {
    if (!method) return std::nullopt;
    return std::string(infoOf(*method).name);
}

std::string nameOf(recipes::Technique technique) {
    return std::string(infoOf(technique).name);
}

std::string nameOf(frame::ToneMap toneMap) {
    return std::string(frame::toneMapTable()[std::size_t(toneMap)].name);
}

/// None for one that the command line has no name for.
std::optional<std::string> nameOf(const frame::GBufferLayout& layout) {
    const auto table = frame::layoutTable();
    const auto found = std::ranges::find(table, layout, &frame::LayoutInfo::layout);
    if (found == table.end()) return std::nullopt;
    return std::string(found->name);
}

} // namespace

void recall(const Preferences& preferences, State& state) {
    state.recent = preferences.recent;
    state.automaticScale = preferences.automaticScale;
    state.fixedScale = preferences.fixedScale;
    state.showsPanel = preferences.showsPanel;
    state.showsMarkers = preferences.showsMarkers;
}

void rememberLook(Preferences& preferences, const Look& look, const Look& begun) {
    const Look now = asked(look), before = asked(begun);
    const frame::FrameSettings& settings = now.settings;
    const frame::FrameSettings& first = before.settings;
    const auto named = [](const auto& value) { return nameOf(value); };
    const auto asIs = [](const auto& value) { return value; };
    keep(preferences.technique, now.technique, before.technique, named);
    keep(preferences.layout, settings.layout, first.layout, named);
    keep(preferences.toneMap, settings.toneMap, first.toneMap, named);
    keep(preferences.culling, settings.culling.method, first.culling.method, named);
    keep(preferences.tile, settings.culling.tilePixels, first.culling.tilePixels, asIs);
    keep(preferences.samples, settings.samples, first.samples, asIs);
}

void remember(Preferences& preferences, const State& state, const Look& begun, glm::ivec2 windowSize) {
    rememberLook(preferences, state.looks[0], begun);
    if (windowSize != state.firstWindowSize) preferences.windowSize = windowSize;
    // No command line and no scene says these: they began as what was remembered.
    preferences.recent = state.recent;
    preferences.automaticScale = state.automaticScale;
    preferences.fixedScale = state.fixedScale;
    preferences.showsPanel = state.showsPanel;
    preferences.showsMarkers = state.showsMarkers;
}

} // namespace tessera::viewer
