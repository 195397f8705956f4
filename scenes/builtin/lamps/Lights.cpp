#include "scenes/builtin/lamps/Lights.h"

#include <cassert>

#include "scenes/builtin/Places.h"
#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/lamps/Plan.h"

namespace tessera::scenes::builtin::lamps {

const std::array<LampKind, static_cast<std::size_t>(Lamp::Count)> kLampKinds{{
    {Lamp::Shelf, "shelf", {1.0f, 0.70f, 0.40f}, 40.0f, 2.4f, 0.03f, 2.0f, false},
    {Lamp::CaseEnd, "case end", {1.0f, 0.80f, 0.55f}, 14.0f, 1.6f, 0.05f, 4.0f, false},
    {Lamp::Luminaire, "luminaire", {0.74f, 0.87f, 1.0f}, 8.0f, 1.2f, 0.5f, 7.5f, true},
    {Lamp::Gallery, "gallery", {1.0f, 0.92f, 0.80f}, 6.0f, 0.6f, 0.6f, 4.5f, false},
    {Lamp::Desk, "desk", {1.0f, 0.77f, 0.46f}, 36.0f, 0.28f, 0.1f, 2.2f, false},
    {Lamp::Washer, "washer", {0.86f, 0.93f, 1.0f}, 22.0f, 2.0f, 0.08f, 4.5f, false},
}};

namespace {

/// Distance from a light to its visible glowing surface: behind the light, which thus does not illuminate it, or in
/// front of both sides of a two-sided one.
constexpr double kGlowMetres = 0.005;

void addLampPlace(std::vector<LampPlace>& places, Lamp lamp, const glm::dvec3& surfaceWS, const glm::dvec3& directionWS,
                  const glm::dvec3& alongWS) {
    const LampKind& kind = kLampKinds[static_cast<std::size_t>(lamp)];
    Light light;
    light.name = std::string(kind.name) + " " + std::to_string(places.size());
    light.type = LightType::Rectangle;
    light.positionWS = surfaceWS + (kind.isTwoSided ? 0.0 : kGlowMetres) * directionWS;
    light.directionWS = directionWS;
    light.alongWS = alongWS;
    light.widthMetres = kind.widthMetres;
    light.heightMetres = kind.heightMetres;
    light.color = kind.color;
    light.intensity = kind.radiance;
    light.rangeMetres = kind.rangeMetres;
    light.isTwoSided = kind.isTwoSided;
    places.push_back({lamp, std::move(light)});
}

constexpr glm::dvec3 kDown(0.0, -1.0, 0.0);
constexpr glm::dvec3 kAlongX(1.0, 0.0, 0.0);
constexpr glm::dvec3 kAlongY(0.0, 1.0, 0.0);
constexpr glm::dvec3 kAlongZ(0.0, 0.0, 1.0);

void addCaseLamps(std::vector<LampPlace>& places, double side) {
    for (int c = 0; c < kCases; ++c) {
        for (const double face : {-1.0, 1.0}) {
            for (int shelf = 1; shelf <= kShelves; ++shelf) {
                for (const double half : {0.25, 0.75}) {
                    const glm::dvec3 surfaceWS(side * (kCaseX + half * kCaseLength), boardY(shelf) - kBoard - 0.01,
                                               caseZ(c) + face * (kCaseHalfDepth - 0.02));
                    addLampPlace(places, Lamp::Shelf, surfaceWS, {0.0, -0.8, -0.6 * face}, kAlongX);
                }
            }
        }
        addLampPlace(places, Lamp::CaseEnd, {side * (kCaseX - 0.01), 1.5, caseZ(c)}, {-side, 0.0, 0.0}, kAlongY);
    }
}

void addCeilingLamps(std::vector<LampPlace>& places, double side) {
    constexpr int kRows = 24;
    for (int row = 0; row < kRows; ++row) {
        const double z = -kHalfLength + (row + 0.5) * 2.0 * kHalfLength / kRows;
        for (const double x : {1.2, 3.4})
            addLampPlace(places, Lamp::Luminaire, {side * x, kLuminaireY, z}, kDown, kAlongZ);
    }
    for (int c = 0; c < kCases; ++c)
        for (const double x : {5.9, 7.8, 9.7})
            addLampPlace(places, Lamp::Gallery, {side * x, kGalleryUnderY - 0.005, caseZ(c) + 0.9}, kDown, kAlongZ);
}

void addDeskLamps(std::vector<LampPlace>& places, double side) {
    for (int desk = 0; desk < kDesks; ++desk)
        for (int lamp = 0; lamp < kDeskLamps; ++lamp)
            addLampPlace(places, Lamp::Desk, {side * kDeskX, kShadeY + 0.01, deskZ(desk) + deskLampZ(lamp)}, kDown,
                         kAlongZ);
}

void addWashers(std::vector<LampPlace>& places, double side) {
    constexpr int kWashers = 20;
    for (int i = 0; i < kWashers; ++i)
        addLampPlace(places, Lamp::Washer,
                     {side * kWasherX, kWasherY, -kHalfLength + (i + 0.5) * 2.0 * kHalfLength / kWashers},
                     {side * 0.6, -0.8, 0.0}, kAlongZ);
}

} // namespace

std::vector<LampPlace> lampPlaces() {
    std::vector<LampPlace> places;
    for (const double side : {-1.0, 1.0}) {
        addCaseLamps(places, side);
        addCeilingLamps(places, side);
        addDeskLamps(places, side);
        addWashers(places, side);
    }
    assert(places.size() == kLampPlaces);
    return places;
}

Mesh glowingSurfaces(const std::vector<LampPlace>& places, Lamp lamp) {
    Mesh mesh;
    for (const LampPlace& place : places) {
        if (place.lamp != lamp) continue;
        const Light& light = place.light;
        const glm::dvec3 across = glm::cross(light.directionWS, light.alongWS);
        const auto appendSide = [&](double outMetres, double turn) {
            const glm::dvec3 middleWS = light.positionWS + outMetres * light.directionWS;
            const glm::dvec3 right = 0.5 * static_cast<double>(light.widthMetres) * light.alongWS;
            const glm::dvec3 up = turn * 0.5 * static_cast<double>(light.heightMetres) * across;
            appendQuad(mesh, middleWS - right - up, middleWS + right - up, middleWS + right + up,
                       middleWS - right + up);
        };
        appendSide(light.isTwoSided ? kGlowMetres : -kGlowMetres, 1.0);
        if (light.isTwoSided) appendSide(-kGlowMetres, -1.0);
    }
    return mesh;
}

void addLamps(Scene& scene, const std::vector<LampPlace>& places, int count) {
    std::vector<Light> lights;
    for (const LampPlace& place : places) lights.push_back(place.light);
    constexpr double kCrowdMetres = 0.2;
    addLightsAtPlaces(scene, lights, count, 617, kCrowdMetres);
}

} // namespace tessera::scenes::builtin::lamps
