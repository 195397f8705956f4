#include "tests/support/CullingScenes.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Shapes.h"
#include "tests/support/Random.h"
#include "tests/support/TestScenes.h"

namespace tessera::test {

namespace {

using namespace scenes;

void addMaterial(Scene& scene, const glm::vec3& color, float opacity) {
    Material material;
    material.name = "material " + std::to_string(scene.materials.size());
    material.baseColor = glm::vec4(color, opacity);
    material.alphaMode = opacity < 1.0f ? AlphaMode::Blend : AlphaMode::Opaque;
    material.doubleSided = true;
    scene.materials.push_back(material);
}

void addNode(Scene& scene, Mesh mesh, int material, const glm::dmat4& worldFromNode) {
    Node node;
    node.name = "node " + std::to_string(scene.nodes.size());
    node.parentFromNode = worldFromNode;
    node.instances.push_back({int(scene.meshes.size()), material});
    mesh.name = "mesh " + std::to_string(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(std::move(node));
}

glm::dmat4 lookingAt(const glm::dvec3& eyeWS, const glm::dvec3& targetWS) {
    const glm::dvec3 forward = glm::normalize(targetWS - eyeWS);
    const glm::dvec3 up = std::abs(forward.y) > 0.99 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::inverse(glm::lookAt(eyeWS, targetWS, up));
}

Camera randomCamera(Random& random) {
    Camera camera;
    camera.name = "camera";
    const glm::dvec3 eyeWS = random.direction() * random.logarithmic(0.3, 12.0) + glm::dvec3(0.0, 1.0, 0.0);
    camera.worldFromCamera = lookingAt(eyeWS, random.direction() * random.between(0.0, 2.0));
    camera.fovYRadians = random.between(5.0, 150.0) * pi / 180.0;
    camera.nearMetres = random.logarithmic(1e-3, 1.0);
    if (random.unit() < 0.5) camera.farMetres = camera.nearMetres + random.logarithmic(5.0, 1e4);
    if (random.unit() < 0.2) {
        camera.projection = Projection::Orthographic;
        camera.halfHeightMetres = random.logarithmic(0.5, 10.0);
    }
    return camera;
}

Light randomLight(Random& random, const glm::dvec3& eyeWS) {
    Light light;
    light.color = {float(random.unit()), float(random.unit()), float(0.1 + random.unit())};
    light.intensity = float(random.logarithmic(0.1, 100.0));
    light.positionWS = random.unit() < 0.15 ? eyeWS + random.direction() * random.logarithmic(1e-3, 1.0)
                                            : random.direction() * random.logarithmic(0.1, 12.0);
    light.directionWS = random.direction();
    light.rangeMetres = float(random.logarithmic(1e-3, 1e3));
    const double kind = random.unit();
    if (kind < 0.3) {
        light.type = LightType::Spot;
        light.outerConeRadians = float(random.logarithmic(0.1, 179.0) * pi / 180.0);
        light.innerConeRadians = light.outerConeRadians * float(random.unit());
    } else if (kind < 0.34) {
        light.type = LightType::Directional;
    } else if (kind < 0.38) {
        light.falloff = Falloff::Attenuation;
        light.attenuation = {0.1f, float(random.unit()), float(random.unit())};
    } else if (kind < 0.41) {
        light.rangeMetres = kInfinity;
    }
    return light;
}

} // namespace

Scene randomLitScene(std::uint64_t seed) {
    Random random(seed);
    Scene scene;
    scene.name = "random " + std::to_string(seed);
    addMaterial(scene, {0.7f, 0.6f, 0.5f}, 1.0f);
    addMaterial(scene, {0.3f, 0.7f, 0.8f}, 0.4f);
    Mesh floor;
    builtin::appendFloor(floor, glm::dvec3(0.0, -0.5, 0.0), glm::dvec2(20.0), glm::ivec2(4));
    addNode(scene, std::move(floor), 0, glm::dmat4(1.0));
    const int count = 4 + random.index(8);
    for (int i = 0; i < count; ++i) {
        const glm::dmat4 place = glm::translate(glm::dmat4(1.0), random.direction() * random.between(0.0, 5.0)) *
                                 glm::rotate(glm::dmat4(1.0), random.between(0.0, 2.0 * pi), random.direction());
        Mesh mesh;
        const double half = random.logarithmic(0.05, 1.5);
        if (i % 2 == 0)
            builtin::appendBox(mesh, glm::dvec3(-half), glm::dvec3(half));
        else
            builtin::appendQuad(mesh, {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0});
        addNode(scene, std::move(mesh), i % 3 == 1 ? 1 : 0, place);
    }
    scene.cameras.push_back(randomCamera(random));
    const glm::dvec3 eyeWS(scene.cameras[0].worldFromCamera[3]);
    const int lights = 1 + random.index(80);
    for (int i = 0; i < lights; ++i) scene.lights.push_back(randomLight(random, eyeWS));
    return scene;
}

Scene withEveryKindOfLight(Scene scene) {
    Light light = pointLight({0.0, 3.0, 0.0}, 1e-4f);
    scene.lights.push_back(light);
    light.falloff = Falloff::Attenuation;
    scene.lights.push_back(light);
    light.falloff = Falloff::InverseSquare;
    light.type = LightType::Spot;
    light.directionWS = glm::dvec3(0.0, -1.0, 0.0);
    light.outerConeRadians = 1.0f;
    scene.lights.push_back(light);
    light.type = LightType::Directional;
    scene.lights.push_back(light);
    return scene;
}

Camera seenFromAfar(Camera camera, double times) {
    const glm::dvec3 backWS(camera.worldFromCamera[2]);
    const double nearEyeMetres = std::max(1.0, glm::length(glm::dvec3(camera.worldFromCamera[3])));
    const double stepMetres = (times - 1.0) * nearEyeMetres;
    camera.worldFromCamera[3] += glm::dvec4(stepMetres * backWS, 0.0);
    camera.fovYRadians = 2.0 * std::atan(std::tan(0.5 * camera.fovYRadians) / times);
    camera.nearMetres += stepMetres;
    camera.farMetres += stepMetres;
    return camera;
}

Scene columnsBeforeWall(int lights) {
    Random random(7);
    Scene scene;
    scene.name = "columns before a wall";
    addMaterial(scene, {0.8f, 0.75f, 0.7f}, 1.0f);
    Mesh wall, columns, leaves;
    builtin::appendQuad(wall, {-40, -20, -40}, {40, -20, -40}, {40, 20, -40}, {-40, 20, -40});
    for (int i = 0; i < 12; ++i) {
        const double x = -5.5 + i;
        builtin::appendBox(columns, {x - 0.15, -6.0, -7.15}, {x + 0.15, 6.0, -6.85});
        builtin::appendBox(columns, {2.0 * x - 0.2, -12.0, -18.2}, {2.0 * x + 0.2, 12.0, -17.8});
    }
    for (int i = 0; i < 1500; ++i) {
        const glm::dvec3 c(random.between(-5.0, 5.0), random.between(-3.0, 3.0), random.between(-5.0, -4.0));
        const double r = 0.06;
        builtin::appendQuad(leaves, c + glm::dvec3(-r, -r, 0), c + glm::dvec3(r, -r, 0), c + glm::dvec3(r, r, 0),
                            c + glm::dvec3(-r, r, 0));
    }
    for (Mesh* mesh : {&wall, &columns, &leaves}) addNode(scene, std::move(*mesh), 0, glm::dmat4(1.0));
    for (int i = 0; i < lights; ++i) {
        const double ahead = random.between(3.0, 41.0);
        Light light =
            pointLight({random.between(-0.8, 0.8) * ahead, random.between(-0.45, 0.45) * ahead, -ahead}, 1.0f);
        light.rangeMetres = 2.0f;
        scene.lights.push_back(light);
    }
    Camera camera;
    camera.name = "front";
    scene.cameras.push_back(camera);
    return scene;
}

Scene litFromWithin(Scene scene, int lights, float rangeMetres) {
    const Box3 bounds = worldBounds(scene);
    const glm::dvec3 size = bounds.max - bounds.min;
    const glm::dvec3 share = size.x > size.z ? glm::dvec3(0.2, 0.3, 0.5) : glm::dvec3(0.5, 0.3, 0.2);
    const glm::dvec3 eyeWS = bounds.min + share * size;
    const glm::dvec3 centerWS = 0.5 * (bounds.min + bounds.max);
    Camera camera;
    camera.name = "within";
    camera.worldFromCamera = lookingAt(eyeWS, {centerWS.x, eyeWS.y, centerWS.z});
    scene.cameras = {camera};
    scene.lights.clear();
    Random random(11);
    for (int i = 0; i < lights; ++i) {
        const glm::dvec3 place(random.unit(), random.unit(), random.unit());
        scene.lights.push_back(pointLight(bounds.min + place * size, 5.0f));
        scene.lights.back().rangeMetres = rangeMetres;
    }
    return scene;
}

} // namespace tessera::test
