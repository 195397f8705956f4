#include "viewer/edit/LightLife.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "scenes/Direction.h"
#include "viewer/edit/Bounded.h"
#include "viewer/edit/LightList.h"

namespace tessera::viewer {
namespace {

using scenes::Light;
using scenes::LightAnimation;
using scenes::LightAnimationKind;
using scenes::LightKeyed;
using scenes::LightKeys;

/// The keyframes of a member of a light, const if the light is.
auto* keysIn(auto& light, LightKeyed member) {
    using Keys =
        std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(light)>>, const LightKeys, LightKeys>;
    Keys* keys = nullptr;
    if (member == LightKeyed::Position) {
        if (light.animation && light.animation->kind == LightAnimationKind::Keyframes) keys = &light.animation->keys;
        return keys;
    }
    for (Keys& one : light.keyframes)
        if (one.of == member) keys = &one;
    return keys;
}

/// A member of a light; a number is in x.
glm::dvec3 memberOf(const Light& light, LightKeyed member) {
    return std::visit(
        [&](auto at) {
            const auto& own = light.*at;
            if constexpr (std::is_same_v<std::decay_t<decltype(own)>, float>)
                return glm::dvec3(own, 0.0, 0.0);
            else
                return glm::dvec3(own);
        },
        scenes::infoOf(member).at);
}

/// The member that the light has at a time without its flicker, which multiplies the keyed value.
glm::dvec3 shownMember(Light light, LightKeyed member, double timeSeconds) {
    light.flicker.reset();
    return memberOf(scenes::lightAtTime(light, timeSeconds), member);
}

/// Slope from the previous key to the next, per second; one-sided at the ends.
glm::dvec3 slopeAt(const LightKeys& keys, std::size_t key) {
    const std::size_t before = key > 0 ? key - 1 : key, after = std::min(key + 1, keys.values.size() - 1);
    if (before == after) return glm::dvec3(0.0);
    return (keys.values[after] - keys.values[before]) / (keys.timesSeconds[after] - keys.timesSeconds[before]);
}

bool isSpline(const LightKeys& keys) {
    return keys.interpolation == scenes::Interpolation::CubicSpline;
}

/// The phase of a movement that begins at a time.
double phaseOfBegin(double timeSeconds, double periodSeconds) {
    const double turns = timeSeconds / periodSeconds;
    return std::ceil(turns) - turns;
}

LightKeys keysOfPath(const LightAnimation& path) {
    LightKeys keys;
    keys.values = path.pointsWS;
    if (!path.isOpen) keys.values.push_back(path.pointsWS.front());
    keys.repeat = path.isOpen ? scenes::KeyRepeat::PingPong : scenes::KeyRepeat::Loop;
    const double seconds = (path.isOpen ? 0.5 : 1.0) * path.periodSeconds; // there and back
    for (std::size_t i = 0; i < keys.values.size(); ++i)
        keys.timesSeconds.push_back(seconds * double(i) / double(keys.values.size() - 1));
    return keys;
}

/// The positions of keys as a path of the same duration, closed if the last one repeats the first.
LightAnimation pathOfKeys(const LightKeys& keys) {
    LightAnimation path;
    path.kind = LightAnimationKind::Path;
    const double seconds = keys.timesSeconds.back() - keys.timesSeconds.front();
    path.pointsWS = keys.values;
    const bool comesBack = path.pointsWS.size() > 2 && path.pointsWS.front() == path.pointsWS.back();
    if (comesBack) path.pointsWS.pop_back();
    path.isOpen = !comesBack;
    path.periodSeconds = std::max((path.isOpen ? 2.0 : 1.0) * seconds, kLeastPeriodSeconds);
    return path;
}

} // namespace

// ---- Keyframes -----------------------------------------------------------------------------------------------------

const LightKeys* keysOf(const Light& light, LightKeyed member) {
    return keysIn(light, member);
}

std::size_t addKey(Light& light, LightKeyed member, double timeSeconds) {
    timeSeconds = std::clamp(timeSeconds, -kMostSeconds, kMostSeconds);
    const glm::dvec3 shown = shownMember(light, member, timeSeconds);
    LightKeys* keys = keysIn(light, member);
    if (keys == nullptr) {
        if (member == LightKeyed::Position) {
            light.animation.emplace().kind = LightAnimationKind::Keyframes;
        } else {
            // In the order of files: that of keyedMembers().
            const auto place = std::ranges::upper_bound(light.keyframes, member, {}, &LightKeys::of);
            light.keyframes.insert(place, LightKeys())->of = member;
            if (member == LightKeyed::Direction && light.animation) light.animation->looksAhead = false;
        }
        keys = keysIn(light, member);
    }
    std::vector<double>& times = keys->timesSeconds;
    const auto next = std::ranges::lower_bound(times, timeSeconds);
    const auto key = std::size_t(next - times.begin());
    if (next != times.end() && *next - timeSeconds < kLeastKeyGapSeconds) return key;
    if (key > 0 && timeSeconds - times[key - 1] < kLeastKeyGapSeconds) return key - 1;
    times.insert(next, timeSeconds);
    keys->values.insert(keys->values.begin() + std::ptrdiff_t(key), shown);
    if (isSpline(*keys))
        for (std::vector<glm::dvec3>* tangents : {&keys->inTangents, &keys->outTangents})
            tangents->insert(tangents->begin() + std::ptrdiff_t(key), slopeAt(*keys, key));
    return key;
}

void removeKey(Light& light, LightKeyed member, std::size_t key) {
    LightKeys& keys = *keysIn(light, member);
    assert(key < keys.timesSeconds.size());
    if (keys.timesSeconds.size() == 1) {
        const glm::dvec3 last = keys.values.front();
        if (member == LightKeyed::Position)
            light.animation.reset();
        else
            std::erase_if(light.keyframes, [&](const LightKeys& one) { return one.of == member; });
        if (member == LightKeyed::Direction) return turnLight(light, last); // also turns alongWS
        return scenes::setKeyed(light, member, last);
    }
    const auto eraseFrom = [key](auto& list) { list.erase(list.begin() + std::ptrdiff_t(key)); };
    eraseFrom(keys.timesSeconds);
    eraseFrom(keys.values);
    if (!isSpline(keys)) return;
    eraseFrom(keys.inTangents);
    eraseFrom(keys.outTangents);
}

void moveKey(Light& light, LightKeyed member, std::size_t key, double timeSeconds) {
    std::vector<double>& times = keysIn(light, member)->timesSeconds;
    assert(key < times.size());
    const double least = key > 0 ? times[key - 1] + kLeastKeyGapSeconds : -kMostSeconds;
    const double most = key + 1 < times.size() ? times[key + 1] - kLeastKeyGapSeconds : kMostSeconds;
    if (least <= most) times[key] = std::clamp(timeSeconds, least, most);
}

void setKey(Light& light, LightKeyed member, std::size_t key, const glm::dvec3& value) {
    LightKeys& keys = *keysIn(light, member);
    assert(key < keys.values.size());
    const scenes::LightKeyedInfo& info = scenes::infoOf(member);
    if (!info.isOnSphere)
        keys.values[key] = info.width() == 1 ? glm::dvec3(value.x, 0.0, 0.0) : value;
    else if (const std::optional<glm::dvec3> direction = scenes::directionOf(value))
        keys.values[key] = *direction;
}

void setInterpolation(Light& light, LightKeyed member, scenes::Interpolation interpolation) {
    LightKeys& keys = *keysIn(light, member);
    keys.interpolation = interpolation;
    keys.inTangents.clear();
    if (isSpline(keys))
        for (std::size_t key = 0; key < keys.values.size(); ++key) keys.inTangents.push_back(slopeAt(keys, key));
    keys.outTangents = keys.inTangents;
}

void setRepeat(Light& light, LightKeyed member, scenes::KeyRepeat repeat) {
    keysIn(light, member)->repeat = repeat;
}

// ---- Paths ---------------------------------------------------------------------------------------------------------

void chooseWay(Light& light, LightAnimationKind kind, double timeSeconds, double sizeMetres) {
    assert(scenes::infoOf(light.type).hasPosition() && sizeMetres > 0.0);
    constexpr double kFirstPeriodSeconds = 6.0;
    const std::optional<LightAnimation> before = std::exchange(light.animation, {});
    if (before && before->kind == kind) {
        light.animation = before;
        return;
    }
    Light as = light;
    as.animation = before;
    light.positionWS = shownMember(as, LightKeyed::Position, timeSeconds);
    if (before && before->looksAhead) light.directionWS = shownMember(as, LightKeyed::Direction, timeSeconds);
    const bool hadPeriod = before && before->kind != LightAnimationKind::Keyframes;
    const double periodSeconds = hadPeriod ? before->periodSeconds : kFirstPeriodSeconds;
    const double stepMetres = sizeMetres;
    switch (kind) {
    case LightAnimationKind::Orbit:
        return orbitLight(light, stepMetres, periodSeconds, timeSeconds);
    case LightAnimationKind::Wobble:
        light.animation.emplace().amplitudeMetres = {stepMetres, 0.0, 0.0};
        break;
    case LightAnimationKind::Path: {
        if (before && before->kind == LightAnimationKind::Keyframes) {
            LightAnimation path = pathOfKeys(before->keys);
            if (path.pointsWS.size() > 1 && scenes::hasLength(path)) {
                light.animation = std::move(path);
                return;
            }
        }
        const glm::dvec3& cornerWS = light.positionWS;
        light.animation.emplace().pointsWS = {cornerWS, cornerWS + glm::dvec3(stepMetres, 0.0, 0.0),
                                              cornerWS + glm::dvec3(stepMetres, 0.0, stepMetres),
                                              cornerWS + glm::dvec3(0.0, 0.0, stepMetres)};
        break;
    }
    case LightAnimationKind::Keyframes:
        if (before && before->kind == LightAnimationKind::Path) {
            light.animation.emplace().kind = kind;
            light.animation->keys = keysOfPath(*before);
        } else {
            addKey(light, LightKeyed::Position, timeSeconds);
        }
        return;
    }
    light.animation->kind = kind;
    light.animation->periodSeconds = periodSeconds;
    light.animation->phase = phaseOfBegin(timeSeconds, periodSeconds);
}

void addPathPoint(Light& light, std::size_t behind) {
    LightAnimation& path = *light.animation;
    std::vector<glm::dvec3>& pointsWS = path.pointsWS;
    assert(path.kind == LightAnimationKind::Path && behind < pointsWS.size());
    const glm::dvec3 hereWS = pointsWS[behind];
    const bool isEnd = path.isOpen && behind + 1 == pointsWS.size();
    const glm::dvec3 addedWS =
        isEnd ? 2.0 * hereWS - pointsWS[behind - 1] : 0.5 * (hereWS + pointsWS[(behind + 1) % pointsWS.size()]);
    pointsWS.insert(pointsWS.begin() + std::ptrdiff_t(behind) + 1,
                    glm::clamp(addedWS, glm::dvec3(-kMostMetres), glm::dvec3(kMostMetres)));
}

bool removePathPoint(Light& light, std::size_t point) {
    LightAnimation fewer = *light.animation;
    assert(fewer.kind == LightAnimationKind::Path && point < fewer.pointsWS.size());
    fewer.pointsWS.erase(fewer.pointsWS.begin() + std::ptrdiff_t(point));
    if (fewer.pointsWS.size() < 2 || !scenes::hasLength(fewer)) return false;
    light.animation = std::move(fewer);
    return true;
}

bool movePathPoint(Light& light, std::size_t point, const glm::dvec3& placeWS) {
    LightAnimation moved = *light.animation;
    assert(moved.kind == LightAnimationKind::Path && point < moved.pointsWS.size());
    moved.pointsWS[point] = placeWS;
    if (!scenes::hasLength(moved)) return false;
    light.animation = std::move(moved);
    return true;
}

} // namespace tessera::viewer
