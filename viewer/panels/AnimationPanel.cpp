#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include "scenes/Clips.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/Playback.h"

namespace tessera::viewer {
namespace {

/// The name of a clip as given to --clip: its name, else its number.
std::string calledBy(const scenes::Rig& rig, std::size_t clip) {
    return rig.clips[clip].name.empty() ? fmt::format("{}", clip) : rig.clips[clip].name;
}

void clipRow(State& state) {
    const scenes::Rig& rig = state.open->scene().rig;
    if (rig.clips.empty()) return;
    std::vector<std::string> names{std::string(scenes::kNoClip)};
    std::unordered_set<std::string> known(names.begin(), names.end()); // there may be thousands
    for (std::size_t i = 0; i < rig.clips.size(); ++i)
        if (std::string name = calledBy(rig, i); known.insert(name).second)
            names.push_back(std::move(name)); // clips of the same name play together
    std::vector<std::string> playing;
    for (const int clip : rig.playing) playing.push_back(calledBy(rig, std::size_t(clip)));
    const std::string shown = playing.empty() ? names.front() : fmt::format("{}", fmt::join(playing, ", "));
    const auto now =
        std::size_t(std::ranges::find(names, playing.empty() ? names.front() : playing.front()) - names.begin());
    const auto choiceAt = [&](std::size_t i) { return Choice{names[i], ""}; };
    if (const auto chosen = choose("Clip", shown, names.size(), choiceAt, now)) state.requests.clip = names[*chosen];
}

/// The time slider of a clip ends with it; without a clip the time is unbounded.
void timeRow(State& state) {
    const double clipSeconds = state.open->clipSeconds();
    const bool isBounded = clipSeconds > 0.0;
    const double least = isBounded ? 0.0 : -kMostSeconds, most = isBounded ? clipSeconds : kMostSeconds;
    row("Time");
    constexpr const char* kSeconds = "%.2f s";
    editShown(state.active().settings.timeSeconds, least, most, kSeconds, [&](double& seconds) {
        return isBounded
                   ? slideNumber("##Time", seconds, least, most, kSeconds)
                   : ImGui::DragScalar("##Time", ImGuiDataType_Double, &seconds, 0.02f, nullptr, nullptr, kSeconds);
    });
}

} // namespace

void animationPanel(State& state) {
    if (!state.open) return;
    clipRow(state);
    if (canMove(state)) {
        if (ImGui::Button(state.isPlaying ? "Pause (Space)" : "Play (Space)")) togglePlaying(state);
        tip("Lets time go on, or stops it");
        if (state.open->clipSeconds() > 0.0) {
            ImGui::SameLine();
            ImGui::Checkbox("repeat", &state.repeatsClip);
            tip("From the beginning again at the end of the clip, with all else that moves");
        }
    } else {
        const char* const clip =
            state.open->scene().rig.playing.empty() ? "no clip plays" : "the clip is a pose without duration";
        paragraph(
            fmt::format("Nothing moves: {}, no light moves or flickers by itself, and the scene has no hook.", clip));
        return;
    }
    if (state.open->clipMovesCamera()) {
        bool follows = state.open->followsClipCamera();
        if (ImGui::Checkbox("Follow the clip's camera", &follows)) state.open->followClipCamera(follows);
        tip("A camera that you move stays where you move it");
    }
    timeRow(state);
    logarithmicSlider("Speed", state.speed, kSlowest, kFastest, "%.2fx");
}

} // namespace tessera::viewer
