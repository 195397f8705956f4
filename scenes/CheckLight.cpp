#include "scenes/CheckLight.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "scenes/AreaLight.h"
#include "scenes/Limits.h"

namespace tessera::scenes {
namespace {

/// Key values only need to be finite: interpolated values are clamped to the bounds of their member.
void checkKeys(const CheckedElement& element, const LightKeys& keys) {
    const std::vector<double>& times = keys.timesSeconds;
    const std::string_view name = infoOf(keys.of).name;
    element.require(!times.empty() && times.size() == keys.values.size(),
                    fmt::format("has {} key times for {} keys of its {}; give as many of both, at least one",
                                times.size(), keys.values.size(), name));
    for (std::size_t i = 0; i < times.size(); ++i) {
        element.require(std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1]), "its key times must ascend");
    }
    element.require(std::isfinite(times.back() - times.front()), "its key times lie too far apart");
    for (const glm::dvec3& value : keys.values) {
        element.require(allFinite(value), fmt::format("a key of its {} is not finite", name));
        element.require(!infoOf(keys.of).isOnSphere || isUnit(value),
                        fmt::format("a key of its {} must be of unit length", name));
        element.require(keys.of != LightKeyed::Position || isNearEnough(value),
                        fmt::format("a key leads more than {:g} m from the origin; keep it nearer", kFarthestMetres));
    }
    if (keys.interpolation != Interpolation::CubicSpline) return;
    element.require(keys.inTangents.size() == times.size() && keys.outTangents.size() == times.size(),
                    fmt::format("has {} in-tangents and {} out-tangents for {} key times; give as many",
                                keys.inTangents.size(), keys.outTangents.size(), times.size()));
    // A spline deviates from its keys by less than its tangents times the time between two keys.
    const double seconds = std::max(1.0, times.back() - times.front());
    for (const std::vector<glm::dvec3>* tangents : {&keys.inTangents, &keys.outTangents})
        for (const glm::dvec3& tangent : *tangents) {
            element.require(allFinite(tangent * seconds), "a tangent of its keys leads too far; make it shorter");
            element.require(
                keys.of != LightKeyed::Position || isNearEnough(tangent * seconds),
                fmt::format("a tangent of its keys leads more than {:g} m away; make it shorter", kFarthestMetres));
        }
}

void checkAnimation(const CheckedElement& element, const LightAnimation& animation) {
    element.require(std::isfinite(animation.periodSeconds) && animation.periodSeconds > 0.0,
                    "the period of its animation must be positive");
    element.require(std::isfinite(animation.phase), "the phase of its animation is not finite");
    element.require(allFinite(animation.centerWS) && allFinite(animation.amplitudeMetres),
                    "its animation's centre and amplitude must be finite");
    element.require(allFinite(animation.axisWS), "its animation's axis is not finite");
    if (animation.kind == LightAnimationKind::Orbit) {
        element.require(glm::length(animation.axisWS) > 0.0, "the axis of its orbit has no length");
    }
    for (const glm::dvec3& pointWS : animation.pointsWS) element.require(allFinite(pointWS), "a point is not finite");
    const auto& points = animation.pointsWS;
    element.require(
        isNearEnough(animation.centerWS) && isNearEnough(animation.amplitudeMetres) &&
            std::all_of(points.begin(), points.end(), isNearEnough),
        fmt::format("its animation leads more than {:g} m from the origin; keep it nearer", kFarthestMetres));
    if (animation.kind == LightAnimationKind::Path) {
        element.require(animation.pointsWS.size() >= 2, "its path needs at least two points");
        element.require(hasLength(animation), "its path has no length; move one of its points");
    }
    if (animation.kind == LightAnimationKind::Keyframes) {
        element.require(animation.keys.of == LightKeyed::Position,
                        "the keyframes of its animation must be of position");
        checkKeys(element, animation.keys);
    }
}

} // namespace

void checkLight(const CheckedElement& element, const Light& light) {
    visitFields(kLightFields, [&](const auto& field) {
        if (field.what != nullptr && !isWithin(light.*field.member, field))
            element.require(
                false, fmt::format("{} must be {}{}", field.what, boundsText(field.least, field.most), field.unit));
    });
    element.require(allFinite(light.positionWS), "its position is not finite");
    element.require(isNearEnough(light.positionWS),
                    fmt::format("it lies more than {:g} m from the origin; move it nearer", kFarthestMetres));
    element.require(isUnit(light.directionWS), "its direction must be of unit length");
    element.require(isUnit(light.alongWS), "the direction of its width must be of unit length");
    const LightTypeInfo& info = infoOf(light.type);
    if (info.isTurned())
        element.require(std::abs(glm::dot(light.alongWS, light.directionWS)) <= kUnitTolerance,
                        "the direction of its width must be at right angles to its direction");
    const std::string problem = cornersProblem(light.corners);
    element.require(problem.empty(), "its corners " + problem);
    if (info.isArea && light.falloff != Falloff::InverseSquare)
        element.require(false, fmt::format("a {} light falls off by its shape; it takes no falloff by A B C, only the "
                                           "range of an inverse-square one",
                                           info.name));
    element.require(light.rangeMetres >= 0.0f, "its range must not be negative");
    element.require(light.falloff != Falloff::Attenuation || light.attenuation != glm::vec3(0.0f),
                    "the attenuation coefficients A, B, C are all 0; give at least one");
    element.require(
        light.innerConeRadians <= light.outerConeRadians,
        fmt::format("its inner cone of {:g} radians is wider than its outer cone of {:g} radians; make it narrower",
                    light.innerConeRadians, light.outerConeRadians));
    if (light.animation) checkAnimation(element, *light.animation);
    std::set<LightKeyed> keyed;
    for (const LightKeys& keys : light.keyframes) {
        element.require(keys.of != LightKeyed::Position, "keyframes of its position belong into its animation");
        element.require(keyed.insert(keys.of).second,
                        fmt::format("has keyframes of its {} twice; keep one of them", infoOf(keys.of).name));
        checkKeys(element, keys);
    }
    if (!light.flicker) return;
    const LightFlicker& flicker = *light.flicker;
    element.require(flicker.amplitude >= 0.0 && flicker.amplitude <= 1.0,
                    "the amplitude of its flicker must be between 0 and 1");
    element.require(
        flicker.frequencyHz > 0.0 && flicker.frequencyHz <= LightFlicker::kMostHertz,
        fmt::format("the frequency of its flicker must be above 0 and at most {:g} Hz", LightFlicker::kMostHertz));
    element.require(flicker.seed >= 0, "the seed of its flicker must not be negative");
}

} // namespace tessera::scenes
