#include "viewer/session/Playback.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace tessera::viewer {
namespace {

constexpr std::string_view kTimeKey = "time"; ///< key of its setting (engine::settingTable())

/// Whether anything other than a clip moves.
bool movesByItself(const OpenScene& open) {
    return open.scene().hook || std::ranges::any_of(open.scene().lights, scenes::movesByItself);
}

} // namespace

bool canMove(const State& state) {
    return state.open && (state.open->clipSeconds() > 0.0 || movesByItself(*state.open));
}

bool plays(const State& state) {
    if (!state.isPlaying || !canMove(state)) return false;
    return state.repeatsClip || movesByItself(*state.open) ||
           state.active().settings.timeSeconds < state.open->clipSeconds();
}

bool isMoving(const State& state) {
    return state.open && (!state.open->rig().isAtRest() || plays(state));
}

void togglePlaying(State& state) {
    state.isPlaying = !state.isPlaying;
    if (state.isPlaying && canMove(state) && !plays(state)) state.active().settings.timeSeconds = 0.0;
}

void passTime(State& state, double clockSeconds) {
    if (!plays(state)) return;
    double& timeSeconds = state.active().settings.timeSeconds;
    timeSeconds += clockSeconds * double(state.speed);
    const double clipSeconds = state.open->clipSeconds();
    if (!(clipSeconds > 0.0) || timeSeconds < clipSeconds) return;
    if (state.repeatsClip) {
        timeSeconds = std::fmod(timeSeconds, clipSeconds);
    } else if (!movesByItself(*state.open)) {
        timeSeconds = clipSeconds;
        state.isPlaying = false;
    }
}

scenes::SceneOptions optionsToSave(const State& state) {
    scenes::SceneOptions options = state.open->scene().options;
    if (!canMove(state)) return options;
    if (const double timeSeconds = state.active().settings.timeSeconds; timeSeconds == 0.0)
        options.requested.erase(std::string(kTimeKey));
    else
        options.requested.insert_or_assign(std::string(kTimeKey), timeSeconds);
    return options;
}

void chooseClip(State& state, const std::string& nameOrNumber) {
    state.open->playClip(nameOrNumber);
    state.active().settings.timeSeconds = 0.0;
}

} // namespace tessera::viewer
