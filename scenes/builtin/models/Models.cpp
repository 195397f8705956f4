#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/models/Materials.h"

namespace tessera::scenes::builtin {
namespace {

constexpr double kPieceRadiusMetres = 0.5;
constexpr double kPieceSpacingMetres = 1.3;
constexpr double kStepMetres = 0.55; ///< height of a step
constexpr double kDepthMetres = 1.35;
constexpr int kPieces = 5; ///< per row
constexpr int kRows = 3;

/// A low foot that the spheres rest on.
Mesh footMesh() {
    Profile profile({0.30, 0.0});
    profile.lineTo({0.30, 0.03}).arcAround({0.27, 0.03}, 0.5 * std::numbers::pi, 6).lineTo({0.16, 0.06});
    Mesh mesh;
    appendLathe(mesh, profile, 48);
    return mesh;
}

/// A disc of lathed metal: texture and tangent run around the centre.
Mesh discMesh() {
    Mesh mesh;
    appendPatch(mesh, 64, 12, [](double u, double v) {
        const double angle = 2.0 * std::numbers::pi * u;
        const double radius = kPieceRadiusMetres * (0.03 + 0.97 * v);
        return SurfacePoint{{radius * std::cos(angle), radius * std::sin(angle), 0.0}, {0.0, 0.0, 1.0}, {u, 1.0 - v}};
    });
    return mesh;
}

/// The cap of a sphere, facing +z, all of which is visible from in front. It is for the material whose
/// masking-shadowing is divided by n.v, for which fp32 is too coarse at a sphere's silhouette.
Mesh capMesh() {
    constexpr double kHalfAngleRadians = 0.75;
    const double sphereRadiusMetres = kPieceRadiusMetres / std::sin(kHalfAngleRadians);
    Mesh mesh;
    appendPatch(mesh, 64, 16, [&](double u, double v) {
        const double around = 2.0 * std::numbers::pi * u;
        const double away = kHalfAngleRadians * (1.0 - v); // from the axis, which is +z
        const glm::dvec3 normal(std::sin(away) * std::cos(around), std::sin(away) * std::sin(around), std::cos(away));
        return SurfacePoint{
            sphereRadiusMetres * (normal - glm::dvec3(0.0, 0.0, std::cos(kHalfAngleRadians))), normal, {u, v}};
    });
    return mesh;
}

void addStage(Scene& scene) {
    const double halfWidth = 0.5 * kPieceSpacingMetres * kPieces + 0.3;
    const int stone = addMaterial(scene, metallicRoughness("steps", glm::vec3(0.055f, 0.055f, 0.06f), 0.0f, 0.42f));
    for (int row = 0; row < kRows; ++row) {
        Mesh step;
        const double front = 0.5 * kDepthMetres - kDepthMetres * row;
        appendBox(step, {-halfWidth, row == 0 ? -0.25 : kStepMetres * (row - 1), front - kDepthMetres},
                  {halfWidth, kStepMetres * row, front});
        addNode(scene, "step " + std::to_string(row), glm::dmat4(1.0),
                {{addMesh(scene, "step " + std::to_string(row), std::move(step)), stone}});
    }
    Mesh floor;
    appendFloor(floor, {0.0, -0.25, 0.0}, {40.0, 40.0}, {20, 20});
    addNode(scene, "floor", glm::dmat4(1.0),
            {{addMesh(scene, "floor", std::move(floor)),
              addMaterial(scene, lambert("lambert, floor", glm::vec3(0.012f, 0.013f, 0.016f)))}});
    Mesh wall;
    appendQuad(wall, {-20.0, -0.25, -4.4}, {20.0, -0.25, -4.4}, {20.0, 9.0, -4.4}, {-20.0, 9.0, -4.4});
    addNode(scene, "wall", glm::dmat4(1.0),
            {{addMesh(scene, "wall", std::move(wall)),
              addMaterial(scene, microfacet("microfacet, wall", glm::vec3(0.030f, 0.034f, 0.045f), 1.4f, 0.6f))}});
}

void addPieces(Scene& scene, const models::Exhibits& exhibits) {
    Mesh sphere;
    appendSphere(sphere, glm::dvec3(0.0), kPieceRadiusMetres, 56, 36);
    const int sphereMesh = addMesh(scene, "sphere", std::move(sphere));
    const int disc = addMesh(scene, "disc", discMesh());
    const int cap = addMesh(scene, "cap", capMesh());
    const int foot = addMesh(scene, "foot", footMesh());
    const int brass = addMaterial(scene, metallicRoughness("feet", {0.75f, 0.58f, 0.30f}, 1.0f, 0.35f));
    const std::vector<int>* const rows[kRows] = {&exhibits.teaching, &exhibits.directional, &exhibits.layered};
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kPieces; ++column) {
            const int material = (*rows[row])[static_cast<std::size_t>(column)];
            const std::string& name = scene.materials[static_cast<std::size_t>(material)].name;
            const glm::dvec3 standWS(kPieceSpacingMetres * (column - 0.5 * (kPieces - 1)), kStepMetres * row,
                                     -kDepthMetres * row);
            addNode(scene, "foot of " + name, glm::translate(glm::dmat4(1.0), standWS), {{foot, brass}});
            glm::dmat4 place =
                glm::translate(glm::dmat4(1.0), standWS + glm::dvec3(0.0, 0.04 + kPieceRadiusMetres, 0.0));
            int mesh = sphereMesh;
            if (row == 0 && column == 4) {
                mesh = cap;
                place = glm::rotate(place, -0.33, glm::dvec3(0.0, 1.0, 0.0));
                place = glm::rotate(place, -0.20, glm::dvec3(1.0, 0.0, 0.0));
            } else if (row == 1 && column == 2) {
                mesh = disc;
                place = glm::rotate(place, -0.30, glm::dvec3(1.0, 0.0, 0.0));
            }
            addNode(scene, name, place, {{mesh, material}});
        }
    }
}

void addSpot(Scene& scene, const std::string& name, const glm::dvec3& positionWS, const glm::dvec3& targetWS,
             const glm::vec3& color, float candela) {
    addPointLight(scene, name, positionWS, color, candela);
    Light& light = scene.lights.back();
    light.type = LightType::Spot;
    light.directionWS = glm::normalize(targetWS - positionWS);
    light.innerConeRadians = 0.25f;
    light.outerConeRadians = 0.65f;
}

void addSpotsAndLamps(Scene& scene) {
    addSpot(scene, "key", {-5.0, 6.0, 5.5}, {-0.3, 0.6, -1.2}, {1.0f, 0.93f, 0.82f}, 120.0f);
    addSpot(scene, "fill", {6.0, 4.0, 5.0}, {0.4, 0.6, -1.2}, {0.62f, 0.78f, 1.0f}, 55.0f);
    // Two rows of lamps imitate long windows, which polished surfaces reflect.
    for (int i = 0; i < 4; ++i) {
        const double x = 2.4 * (i - 1.5);
        addPointLight(scene, "lamp above " + std::to_string(i), {x, 5.2, 0.4}, {1.0f, 0.97f, 0.92f}, 5.0f);
        addPointLight(scene, "lamp behind " + std::to_string(i), {x, 4.2, -4.0}, {0.85f, 0.92f, 1.0f}, 9.0f);
    }
    Light wash;
    wash.name = "wash";
    wash.positionWS = {0.0, 0.5, 3.2};
    wash.color = {1.0f, 0.62f, 0.35f};
    wash.intensity = 1.2f;
    wash.falloff = Falloff::Attenuation;
    wash.attenuation = {0.5f, 0.2f, 0.6f};
    scene.lights.push_back(wash);
    addDirectionalLight(scene, "sky", {0.15, -1.0, -0.55}, {0.80f, 0.88f, 1.0f}, 0.5f);
}

} // namespace

Scene makeModels(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "models";
    scene.background = {0.004f, 0.005f, 0.007f};
    const models::Exhibits exhibits = models::addExhibits(scene);
    addStage(scene);
    addPieces(scene, exhibits);
    addSpotsAndLamps(scene);
    keepFirstLights(scene, options);
    addCamera(scene, "front", {0.0, 2.75, 7.6}, {0.0, 0.98, -1.0}, 29.0);
    addCamera(scene, "gloss with a direction", {-1.6, 1.9, 2.2}, {0.1, 0.95, -1.4}, 42.0);
    addCamera(scene, "layers", {0.9, 2.25, 0.9}, {0.15, 1.42, -2.7}, 44.0);
    scene.options.requested["toneMap"] = std::string("khronos_neutral");
    return scene;
}

} // namespace tessera::scenes::builtin
