#pragma once
#include <string>
#include <vector>

#include "scenes/AreaLight.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/Scene.h"

/// Shorthand functions for defining the built-in scenes.
namespace tessera::scenes::builtin {

inline int addImage(Scene& scene, Image image) {
    scene.images.push_back(std::move(image));
    return static_cast<int>(scene.images.size()) - 1;
}

inline int addMaterial(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return static_cast<int>(scene.materials.size()) - 1;
}

inline int addMesh(Scene& scene, const std::string& name, Mesh mesh) {
    mesh.name = name;
    scene.meshes.push_back(std::move(mesh));
    return static_cast<int>(scene.meshes.size()) - 1;
}

inline void addNode(Scene& scene, const std::string& name, const glm::dmat4& worldFromNode,
                    std::vector<MeshInstance> instances) {
    Node node;
    node.name = name;
    node.parentFromNode = worldFromNode;
    node.instances = std::move(instances);
    scene.nodes.push_back(std::move(node));
}

inline void addCamera(Scene& scene, const std::string& name, const glm::dvec3& eyeWS, const glm::dvec3& targetWS,
                      double fovYDegrees) {
    Camera camera;
    camera.name = name;
    camera.worldFromCamera = worldFromLookAt(eyeWS, targetWS);
    camera.fovYRadians = glm::radians(fovYDegrees);
    scene.cameras.push_back(camera);
}

inline Material metallicRoughness(const std::string& name, const glm::vec3& baseColor, float metallic,
                                  float perceptualRoughness) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(baseColor, 1.0f);
    material.metallic = metallic;
    material.perceptualRoughness = perceptualRoughness;
    return material;
}

inline Material lambert(const std::string& name, const glm::vec3& diffuse) {
    Material material;
    material.name = name;
    material.model = MaterialModel::Lambert;
    material.baseColor = glm::vec4(diffuse, 1.0f);
    return material;
}

inline Material microfacet(const std::string& name, const glm::vec3& diffuse, float ior, float alpha) {
    Material material;
    material.name = name;
    material.model = MaterialModel::Microfacet;
    material.baseColor = glm::vec4(diffuse, 1.0f);
    material.ior = ior;
    material.alpha = alpha;
    return material;
}

inline void addPointLight(Scene& scene, const std::string& name, const glm::dvec3& positionWS, const glm::vec3& color,
                          float candela) {
    Light light;
    light.name = name;
    light.positionWS = positionWS;
    light.color = color;
    light.intensity = candela;
    scene.lights.push_back(std::move(light));
}

inline void addDirectionalLight(Scene& scene, const std::string& name, const glm::dvec3& directionWS,
                                const glm::vec3& color, float lux) {
    Light light;
    light.name = name;
    light.type = LightType::Directional;
    light.directionWS = glm::normalize(directionWS);
    light.color = color;
    light.intensity = lux;
    scene.lights.push_back(std::move(light));
}

/// Adds an area light that faces a target. The reference is valid until the next light is added.
inline Light& addAreaLight(Scene& scene, const std::string& name, LightType type, const glm::dvec3& positionWS,
                           const glm::dvec3& targetWS, const glm::vec3& color, float radiance) {
    Light& light = scene.lights.emplace_back();
    light.name = name;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = glm::normalize(targetWS - positionWS);
    light.alongWS = usualAlong(light.directionWS);
    light.color = color;
    light.intensity = radiance;
    return light;
}

/// Keeps the first `options.lights` of a scene's few placed lights.
inline void keepFirstLights(Scene& scene, const LoadOptions& options) {
    if (options.lights && static_cast<std::size_t>(*options.lights) < scene.lights.size()) {
        scene.lights.resize(static_cast<std::size_t>(*options.lights));
    }
}

} // namespace tessera::scenes::builtin
