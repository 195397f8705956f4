#pragma once
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/image/PlaneUnderSky.h"

/// Shared materials, scenes and fixtures of transmission tests.
namespace tessera::test {

inline constexpr double kGlassRounding = 2e-6; ///< relative error of a few fp32 operations

inline scenes::Material clearGlass() {
    scenes::Material glass;
    glass.name = "clear glass";
    glass.metallic = 0.0f;
    glass.perceptualRoughness = 0.0f;
    glass.transmission = 1.0f;
    return glass;
}

/// Glass without reflection.
inline scenes::Material bareGlass(double ior, double roughness = 0.0) {
    scenes::Material glass = clearGlass();
    glass.specularFactor = 0.0f;
    glass.ior = float(ior);
    glass.perceptualRoughness = float(roughness);
    glass.thicknessMetres = 0.1f;
    return glass;
}

/// Planes of glass; the image of kSteepGlass reaches grazing angles.
inline constexpr int kGlassPixels = 48;
inline constexpr TiltedPlane kTiltedGlass{0.6, 90.0, 1.6, kGlassPixels}, kSteepGlass{1.0, 90.0, 1.6, kGlassPixels};

/// A sky radiance that is smooth in all directions.
inline double smoothSky(int x, int y) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    return 1.0 + 0.5 * std::sin(3.0 * kTurn * (x + 0.5) / kSkyWidth) * std::sin(0.5 * kTurn * (y + 0.5) / kSkyHeight) +
           0.4 * std::cos(2.0 * kTurn * (y + 0.5) / kSkyHeight);
}

inline scenes::Scene glassUnderSky(const scenes::Material& glass, const TiltedPlane& plane = kTiltedGlass) {
    scenes::Scene scene = plane.sceneOf(glass);
    scene.environment = skyOf(smoothSky);
    return scene;
}

/// Refracts by Snell's law with angles; none at total internal reflection. An index of 0 stands for an infinite one.
inline std::optional<glm::dvec3> bentDirection(const glm::dvec3& toViewer, double ior,
                                               const glm::dvec3& normal = kTiltedGlass.normal()) {
    if (ior == 0.0) return -normal;
    const double angle = std::acos(glm::dot(normal, toViewer)), bentSine = std::sin(angle) / ior;
    if (bentSine > 1.0) return std::nullopt;
    const glm::dvec3 along = glm::normalize(toViewer - std::cos(angle) * normal);
    return -std::cos(std::asin(bentSine)) * normal - bentSine * along;
}

/// A volume and a thin sheet of glass in front of a surface, lit by a point light.
inline scenes::Scene fewWithGlass() {
    scenes::Material matte;
    matte.metallic = 0.0f;
    matte.baseColor = {0.6f, 0.4f, 0.2f, 1.0f};
    scenes::Scene scene = quadScene(matte);
    scene.lights = {pointLight({0.3, 0.4, 2.0}, 9.0f)};
    scene.materials.push_back(bareGlass(1.5, 0.2));
    scene.materials.back().attenuationDistanceMetres = 0.2f;
    scene.materials.back().attenuationColor = {0.9f, 0.4f, 0.2f};
    scene.materials.back().dispersion = 1.0f;
    scene.materials.push_back(clearGlass());
    scene.materials.back().perceptualRoughness = 0.4f;
    for (const int material : {1, 2}) {
        scenes::Node& node = scene.nodes.emplace_back(scene.nodes[0]);
        node.instances[0].material = material;
        node.parentFromNode[0] *= 0.4;
        node.parentFromNode[1] *= 0.4;
        node.parentFromNode[3] = {0.6 * material - 0.9, 0.1 * material, 0.5 * material, 1.0};
    }
    return scene;
}

class GlassTest : public EnvironmentTest {
protected:
    static frame::FrameSettings ofSide(int side, frame::EnvironmentLight light = frame::EnvironmentLight::SplitSum) {
        frame::FrameSettings settings = ofSize(side, side);
        settings.environment.light = light;
        settings.environment.samples = 16;
        return settings;
    }
};

} // namespace tessera::test
