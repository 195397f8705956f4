#include "engine/ChooseView.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"

namespace tessera::engine {

bool supportsView(const TechniqueInfo& info, frame::DebugView view) {
    return info.usesGBuffer() || !frame::debugViewInfo(view).needsGBuffer;
}

bool storesShown(const frame::FrameSpec& spec) {
    const std::optional<frame::StoredComponents> shown = frame::storedComponents(spec.settings.view);
    return !shown || std::find(spec.channels.begin(), spec.channels.end(), shown->channel) != spec.channels.end();
}

void requireStoredChannel(const frame::FrameSpec& spec) {
    if (storesShown(spec)) return;
    const frame::DebugView view = spec.settings.view;
    const std::optional<frame::StoredComponents> shown = frame::storedComponents(view);
    std::vector<std::string_view> stored;
    for (const frame::Channel channel : spec.channels)
        stored.push_back(frame::channelTable()[std::size_t(channel)].name);
    throw InputError(fmt::format("view {}: this frame's G-buffer has no such channel, which is for {}; it has {}",
                                 frame::debugViewInfo(view).name,
                                 frame::channelTable()[std::size_t(shown->channel)].needed,
                                 stored.empty() ? "none" : fmt::format("{}", fmt::join(stored, ", "))));
}

} // namespace tessera::engine
