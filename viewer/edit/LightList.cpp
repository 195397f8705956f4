#include "viewer/edit/LightList.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "scenes/AreaLight.h"
#include "scenes/Direction.h"

namespace tessera::viewer {
namespace {

/// Generates names that no light has yet.
class FreeNames {
public:
    explicit FreeNames(const Lights& lights) {
        for (const scenes::Light& light : lights) taken_.insert(light.name);
    }
    std::string take(const std::string& wanted) {
        std::string name = wanted;
        for (int& number = next_.try_emplace(wanted, 2).first->second; taken_.contains(name); ++number)
            name = fmt::format("{} {}", wanted, number);
        taken_.insert(name);
        return name;
    }

private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, int> next_; ///< next number to try
};

/// The corners of a rectangle; a polygon's x runs along its width.
scenes::LightCorners cornersOfSides(const scenes::Light& light) {
    scenes::LightCorners corners; // of a square of 1 m
    for (glm::vec2& corner : corners.metres) corner *= glm::vec2(light.widthMetres, light.heightMetres);
    return corners;
}

bool setCorners(scenes::Light& light, const scenes::LightCorners& corners) {
    if (!scenes::cornersProblem(corners).empty()) return false;
    light.corners = corners;
    return true;
}

} // namespace

std::string lightLabel(const Lights& lights, std::size_t index) {
    return lights[index].name.empty() ? fmt::format("light {}", index) : lights[index].name;
}

std::string withoutNumber(const std::string& name) {
    const std::size_t space = name.find_last_of(' ');
    if (space == std::string::npos || space == 0 || space + 1 == name.size()) return name;
    const bool isNumber = name.find_first_not_of("0123456789", space + 1) == std::string::npos;
    return isNumber ? name.substr(0, space) : name;
}

std::string freeLightName(const Lights& lights, const std::string& wanted) {
    return FreeNames(lights).take(wanted);
}

scenes::Light newLight(const Lights& lights, scenes::Light light) {
    light.name = freeLightName(lights, light.name.empty() ? "light" : light.name);
    return light;
}

Lights copiesOfLights(const Lights& lights, const std::set<int>& indices) {
    FreeNames names(lights);
    Lights copies;
    for (const int index : indices) {
        scenes::Light& copy = copies.emplace_back(lights.at(std::size_t(index)));
        copy.name = names.take(withoutNumber(copy.name));
    }
    return copies;
}

std::optional<int> indexAfter(int index, std::size_t first, std::size_t taken, std::size_t put) {
    if (index < int(first) || taken == put) return index;
    if (index < int(first + taken)) return {};
    return index + int(put) - int(taken);
}

std::optional<int> toggledSolo(std::optional<int> solo, std::size_t index) {
    if (solo == int(index)) return {};
    return int(index);
}

void chooseType(scenes::Light& light, scenes::LightType type, double sceneSizeMetres) {
    constexpr double kFirstRadiusShare = 0.01; // of the scene's size
    const bool hadSides = scenes::infoOf(light.type).hasSides();
    light.type = type;
    if (!scenes::infoOf(type).isArea) return;
    light.falloff = scenes::Falloff::InverseSquare;
    if (!(light.radiusMetres > 0.0f))
        light.radiusMetres = float(std::min(kFirstRadiusShare * sceneSizeMetres, scenes::kMostRadiusMetres));
    if (scenes::infoOf(type).hasCorners()) {
        if (hadSides && light.corners == scenes::LightCorners()) light.corners = cornersOfSides(light);
        if (!scenes::hasSurface(light)) light.corners = {};
    }
    constexpr double kSquare = 1e-12; // cosine, within rounding: a perpendicular vector stays unchanged
    const bool isSquare = std::abs(glm::dot(light.alongWS, light.directionWS)) <= kSquare;
    if (scenes::infoOf(type).isTurned() && !isSquare && !layLight(light, light.alongWS))
        light.alongWS = scenes::usualAlong(light.directionWS);
}

void TypeChooser::choose(std::size_t index, scenes::Light& changed, scenes::LightType type, double sceneSizeMetres) {
    const scenes::LightTypeInfo& was = scenes::infoOf(changed.type);
    const scenes::LightTypeInfo& is = scenes::infoOf(type);
    const auto known = before_.find(index);
    if (was.hasCorners() && !is.hasCorners() && known != before_.end() && changed.corners == known->second.givenCorners)
        changed.corners = known->second.corners;
    const scenes::Light before = changed;
    chooseType(changed, type, sceneSizeMetres);
    if (!was.hasCorners() && is.hasCorners()) {
        before_[index].corners = before.corners;
        before_[index].givenCorners = changed.corners;
    }
    if (!was.isArea && is.isArea) {
        before_[index].falloff = before.falloff;
        before_[index].radiusMetres = before.radiusMetres;
        before_[index].givenMetres = changed.radiusMetres;
    } else if (was.isArea && !is.isArea && known != before_.end()) {
        changed.falloff = known->second.falloff;
        if (changed.radiusMetres == known->second.givenMetres) changed.radiusMetres = known->second.radiusMetres;
    }
}

void TypeChooser::follow(std::size_t first, std::size_t taken, std::size_t put) {
    std::map<std::size_t, Before> after;
    for (const auto& [index, before] : before_)
        if (const auto now = indexAfter(int(index), first, taken, put)) after.emplace(std::size_t(*now), before);
    before_ = std::move(after);
}

bool moveCorner(scenes::Light& light, std::size_t corner, const glm::vec2& placeMetres) {
    scenes::LightCorners moved = light.corners;
    assert(corner < moved.count);
    moved.metres[corner] = placeMetres;
    return setCorners(light, moved);
}

bool addCorner(scenes::Light& light) {
    scenes::LightCorners more = light.corners;
    return more.add(0.5f * (more.all().front() + more.all().back())) && setCorners(light, more);
}

bool removeCorner(scenes::Light& light) {
    scenes::LightCorners fewer = light.corners;
    --fewer.count;
    return setCorners(light, fewer);
}

void turnLight(scenes::Light& light, const glm::dvec3& directionWS) {
    const glm::dvec3 turnedWS = glm::normalize(directionWS);
    if (turnedWS != light.directionWS) { // turned by hand
        std::erase_if(light.keyframes, [](const auto& keys) { return keys.of == scenes::LightKeyed::Direction; });
        if (light.animation) light.animation->looksAhead = false;
    }
    light.directionWS = turnedWS;
    if (scenes::infoOf(light.type).isTurned() && !layLight(light, light.alongWS))
        light.alongWS = scenes::usualAlong(light.directionWS);
}

bool layLight(scenes::Light& light, const glm::dvec3& alongWS) {
    const std::optional<glm::dvec3> direction = scenes::directionOf(alongWS);
    if (!direction) return false;
    const std::optional<glm::dvec3> across = scenes::acrossFrom(light.directionWS, *direction);
    if (across) light.alongWS = *across;
    return across.has_value();
}

void placeLight(scenes::Light& light, double timeSeconds, const glm::dvec3& positionWS) {
    if (!light.animation) {
        light.positionWS = positionWS;
        return;
    }
    const glm::dvec3 stepWS = positionWS - scenes::lightAtTime(light, timeSeconds).positionWS;
    light.positionWS += stepWS;
    light.animation->centerWS += stepWS;
    for (std::vector<glm::dvec3>* places : {&light.animation->pointsWS, &light.animation->keys.values})
        for (glm::dvec3& placeWS : *places) placeWS += stepWS;
}

void moveLight(scenes::Light& light, double timeSeconds, const CameraPose& pose, const scenes::Camera& lens,
               const glm::dvec2& dragPixels, double heightPixels) {
    if (!scenes::infoOf(light.type).hasPosition()) return;
    const glm::dvec3 shownWS = scenes::lightAtTime(light, timeSeconds).positionWS;
    const double depthMetres = glm::dot(shownWS - pose.eyeWS, pose.heading.forwardWS());
    const double metres =
        metresPerPixel(lens, pose, depthMetres > pose.nearMetres ? depthMetres : pose.focusMetres, heightPixels);
    placeLight(light, timeSeconds,
               shownWS + metres * (dragPixels.x * pose.heading.rightWS() - dragPixels.y * pose.heading.upWS()));
}

void orbitLight(scenes::Light& light, double radiusMetres, double periodSeconds, double timeSeconds) {
    if (!scenes::infoOf(light.type).hasPosition()) return;
    assert(radiusMetres > 0.0 && periodSeconds > 0.0);
    const double turns = timeSeconds / periodSeconds;
    scenes::LightAnimation animation;
    animation.kind = scenes::LightAnimationKind::Orbit;
    animation.periodSeconds = periodSeconds;
    animation.phase = std::ceil(turns) - turns;
    animation.centerWS = light.positionWS - glm::dvec3(radiusMetres, 0.0, 0.0);
    light.animation = animation;
}

void stopLight(scenes::Light& light, double timeSeconds) {
    const std::optional<scenes::LightFlicker> flicker = std::exchange(light.flicker, {}); // the flicker stays
    light = scenes::lightAtTime(light, timeSeconds);
    light.flicker = flicker;
    light.animation.reset();
    light.keyframes.clear();
}

void letFlicker(scenes::Light& light, bool flickers, std::size_t index) {
    light.flicker.reset();
    if (flickers) light.flicker.emplace().seed = int(index);
}

} // namespace tessera::viewer
