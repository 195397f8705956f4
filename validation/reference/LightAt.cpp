#include "validation/reference/LightAt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "validation/reference/LightSurface.h"

namespace tessera::reference {

namespace {

using scenes::Falloff;
using scenes::LightType;

constexpr double kEndless = std::numeric_limits<double>::infinity();
// The clamps of the product's definition of lights (docs/numerics.md), which keep them finite at d = 0 and for any
// intensity.
constexpr double kSmallestSquaredDistance = 1e-4; // m^2, and the smallest A + B d + C d^2
constexpr double kBrightest = 1e30;

double attenuationAt(const scenes::Light& light, double distanceMetres) {
    return double(light.attenuation.x) + double(light.attenuation.y) * distanceMetres +
           double(light.attenuation.z) * distanceMetres * distanceMetres;
}

/// The area within an outline, m^2, by the shoelace formula.
double outlineArea(const scenes::LightCorners& corners) {
    const std::span<const glm::vec2> all = corners.all();
    double twice = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const glm::dvec2 a = glm::dvec2(all[i]), b = glm::dvec2(all[(i + 1) % all.size()]);
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(twice);
}

static_assert(scenes::kAreaTypeCount == 5,
              "a new shape needs a case in projectedArea() and boundingRadiusMetres(), and perhaps in "
              "mostProjectedArea()");

/// The projected area of an area light towards a point, m^2. `cosFront` is the cosine between the light's direction and
/// that to the point, above 0 on its front.
double projectedArea(const scenes::Light& light, double cosFront) {
    const double radius = double(light.radiusMetres), circle = std::numbers::pi * radius * radius;
    const double facing = light.isTwoSided ? std::abs(cosFront) : std::max(cosFront, 0.0);
    switch (light.type) {
    case LightType::Rectangle:
        return double(light.widthMetres) * double(light.heightMetres) * facing;
    case LightType::Disk:
        return circle * facing;
    case LightType::Sphere:
        return circle;
    case LightType::Tube:
        return 2.0 * radius * double(light.lengthMetres) * std::sqrt(std::max(1.0 - cosFront * cosFront, 0.0)) +
               circle * std::abs(cosFront);
    case LightType::Polygon:
        return outlineArea(light.corners) * facing;
    default:
        return 0.0;
    }
}

/// An upper bound of an area light's projected area from any side.
double mostProjectedArea(const scenes::Light& light) {
    if (light.type == LightType::Tube) return projectedArea(light, 0.0) + projectedArea(light, 1.0);
    return projectedArea(light, 1.0);
}

/// Radius of the sphere around an area light's middle that holds it.
double boundingRadiusMetres(const scenes::Light& light) {
    if (light.type == LightType::Rectangle)
        return 0.5 * std::hypot(double(light.widthMetres), double(light.heightMetres));
    if (light.type == LightType::Tube) return std::hypot(double(light.radiusMetres), 0.5 * double(light.lengthMetres));
    if (light.type == LightType::Polygon) {
        double farthest = 0.0;
        for (const glm::vec2& corner : light.corners.all())
            farthest = std::max(farthest, std::hypot(double(corner.x), double(corner.y)));
        return farthest;
    }
    return double(light.radiusMetres);
}

/// KHR_lights_punctual's cone, squared as it recommends.
double coneWindow(const scenes::Light& light, double cosAngle) {
    if (!(light.outerConeRadians > 0.0f)) return 0.0;
    const double cosInner = std::cos(double(light.innerConeRadians)),
                 cosOuter = std::cos(double(light.outerConeRadians));
    const double open = std::clamp((cosAngle - cosOuter) / std::max(0.001, cosInner - cosOuter), 0.0, 1.0);
    return open * open;
}

// ---- Types ---------------------------------------------------------------------------------------------------------

Incident directional(const ShiningLight& shining, const glm::dvec3&) {
    return {-shining.light.directionWS, shining.color};
}

/// Incident light by falloff and range, for a light with a position that is equal in all directions.
Incident point(const ShiningLight& shining, const glm::dvec3& positionRWS) {
    const scenes::Light& light = shining.light;
    const glm::dvec3 toLight = shining.positionRWS - positionRWS;
    const double distance = glm::length(toLight);
    const double window = rangeWindow(distance, shining.rangeMetres);
    if (window == 0.0 || distance == 0.0) return {};
    const double fading = light.falloff == Falloff::Attenuation ? attenuationAt(light, distance) : distance * distance;
    return {toLight / distance, shining.color * (window / std::max(fading, kSmallestSquaredDistance))};
}

Incident spot(const ShiningLight& shining, const glm::dvec3& positionRWS) {
    Incident incident = point(shining, positionRWS);
    incident.irradiance *= coneWindow(shining.light, -glm::dot(incident.toLight, shining.light.directionWS));
    return incident;
}

Incident area(const ShiningLight& shining, const glm::dvec3& positionRWS) {
    const glm::dvec3 toLight = shining.positionRWS - positionRWS;
    const double distance = glm::length(toLight);
    const double window = rangeWindow(distance, shining.rangeMetres);
    if (window == 0.0 || distance == 0.0) return {};
    const double projected = projectedArea(shining.light, -glm::dot(shining.light.directionWS, toLight) / distance);
    // From afar by the solid angle; never more than a hemisphere, whose irradiance is pi times the radiance.
    return {toLight / distance,
            shining.mean * shining.color * (window * projected / (distance * distance + projected / std::numbers::pi))};
}

struct Type {
    LightType type;
    Incident (*at)(const ShiningLight& shining, const glm::dvec3& positionRWS);
};
constexpr std::array kTypes{Type{LightType::Directional, directional},
                            Type{LightType::Point, point},
                            Type{LightType::Spot, spot},
                            Type{LightType::Rectangle, area},
                            Type{LightType::Disk, area},
                            Type{LightType::Sphere, area},
                            Type{LightType::Tube, area},
                            Type{LightType::Polygon, area}};
consteval bool isInOrder() {
    for (std::size_t i = 0; i < kTypes.size(); ++i)
        if (kTypes[i].type != LightType(i)) return false;
    return kTypes.size() == scenes::kLightTypeCount;
}
static_assert(isInOrder(), "a function for every light type, in their order");

} // namespace

double rangeWindow(double distanceMetres, double rangeMetres) {
    if (std::isinf(rangeMetres)) return 1.0;
    if (!(distanceMetres < rangeMetres)) return 0.0;
    const double open = 1.0 - std::pow(distanceMetres / rangeMetres, 4);
    return open * open;
}

double rangeOf(const scenes::Light& light, double brightest, double rangeTolerance) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (!info.hasPosition()) return kEndless;
    if (info.isArea && std::isinf(light.rangeMetres) && rangeTolerance > 0.0) {
        // An upper bound: all of the surface at its nearest point.
        return boundingRadiusMetres(light) + std::sqrt(brightest * mostProjectedArea(light) / rangeTolerance);
    }
    if (info.isArea || light.falloff == Falloff::InverseSquare) return double(light.rangeMetres);
    if (rangeTolerance == 0.0 || (light.attenuation.y == 0.0f && light.attenuation.z == 0.0f)) return kEndless;
    const auto isAbove = [&](double metres) { return brightest > rangeTolerance * attenuationAt(light, metres); };
    if (!isAbove(0.0)) return 0.0;
    double inside = 0.0, outside = 1.0;
    while (isAbove(outside)) {
        inside = outside;
        outside *= 2.0;
        if (std::isinf(outside)) return kEndless;
    }
    for (double middle = 0.5 * (inside + outside); middle > inside && middle < outside;
         middle = 0.5 * (inside + outside))
        (isAbove(middle) ? inside : outside) = middle;
    return outside;
}

std::vector<ShiningLight> shiningLights(const scenes::Scene& scene, const Settings& settings, const glm::dvec3& eyeWS) {
    std::vector<ShiningLight> lights;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (!scene.lights[i].enabled || (settings.soloLight && *settings.soloLight != int(i))) continue;
        ShiningLight shining;
        shining.light = scenes::lightAtTime(scene.lights[i], settings.timeSeconds);
        if (!scenes::infoOf(shining.light.type).isFlat) shining.light.texture = {};
        const glm::dvec3 most(shining.light.texture.most());
        shining.color = glm::min(glm::dvec3(shining.light.color) * double(shining.light.intensity),
                                 kBrightest / glm::max(most, 1.0));
        shining.mean = meanFactor(shining.light);
        shining.positionRWS = shining.light.positionWS - eyeWS;
        const double brightest =
            std::max({most.r * shining.color.r, most.g * shining.color.g, most.b * shining.color.b});
        shining.rangeMetres = rangeOf(shining.light, brightest, settings.rangeTolerance);
        shining.castsShadow = scenes::castsShadow(scene, i, settings.shadows);
        if (brightest > 0.0 && shining.rangeMetres > 0.0) lights.push_back(shining);
    }
    return lights;
}

Incident incidentAt(const ShiningLight& shining, const glm::dvec3& positionRWS) {
    return kTypes[std::size_t(shining.light.type)].at(shining, positionRWS);
}

} // namespace tessera::reference
