#pragma once
#include "scenes/AreaLight.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/support/AreaLights.h"

/// Lights, materials and fixtures of area light tests.
namespace tessera::test {

/// An area light 1 m wide and high, or of radius 0.3 m, with a horizontal width axis. A polygon is a square.
inline scenes::Light areaLight(scenes::LightType type, const glm::dvec3& positionWS, const glm::dvec3& directionWS,
                               float radiance) {
    scenes::Light light;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = glm::normalize(directionWS);
    light.alongWS = scenes::usualAlong(light.directionWS);
    light.radiusMetres = type == scenes::LightType::Rectangle ? 0.0f : 0.3f;
    light.intensity = radiance;
    return light;
}

/// Appends an area light of each type; the disk has a finite range and emits on both sides.
inline scenes::Scene withAreaLights(scenes::Scene scene) {
    double x = -1.5;
    for (const scenes::LightType type : kAreaTypes) {
        scenes::Light light = areaLight(type, {x, 1.0, 1.5}, {-0.3 * x, -0.5, -1.0}, 3.0f);
        light.rangeMetres = type == scenes::LightType::Disk ? 4.0f : scenes::kInfinity;
        light.isTwoSided = type == scenes::LightType::Disk;
        light.corners.metres[2] = {0.1f, -0.1f}; // a concave corner
        scene.lights.push_back(light);
        x += 1.0;
    }
    return scene;
}

/// A double-sided material of any metalness.
inline scenes::Material twoSidedMetal(double metallic, double perceptualRoughness) {
    scenes::Material metal = twoSided(metalOf(perceptualRoughness));
    metal.metallic = float(metallic);
    return metal;
}

/// A coat over a dielectric.
inline scenes::Material coatedSheet() {
    scenes::Material material = twoSidedMetal(0.0, 0.6);
    material.name = "coated sheet";
    material.clearcoat = 1.0f;
    material.clearcoatPerceptualRoughness = 0.3f;
    return material;
}

inline scenes::Material velvet() {
    scenes::Material material = twoSidedMetal(0.0, 1.0);
    material.name = "velvet";
    material.baseColor = glm::vec4(glm::vec3(0.2f), 1.0f);
    material.sheenColor = glm::vec3(0.8f);
    material.sheenPerceptualRoughness = 0.5f;
    return material;
}

/// A floor in z = 0 and, halfway to a light 1 m above it, a plate that occludes everything beyond x = edgeX. The camera
/// looks down from below the plate.
inline scenes::Scene floorUnderAPlate(const scenes::Light& light, double edgeX, double halfHeightMetres) {
    scenes::Scene scene = quadScene(twoSided(lambert()));
    scenes::Node& plate = scene.nodes.emplace_back();
    plate.parentFromNode[3] = glm::dvec4(edgeX + 1.0, 0.0, 0.5, 1.0);
    plate.instances = {{0, 0}};
    scene.lights = {light};
    makeOrthographic(scene.cameras[0], halfHeightMetres);
    scene.cameras[0].nearMetres = 0.0;
    scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({0.0, 0.0, 0.3}, {0.0, 0.0, 0.0});
    return scene;
}

/// Measures the radiance at the centre of a 2 x 2 m quad in z = 0, viewed from `toViewer`; the lights are invisible.
class MiddleOfQuadTest : public EnvironmentTest {
protected:
    double seen(const scenes::Material& material, const std::vector<scenes::Light>& lights,
                const glm::dvec3& toViewer = {0.0, 0.0, 1.0},
                const std::optional<scenes::Environment>& environment = {}) {
        // Reuses the renderer: creating one takes longer than drawing this image.
        if (!renderer_ || scene_.materials[0] != material || toViewer_ != toViewer || environment ||
            scene_.environment) {
            renderer_.reset();
            scene_ = quadScene(material);
            scene_.environment = environment;
            toViewer_ = toViewer;
            makeOrthographic(scene_.cameras[0], 1e-4);
            scene_.cameras[0].worldFromCamera =
                scenes::worldFromLookAt(3.0 * glm::normalize(toViewer), glm::dvec3(0.0));
            renderer_.emplace(context(), scene_);
        }
        scene_.lights = lights;
        for (scenes::Light& light : scene_.lights) light.isSeen = false;
        return double(renderer_->render(engine::Technique::Deferred, ofSize(3, 3)).radiance[4 * 4]);
    }
    /// k_d 1 without 1/pi: the radiance equals the irradiance.
    static scenes::Material matte() { return twoSided(lambert()); }

private:
    glm::dvec3 toViewer_{0.0};
    scenes::Scene scene_;
    std::optional<engine::Renderer> renderer_;
};

} // namespace tessera::test
