#include "scenes/builtin/hall/Lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Places.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin::hall {
namespace {

using std::numbers::pi;
constexpr int kPlaces = 256;

constexpr glm::vec3 kAmber(1.0f, 0.56f, 0.22f);
constexpr glm::vec3 kRose(1.0f, 0.30f, 0.34f);
constexpr glm::vec3 kTeal(0.12f, 0.80f, 0.72f);
constexpr glm::vec3 kViolet(0.52f, 0.30f, 1.0f);
constexpr glm::vec3 kSky(0.25f, 0.52f, 1.0f);

/// A saturated colour of the given hue 0..1, its largest channel 1.
glm::vec3 hueColor(double hue) {
    glm::vec3 color;
    for (glm::length_t k = 0; k < 3; ++k) {
        color[k] = static_cast<float>(0.5 + 0.5 * std::cos(2.0 * pi * (hue - static_cast<double>(k) / 3.0)));
    }
    return color / std::max({color.x, color.y, color.z});
}

void addPlace(std::vector<Light>& places, const std::string& name, const glm::dvec3& positionWS, const glm::vec3& color,
              float candela, float rangeMetres) {
    Light light;
    light.name = name + " " + std::to_string(places.size());
    light.positionWS = positionWS;
    light.color = color;
    light.intensity = candela;
    light.rangeMetres = rangeMetres;
    places.push_back(std::move(light));
}

/// Lamps that belong to the architecture: at the columns, arches, niches, cornices and vault.
void addFixtures(std::vector<Light>& places) {
    for (const double side : {-1.0, 1.0}) {
        for (int c = 0; c < kBays; ++c) { // the column at the portal has none
            const double z = columnZ(c);
            addPlace(places, "column foot", {side * 3.15, 0.55, z + 0.62}, kAmber, 2.0f, 3.0f);
            addPlace(places, "capital", {side * 3.3, 4.55, z + 0.5}, kAmber, 2.8f, 3.4f);
            addPlace(places, "aisle", {side * 6.2, 5.2, z}, c % 2 == 0 ? kTeal : kViolet, 9.5f, 5.0f);
        }
        for (int b = 0; b < kBays; ++b) {
            const double z = bayZ(b);
            addPlace(places, "arch", {side * kColumnX, 6.35, z}, b % 2 == 0 ? kRose : kAmber, 2.6f, 3.0f);
            addPlace(places, "niche", {side * 7.75, 3.0, z}, b % 2 == 0 ? glm::vec3(1.0f, 0.78f, 0.55f) : kTeal, 1.5f,
                     2.8f);
            addPlace(places, "cornice", {side * 2.95, 8.95, z - 1.0}, kViolet, 3.8f, 4.0f);
            addPlace(places, "cornice", {side * 2.95, 8.95, z + 1.0}, kSky, 3.8f, 4.0f);
            addPlace(places, "vault", {side * 1.5, 12.6, z}, b % 2 == 0 ? kSky : kViolet, 8.0f, 4.5f);
        }
    }
}

/// A crown of lamps around the apse, and two before its colossus.
void addApse(std::vector<Light>& places) {
    constexpr int kLamps = 18;
    for (int i = 0; i < kLamps; ++i) {
        const double angle = pi * (i + 0.5) / kLamps;
        const double radius = i % 2 == 0 ? 2.45 : 1.9;
        const double y = i % 2 == 0 ? 5.9 : 1.1;
        const glm::dvec3 positionWS(radius * std::cos(angle), y, -kHalfLength - radius * std::sin(angle));
        addPlace(places, "apse", positionWS, i % 2 == 0 ? kAmber : kRose, 1.6f, 3.4f);
    }
    for (const double side : {-1.0, 1.0}) { // illuminate the colossus from below
        addPlace(places, "dais", {side * 1.3, 1.1, -kHalfLength + 0.9}, kAmber, 5.0f, 4.5f);
    }
}

/// Two lamps on each side of the portal.
void addPortal(std::vector<Light>& places) {
    for (const double side : {-1.0, 1.0}) {
        for (const double y : {2.6, 6.4}) {
            addPlace(places, "portal", {side * 2.4, y, kHalfLength - 0.9}, kAmber, 6.0f, 4.5f);
        }
    }
}

/// Wisps that drift in two helices along the nave; their hue changes along the way.
void addWisps(std::vector<Light>& places) {
    const int count = kPlaces - static_cast<int>(places.size());
    assert(count > 0);
    for (int i = 0; i < count; ++i) {
        const double way = (i + 0.5) / count;
        const double angle = 2.0 * pi * 5.0 * way + pi * (i % 2);
        const glm::dvec3 positionWS(1.75 * std::cos(angle), 2.4 + 1.35 * std::sin(angle),
                                    -kHalfLength + 1.5 + (2.0 * kHalfLength - 4.0) * way);
        addPlace(places, "wisp", positionWS, hueColor(0.08 + 0.9 * way), 3.2f, 3.4f);
        LightAnimation& drift = places.back().animation.emplace();
        drift.kind = LightAnimationKind::Wobble;
        drift.periodSeconds = 5.0 + static_cast<double>(i % 4);
        drift.phase = std::fmod(0.618 * i, 1.0); // the golden ratio keeps neighbours out of step
        drift.amplitudeMetres = {0.25, 0.35, 0.3};
    }
}

} // namespace

void addPointLights(Scene& scene, int count) {
    std::vector<Light> places;
    addFixtures(places);
    addApse(places);
    addPortal(places);
    addWisps(places);
    assert(places.size() == kPlaces);
    addLightsAtPlaces(scene, places, count, 157, 0.9);
}

void addOutdoorLights(Scene& scene) {
    addDirectionalLight(scene, "evening sky", {0.62, -0.72, -0.3}, {0.62f, 0.76f, 1.0f}, 0.7f);
    addDirectionalLight(scene, "evening sun", {0.62, -0.72, -0.12}, {1.0f, 0.74f, 0.44f}, 6.0f);
    scene.lights.back().castsShadow = true;
}

void castShadowsOfNearest(Scene& scene, const glm::dvec3& eyeWS) {
    constexpr std::size_t kShadowedLamps = 16;
    std::vector<Light*> lamps;
    for (Light& light : scene.lights)
        if (light.type == LightType::Point) lamps.push_back(&light);
    std::ranges::stable_sort(lamps, {}, [&](const Light* lamp) { return glm::distance(lamp->positionWS, eyeWS); });
    for (std::size_t i = 0; i < std::min(lamps.size(), kShadowedLamps); ++i) lamps[i]->castsShadow = true;
}

} // namespace tessera::scenes::builtin::hall
