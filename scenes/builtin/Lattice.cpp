#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/Random.h"
#include "scenes/builtin/Shapes.h"

/// Every number here is part of the definition of the benchmark "lattice", version 1, which compares different
/// programs.
namespace tessera::scenes::builtin {
namespace {

constexpr int kGridSide = 16;
constexpr double kSpacingMetres = 1.25;
constexpr double kFloorMetres = 20.0;
constexpr int kFloorQuads = 32;
constexpr double kSphereRadiusMetres = 0.45;
constexpr double kBoxHalfMetres = 0.35;
constexpr int kFloorMaterial = 8;
constexpr int kDefaultLatticeLights = 256;
constexpr float kLightRangeMetres = 2.5f;
constexpr std::uint32_t kLightSeed = 12345;

void addMaterials(Scene& scene) {
    struct Row {
        glm::vec3 baseColor;
        float metallic;
        float perceptualRoughness;
    };
    static constexpr std::array<Row, 9> kRows = {{{{0.8f, 0.8f, 0.8f}, 0.0f, 0.15f},
                                                  {{0.8f, 0.2f, 0.2f}, 0.0f, 0.3f},
                                                  {{0.2f, 0.8f, 0.2f}, 0.0f, 0.5f},
                                                  {{0.2f, 0.3f, 0.8f}, 0.0f, 0.8f},
                                                  {{0.9f, 0.9f, 0.9f}, 1.0f, 0.15f},
                                                  {{1.0f, 0.8f, 0.3f}, 1.0f, 0.3f},
                                                  {{0.9f, 0.5f, 0.4f}, 1.0f, 0.5f},
                                                  {{0.8f, 0.8f, 0.9f}, 1.0f, 0.8f},
                                                  {{0.5f, 0.5f, 0.5f}, 0.0f, 0.6f}}};
    for (const Row& row : kRows) {
        const std::string name = "material " + std::to_string(scene.materials.size());
        addMaterial(scene, metallicRoughness(name, row.baseColor, row.metallic, row.perceptualRoughness));
    }
}

void addSolids(Scene& scene) {
    Mesh sphere;
    appendSphere(sphere, glm::dvec3(0.0), kSphereRadiusMetres, 32, 24);
    Mesh box;
    appendBox(box, glm::dvec3(-kBoxHalfMetres), glm::dvec3(kBoxHalfMetres));
    Mesh floor;
    appendFloor(floor, glm::dvec3(0.0), glm::dvec2(kFloorMetres), glm::ivec2(kFloorQuads));
    const int sphereMesh = addMesh(scene, "sphere", std::move(sphere));
    const int boxMesh = addMesh(scene, "box", std::move(box));
    addNode(scene, "floor", glm::dmat4(1.0), {{addMesh(scene, "floor", std::move(floor)), kFloorMaterial}});
    for (int j = 0; j < kGridSide; ++j) {
        for (int i = 0; i < kGridSide; ++i) {
            const bool isSphere = (i + j) % 2 == 0;
            const glm::dvec3 centerWS((i + 0.5) * kSpacingMetres - 10.0,
                                      isSphere ? kSphereRadiusMetres : kBoxHalfMetres,
                                      (j + 0.5) * kSpacingMetres - 10.0);
            addNode(scene, (isSphere ? "sphere " : "box ") + std::to_string(i) + " " + std::to_string(j),
                    glm::translate(glm::dmat4(1.0), centerWS), {{isSphere ? sphereMesh : boxMesh, (i + 2 * j) % 8}});
        }
    }
}

/// Intensity of each of `count` lights: interpolated linearly in log-log between the specified counts.
double intensityCandela(int count) {
    struct Point {
        double lights;
        double candela;
    };
    static constexpr std::array<Point, 4> kPoints = {{{16.0, 6.0}, {64.0, 3.0}, {256.0, 1.0}, {1024.0, 0.3}}};
    if (count < kPoints.front().lights) return kPoints.front().candela;
    for (std::size_t i = 0; i + 1 < kPoints.size(); ++i) {
        const Point& a = kPoints[i];
        const Point& b = kPoints[i + 1];
        if (count >= b.lights) continue;
        return a.candela * std::pow(b.candela / a.candela, std::log(count / a.lights) / std::log(b.lights / a.lights));
    }
    return kPoints.back().candela * kPoints.back().lights / count;
}

void addLights(Scene& scene, int count) {
    Random random(kLightSeed);
    for (int n = 0; n < count; ++n) {
        Light light;
        light.name = "light " + std::to_string(n);
        const auto x = static_cast<float>(-10.0 + 20.0 * random.unit());
        const auto y = static_cast<float>(1.0 + 1.2 * random.unit());
        const auto z = static_cast<float>(-10.0 + 20.0 * random.unit());
        const double hue = random.unit();
        light.positionWS = {x, y, z};
        for (glm::length_t k = 0; k < 3; ++k) {
            const double wave = std::cos(2.0 * std::numbers::pi * (hue + static_cast<double>(k) / 3.0));
            light.color[k] = static_cast<float>(0.25 + 0.75 * (0.5 + 0.5 * wave));
        }
        light.intensity = static_cast<float>(intensityCandela(count));
        light.rangeMetres = kLightRangeMetres;
        scene.lights.push_back(std::move(light));
    }
}

} // namespace

Scene makeLattice(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "lattice";
    scene.options.requested["size"] = std::vector<double>{1280, 720};
    addMaterials(scene);
    addSolids(scene);
    addLights(scene, options.lights.value_or(kDefaultLatticeLights));
    addCamera(scene, "overview", {0.0, 7.0, 9.0}, {0.0, 0.0, -1.0}, 45.0);
    scene.cameras.back().nearMetres = 0.1;
    scene.cameras.back().farMetres = 100.0;
    return scene;
}

} // namespace tessera::scenes::builtin
