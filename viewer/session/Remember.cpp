#include "viewer/session/Remember.h"

#include <algorithm>

namespace tessera::viewer {
namespace {

/// `now` by name where it differs from `base` or was remembered.
template <typename Value, typename Name>
void keep(std::optional<Value>& remembered, bool differs, const Name& name) {
    if (differs || remembered) remembered = name();
}

} // namespace

void remember(Preferences& preferences, const State& state, const Look& base) {
    const Look& look = state.looks[0];
    const frame::FrameSettings& now = look.settings;
    const frame::FrameSettings& before = base.settings;
    keep(preferences.technique, look.technique != base.technique,
         [&] { return std::string(infoOf(look.technique).name); });
    keep(preferences.toneMap, now.toneMap != before.toneMap,
         [&] { return std::string(frame::toneMapTable()[std::size_t(now.toneMap)].name); });
    keep(preferences.samples, now.samples != before.samples, [&] { return now.samples; });
    const auto table = frame::layoutTable();
    const auto layout = std::find_if(table.begin(), table.end(),
                                     [&](const frame::LayoutInfo& info) { return info.layout == now.layout; });
    if (layout != table.end())
        keep(preferences.layout, now.layout != before.layout, [&] { return std::string(layout->name); });
    // What the technique does by itself needs no remembering.
    preferences.culling.reset();
    if (now.culling.method) preferences.culling = std::string(infoOf(*now.culling.method).name);
    preferences.tile = now.culling.tilePixels;
    preferences.automaticScale = state.automaticScale;
    preferences.showsPanel = state.showsPanel;
    preferences.showsMarkers = state.showsMarkers;
    preferences.recent = state.recent;
}

} // namespace tessera::viewer
