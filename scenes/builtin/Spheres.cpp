#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/Shapes.h"

namespace tessera::scenes::builtin {
namespace {

constexpr int kRoughnessSteps = 11;
constexpr int kMetalnessSteps = 5;
constexpr double kRadiusMetres = 0.42;
constexpr double kSphereSpacingMetres = 1.0;

/// Spheres in rising rows, the dielectric ones in front, so that none occludes another.
void addSpheres(Scene& scene) {
    Mesh sphere;
    appendSphere(sphere, glm::dvec3(0.0), kRadiusMetres, 64, 40);
    const int mesh = addMesh(scene, "sphere", std::move(sphere));
    Mesh step;
    const double halfWidth = 0.5 * kSphereSpacingMetres * kRoughnessSteps + 0.1;
    appendBox(step, {-halfWidth, -1.0, -0.5 * kSphereSpacingMetres}, {halfWidth, 0.0, 0.5 * kSphereSpacingMetres});
    const int stepMesh = addMesh(scene, "step", std::move(step));
    const int stepMaterial = addMaterial(scene, metallicRoughness("step", glm::vec3(0.09f, 0.09f, 0.1f), 0.0f, 0.55f));
    for (int row = 0; row < kMetalnessSteps; ++row) {
        const double stepY = 0.32 * row;
        const double z = -kSphereSpacingMetres * row;
        addNode(scene, "step " + std::to_string(row), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, stepY, z)),
                {{stepMesh, stepMaterial}});
        for (int column = 0; column < kRoughnessSteps; ++column) {
            const float metallic = static_cast<float>(row) / (kMetalnessSteps - 1);
            const float roughness = static_cast<float>(column) / (kRoughnessSteps - 1);
            const std::string name = "metalness " + std::to_string(row) + "/" + std::to_string(kMetalnessSteps - 1) +
                                     ", roughness " + std::to_string(column) + "/" +
                                     std::to_string(kRoughnessSteps - 1);
            const int material =
                addMaterial(scene, metallicRoughness(name, glm::vec3(0.86f, 0.42f, 0.2f), metallic, roughness));
            const glm::dvec3 centerWS(kSphereSpacingMetres * (column - 0.5 * (kRoughnessSteps - 1)),
                                      stepY + kRadiusMetres, z);
            addNode(scene, name, glm::translate(glm::dmat4(1.0), centerWS), {{mesh, material}});
        }
    }
}

} // namespace

Scene makeSpheres(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "spheres";
    scene.background = {0.03f, 0.034f, 0.042f};
    addSpheres(scene);
    Mesh floor;
    appendFloor(floor, {0.0, -0.05, -2.0}, {60.0, 60.0}, {30, 30});
    addNode(scene, "floor", glm::dmat4(1.0),
            {{addMesh(scene, "floor", std::move(floor)),
              addMaterial(scene, metallicRoughness("floor", glm::vec3(0.32f, 0.33f, 0.36f), 0.0f, 0.5f))}});

    addPointLight(scene, "key", {-4.5, 6.0, 3.5}, {1.0f, 0.93f, 0.84f}, 110.0f);
    addPointLight(scene, "fill", {5.5, 4.0, 4.0}, {0.55f, 0.72f, 1.0f}, 45.0f);
    addPointLight(scene, "rim", {3.0, 5.0, -8.5}, {1.0f, 0.62f, 0.4f}, 90.0f);
    addDirectionalLight(scene, "sky", {0.2, -1.0, -0.35}, {0.85f, 0.92f, 1.0f}, 0.6f);
    keepFirstLights(scene, options);

    addCamera(scene, "front", {0.0, 4.7, 9.2}, {0.0, 0.6, -1.9}, 40.0);
    addCamera(scene, "mirror row", {-6.2, 2.6, 3.2}, {-2.0, 0.8, -2.4}, 45.0);
    return scene;
}

} // namespace tessera::scenes::builtin
