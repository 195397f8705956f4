#include "viewer/edit/LightList.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <numbers>
#include <unordered_set>

#include <fmt/format.h>
#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace tessera::viewer {
namespace {

constexpr double kDefaultLux = 3.0; ///< of the light that a scene without lights gets (scenes/Defaults.h)

/// A name without the number that tells copies apart.
std::string withoutNumber(const std::string& name) {
    const std::size_t space = name.find_last_of(' ');
    if (space == std::string::npos || space == 0 || space + 1 == name.size()) return name;
    const bool isNumber = name.find_first_not_of("0123456789", space + 1) == std::string::npos;
    return isNumber ? name.substr(0, space) : name;
}

} // namespace

std::string freeLightName(const Lights& lights, const std::string& wanted) {
    std::unordered_set<std::string_view> taken;
    for (const scenes::Light& light : lights) taken.insert(light.name);
    if (!taken.contains(wanted)) return wanted;
    std::string name;
    for (int number = 2; name.empty() || taken.contains(name); ++number) name = fmt::format("{} {}", wanted, number);
    return name;
}

std::size_t addLight(Lights& lights, scenes::Light light) {
    light.name = freeLightName(lights, light.name.empty() ? "light" : light.name);
    lights.push_back(std::move(light));
    return lights.size() - 1;
}

scenes::Light lightAtFocus(const CameraPose& pose) {
    scenes::Light light;
    light.name = "light";
    // Halfway, so that it stands before the things that are looked at and not inside them.
    const double distanceMetres = 0.5 * pose.focusMetres;
    light.positionWS = pose.eyeWS + distanceMetres * pose.heading.forwardWS();
    light.directionWS = pose.heading.forwardWS();
    light.intensity = float(kDefaultLux * distanceMetres * distanceMetres);
    return light;
}

std::size_t duplicateLight(Lights& lights, std::size_t index) {
    assert(index < lights.size());
    scenes::Light copy = lights[index];
    copy.name = freeLightName(lights, withoutNumber(copy.name));
    lights.push_back(std::move(copy));
    return lights.size() - 1;
}

void deleteLight(Lights& lights, std::size_t index, std::optional<int>& solo) {
    assert(index < lights.size());
    lights.erase(lights.begin() + std::ptrdiff_t(index));
    if (!solo || *solo < int(index)) return;
    if (*solo == int(index))
        solo.reset();
    else
        --*solo;
}

std::optional<int> toggledSolo(std::optional<int> solo, std::size_t index) {
    if (solo == int(index)) return {};
    return int(index);
}

void moveLight(scenes::Light& light, double timeSeconds, const CameraPose& pose, const scenes::Camera& lens,
               const glm::dvec2& dragPixels, double heightPixels) {
    if (light.type == scenes::LightType::Directional) return;
    const glm::dvec3 shownWS = scenes::lightAtTime(light, timeSeconds).positionWS;
    const double depthMetres = glm::dot(shownWS - pose.eyeWS, pose.heading.forwardWS());
    const double metres =
        metresPerPixel(lens, pose, depthMetres > pose.nearMetres ? depthMetres : pose.focusMetres, heightPixels);
    const glm::dvec3 stepWS = metres * (dragPixels.x * pose.heading.rightWS() - dragPixels.y * pose.heading.upWS());
    light.positionWS += stepWS;
    if (!light.animation) return;
    light.animation->centerWS += stepWS;
    for (glm::dvec3& pointWS : light.animation->pointsWS) pointWS += stepWS;
}

void aimLight(scenes::Light& light, const CameraPose& pose, const glm::dvec2& dragPixels, double heightPixels) {
    if (light.type == scenes::LightType::Point) return;
    const glm::dvec2 angles = dragPixels * (std::numbers::pi / heightPixels);
    const glm::dquat turn =
        glm::angleAxis(angles.x, pose.heading.upWS()) * glm::angleAxis(angles.y, pose.heading.rightWS());
    light.directionWS = glm::normalize(turn * light.directionWS);
}

void orbitLight(scenes::Light& light, double radiusMetres, double periodSeconds) {
    if (light.type == scenes::LightType::Directional) return;
    assert(radiusMetres > 0.0 && periodSeconds > 0.0);
    scenes::LightAnimation animation;
    animation.kind = scenes::LightAnimationKind::Orbit;
    animation.periodSeconds = periodSeconds;
    animation.centerWS = light.positionWS - glm::dvec3(radiusMetres, 0.0, 0.0);
    light.animation = animation;
}

void stopLight(scenes::Light& light, double timeSeconds) {
    light = scenes::lightAtTime(light, timeSeconds);
    light.animation.reset();
}

} // namespace tessera::viewer
