#include "scenes/builtin/ShadowTruth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/Shapes.h"

namespace tessera::scenes::builtin {
namespace {

/// Fraction of a unit disk's area beyond a chord at `distance` from its middle, -1 .. 1.
double segmentShare(double distance) {
    const double d = std::clamp(distance, -1.0, 1.0);
    return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::numbers::pi;
}

/// Area of the overlap of two circles.
double overlap(double a, double b, double distance) {
    if (distance >= a + b) return 0.0;
    const double smaller = std::min(a, b);
    if (distance <= std::abs(a - b)) return std::numbers::pi * smaller * smaller;
    // From each centre to the common chord.
    const double toChordA = (distance * distance + a * a - b * b) / (2.0 * distance);
    const double toChordB = distance - toChordA;
    return std::numbers::pi * (a * a * segmentShare(toChordA / a) + b * b * segmentShare(toChordB / b));
}

/// Visible fraction of the lamp's disk: the plane through the point and the plate's edge meets it in a chord.
double lampShare(const glm::dvec3& groundWS, double radiusMetres) {
    const glm::dvec3 toLamp = kTruthLampWS - groundWS;
    const glm::dvec3 toEdge = glm::dvec3(kTruthPlateEdgeX, kTruthPlateY, groundWS.z) - groundWS;
    // Away from the plate, on the side of larger x.
    const glm::dvec3 normal = glm::cross(glm::dvec3(0.0, 0.0, 1.0), toEdge) * (toEdge.y > 0.0 ? -1.0 : 1.0);
    const glm::dvec3 ahead = glm::normalize(toLamp);
    const double across = glm::length(normal - glm::dot(normal, ahead) * ahead);
    return segmentShare(-glm::dot(normal, toLamp) / (across * radiusMetres));
}

double sunShare(const glm::dvec3& groundWS, double tangent) {
    const glm::dvec3 toSun = -glm::normalize(kTruthSunTravelWS);
    const glm::dvec3 toDisk = kTruthDiskWS - groundWS;
    const double ahead = glm::dot(toDisk, toSun);
    const double aside = glm::length(toDisk - ahead * toSun);
    return 1.0 -
           overlap(tangent, kTruthDiskRadiusMetres / ahead, aside / ahead) / (std::numbers::pi * tangent * tangent);
}

/// A disk with enough corners that its area is that of a circle to 7e-6.
Mesh disk(double radiusMetres) {
    constexpr int kCorners = 1024;
    Mesh mesh;
    mesh.positionsOS.emplace_back(0.0f);
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        mesh.positionsOS.emplace_back(radiusMetres * std::cos(angle), radiusMetres * std::sin(angle), 0.0);
        mesh.indices.insert(mesh.indices.end(), {0u, std::uint32_t(1 + i), std::uint32_t(1 + (i + 1) % kCorners)});
    }
    mesh.texCoords[0].assign(mesh.positionsOS.size(), glm::vec2(0.0f));
    mesh.normalsOS.assign(mesh.positionsOS.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    return mesh;
}

} // namespace

double shadowTruthShare(ShadowTruthLight light, const glm::dvec3& groundWS, double sizes) {
    return light == ShadowTruthLight::Lamp
               ? lampShare(groundWS, sizes * kTruthLampRadiusMetres)
               : sunShare(groundWS, sizes * std::tan(glm::radians(kTruthSunAngularRadiusDegrees)));
}

Scene makeShadowTruth(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "shadow_truth";
    scene.background = {0.02f, 0.022f, 0.028f};
    Mesh ground, plate;
    appendQuad(ground, {-7.0, 0.0, 4.0}, {7.0, 0.0, 4.0}, {7.0, 0.0, -4.0}, {-7.0, 0.0, -4.0});
    appendQuad(plate, {-6.0, kTruthPlateY, 3.5}, {kTruthPlateEdgeX, kTruthPlateY, 3.5},
               {kTruthPlateEdgeX, kTruthPlateY, -3.5}, {-6.0, kTruthPlateY, -3.5});
    Material paint = lambert("plate", glm::vec3(0.42f, 0.24f, 0.12f));
    paint.doubleSided = true;
    const int painted = addMaterial(scene, paint);
    addNode(scene, "ground", glm::dmat4(1.0),
            {{addMesh(scene, "ground", std::move(ground)), addMaterial(scene, lambert("ground", glm::vec3(0.7f)))}});
    addNode(scene, "plate", glm::dmat4(1.0), {{addMesh(scene, "plate", std::move(plate)), painted}});
    addNode(scene, "disk", worldFromLookAt(kTruthDiskWS, kTruthDiskWS + kTruthSunTravelWS),
            {{addMesh(scene, "disk", disk(kTruthDiskRadiusMetres)), painted}});
    addPointLight(scene, "lamp", kTruthLampWS, {1.0f, 0.82f, 0.62f}, 3.0f);
    scene.lights.back().rangeMetres = 4.0f;
    scene.lights.back().radiusMetres = float(kTruthLampRadiusMetres);
    addDirectionalLight(scene, "sun", kTruthSunTravelWS, {0.75f, 0.87f, 1.0f}, 0.45f);
    scene.lights.back().angularRadiusRadians = float(glm::radians(kTruthSunAngularRadiusDegrees));
    for (Light& light : scene.lights) light.castsShadow = true;
    keepFirstLights(scene, options);
    addCamera(scene, "front", {0.4, 2.4, 6.6}, {-0.1, 0.35, 0.0}, 46.0);
    return scene;
}

} // namespace tessera::scenes::builtin
