#include "scenes/Clips.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Names.h"
#include "scenes/Rest.h"

namespace tessera::scenes {
namespace {

/// By node: whether an active clip moves the node or an ancestor. Parents precede their children.
std::vector<bool> movedNodes(const Scene& scene) {
    const Rig& rig = scene.rig;
    std::vector<bool> moves(scene.nodes.size());
    for (const int playing : rig.playing)
        for (const AnimationChannel& channel : rig.clips[std::size_t(playing)].channels)
            if (infoOf(channel.property).owner == AnimatedOwner::Node)
                moves[std::size_t(rig.nodes[std::size_t(channel.target)].node)] = true;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const int parent = scene.nodes[i].parent;
        if (parent != kNone && moves[std::size_t(parent)]) moves[i] = true;
    }
    return moves;
}

} // namespace

bool isPlaying(const Scene& scene) {
    return !scene.rig.playing.empty();
}

std::vector<int> clipsCalled(const Rig& rig, const std::string& nameOrNumber) {
    std::vector<int> called;
    for (std::size_t i = 0; i < rig.clips.size(); ++i)
        if (rig.clips[i].name == nameOrNumber) called.push_back(int(i));
    if (!called.empty() || nameOrNumber == kNoClip) return called;
    std::size_t number = 0;
    const char* const end = nameOrNumber.data() + nameOrNumber.size();
    const auto [rest, error] = std::from_chars(nameOrNumber.data(), end, number);
    if (error == std::errc() && rest == end && number < rig.clips.size()) return {int(number)};
    if (rig.clips.empty())
        throw InputError(fmt::format("the scene has no clip, so none is called '{}'; leave it out", nameOrNumber));
    std::vector<std::string_view> names{kNoClip};
    for (const Clip& clip : rig.clips) names.push_back(clip.name);
    throw InputError(fmt::format("no clip of the scene is called '{}', nor is it the number of one; {}", nameOrNumber,
                                 suggestNames(nameOrNumber, names)));
}

double playingSeconds(const Rig& rig) {
    double seconds = 0.0;
    for (const int clip : rig.playing) seconds = std::max(seconds, lengthSeconds(rig.clips[std::size_t(clip)]));
    return seconds;
}

void playClip(Scene& scene, const std::string& nameOrNumber) {
    std::vector<int> called = clipsCalled(scene.rig, nameOrNumber);
    restPlayed(scene);
    scene.rig.playing = std::move(called);
}

std::string clipText(const Scene& scene) {
    const Rig& rig = scene.rig;
    if (rig.clips.empty()) return {};
    if (rig.playing.empty()) return fmt::format("no clip of {}", rig.clips.size());
    const std::string others = rig.clips.size() == 1 ? "the only one" : fmt::format("of 0 to {}", rig.clips.size() - 1);
    std::string text;
    for (const int playing : rig.playing) {
        const Clip& clip = rig.clips[std::size_t(playing)];
        const double seconds = lengthSeconds(clip);
        // "0 s" would look like a fault.
        const std::string length = clip.channels.empty() ? "which moves nothing"
                                   : seconds == 0.0      ? "a pose without duration"
                                                         : fmt::format("{:.3g} s", seconds);
        text += fmt::format("{}clip {} '{}' ({}), {}", text.empty() ? "" : "; ", playing, clip.name, others, length);
    }
    return text;
}

bool movesCamera(const Scene& scene, int camera) {
    const std::vector<bool> moves = movedNodes(scene);
    return std::ranges::any_of(scene.rig.cameras, [&](const Carried& carried) {
        return carried.element == camera && moves[std::size_t(carried.node)];
    });
}

MovingParts movingParts(const Scene& scene) {
    const Rig& rig = scene.rig;
    MovingParts parts;
    for (const int playing : rig.playing)
        for (const AnimationChannel& channel : rig.clips[std::size_t(playing)].channels) {
            const AnimatedOwner owner = infoOf(channel.property).owner;
            parts.materials = parts.materials || isOfMaterial(owner);
            parts.geometry = parts.geometry || owner == AnimatedOwner::Weights ||
                             (owner == AnimatedOwner::Node && !rig.deformed.empty()); // it may be a joint
        }
    const std::vector<bool> moves = movedNodes(scene);
    for (std::size_t i = 0; i < moves.size(); ++i)
        parts.geometry = parts.geometry || (moves[i] && !scene.nodes[i].instances.empty());
    return parts;
}

} // namespace tessera::scenes
