#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/glass/Glassware.h"

namespace tessera::scenes::builtin {
namespace {

glm::dmat4 onTable(double x, double z, double turnRadians = 0.0, double y = 0.0) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), {x, y, z}), turnRadians, glm::dvec3(0.0, 1.0, 0.0));
}

void addThing(Scene& scene, const std::string& name, Mesh mesh, const glm::dmat4& worldFromThing,
              const Material& material) {
    const int meshIndex = addMesh(scene, name, std::move(mesh));
    addNode(scene, name, worldFromThing, {{meshIndex, addMaterial(scene, material)}});
}

/// A thin wall without refraction; its colour tints transmitted light. If rough, it would hide other glass behind it.
Material sheetGlass(const std::string& name, const glm::vec3& color) {
    Material glass = metallicRoughness(name, color, 0.0f, 0.0f);
    glass.transmission = 1.0f;
    return glass;
}

/// A body in which white light becomes `color` after `distanceMetres`.
Material bodyGlass(const std::string& name, float thicknessMetres, const glm::vec3& color, float distanceMetres,
                   float perceptualRoughness = 0.12f) {
    Material glass = metallicRoughness(name, glm::vec3(1.0f), 0.0f, perceptualRoughness);
    glass.transmission = 1.0f;
    glass.thicknessMetres = thicknessMetres;
    glass.attenuationColor = color;
    glass.attenuationDistanceMetres = distanceMetres;
    return glass;
}

void addBodies(Scene& scene) {
    addThing(scene, "wine bottle", glass::wineBottle(), onTable(0.10, -0.17),
             bodyGlass("green glass", 0.06f, {0.16f, 0.55f, 0.22f}, 0.05f));
    addThing(scene, "pot bottle", glass::potBottle(), onTable(0.29, -0.06),
             bodyGlass("amber glass", 0.09f, {0.80f, 0.36f, 0.06f}, 0.07f));
    addThing(scene, "vase", glass::vase(), onTable(0.47, -0.20),
             bodyGlass("frosted glass", 0.03f, {0.70f, 0.85f, 0.90f}, 0.03f, 0.5f));
    // Its end faces the front camera, so that both slopes are visible and one reflects a lamp of the studio.
    addThing(scene, "prism", glass::prism(), onTable(-0.37, -0.08, -1.2),
             bodyGlass("flint glass", 0.06f, {0.95f, 0.97f, 0.98f}, 0.1f));
    scene.materials.back().ior = 1.62f;
    addThing(scene, "crystal ball", glass::crystalBall(), onTable(0.42, 0.17),
             bodyGlass("crystal", 0.1f, {0.96f, 0.97f, 1.0f}, 0.1f));
    addThing(scene, "crystal foot", glass::crystalFoot(), onTable(0.42, 0.17),
             metallicRoughness("brass", {0.78f, 0.57f, 0.27f}, 1.0f, 0.25f));
}

void addSheets(Scene& scene) {
    const int tumbler = addMesh(scene, "tumbler", glass::tumbler());
    const auto addTumbler = [&](const std::string& name, const glm::vec3& color, double x, double z) {
        addNode(scene, name, onTable(x, z), {{tumbler, addMaterial(scene, sheetGlass(name, color))}});
    };
    addTumbler("clear tumbler", {0.97f, 0.98f, 0.97f}, -0.14, 0.12);
    addTumbler("blue tumbler", {0.45f, 0.66f, 0.95f}, 0.02, 0.19);
    addTumbler("rose tumbler", {0.95f, 0.52f, 0.60f}, 0.17, 0.14);

    // Each absorbs one primary colour: two of them transmit the third alone.
    const int pane = addMesh(scene, "pane", glass::pane()), holder = addMesh(scene, "holder", glass::paneHolder());
    const int steel = addMaterial(scene, metallicRoughness("steel", {0.62f, 0.63f, 0.65f}, 1.0f, 0.3f));
    const auto addPane = [&](const std::string& name, const glm::vec3& color, double x, double z) {
        Material filter = sheetGlass(name, color);
        filter.doubleSided = true;
        addNode(scene, name, onTable(x, z, 0.12, glass::kHolderMetres), {{pane, addMaterial(scene, filter)}});
        addNode(scene, name + " holder", onTable(x, z, 0.12), {{holder, steel}});
    };
    addPane("yellow pane", {0.95f, 0.88f, 0.06f}, -0.50, -0.30);
    addPane("magenta pane", {0.88f, 0.07f, 0.72f}, -0.38, -0.25);
    addPane("cyan pane", {0.05f, 0.74f, 0.90f}, -0.27, -0.20);
}

void addTableLights(Scene& scene) {
    constexpr glm::dvec3 kMiddleWS(0.0, 0.1, 0.0);
    Light& key = addAreaLight(scene, "key", LightType::Disk, {-0.8, 1.3, 0.9}, kMiddleWS, {1.0f, 0.95f, 0.88f}, 16.0f);
    key.radiusMetres = 0.28f;
    key.castsShadow = true;
    Light& box = addAreaLight(scene, "light box", LightType::Rectangle, {-0.40, 0.20, -0.46}, {-0.40, 0.20, 1.0},
                              {1.0f, 0.98f, 0.95f}, 2.2f);
    box.widthMetres = 0.5f;
    box.heightMetres = 0.36f;
    constexpr glm::dvec3 kStripWS(0.64, 0.30, -0.12);
    Light& strip = addAreaLight(scene, "strip", LightType::Tube, kStripWS, kStripWS + glm::dvec3(0.0, 1.0, 0.0),
                                {1.0f, 0.80f, 0.58f}, 14.0f);
    strip.radiusMetres = 0.010f;
    strip.lengthMetres = 0.54f;
    addThing(scene, "lamp stand", glass::lampStand(), onTable(kStripWS.x, kStripWS.z),
             metallicRoughness("black lacquer", {0.02f, 0.02f, 0.022f}, 0.0f, 0.3f));
}

} // namespace

Scene makeGlass(const LoadOptions& options, LoadLedger& ledger) {
    Scene scene;
    scene.name = "glass";
    scene.background = {0.05f, 0.05f, 0.055f};
    addThing(scene, "table", glass::tableTop(), glm::dmat4(1.0),
             metallicRoughness("oiled walnut", {0.105f, 0.060f, 0.036f}, 0.0f, 0.38f));
    addThing(scene, "orange", glass::fruit(), onTable(-0.222, 0.16),
             metallicRoughness("orange peel", {0.86f, 0.33f, 0.03f}, 0.0f, 0.5f));
    addBodies(scene);
    addSheets(scene);
    addTableLights(scene);
    keepFirstLights(scene, options);
    // The bodies refract the studio. It is rotated so that its strips lie just outside the front camera's view.
    scene.environment = loadEnvironment(std::string(kBuiltinPrefix) + "studio", ledger, scene.warnings);
    scene.environment->rotationDegrees = -58.0f;
    addCamera(scene, "front", {0.02, 0.42, 1.28}, {0.0, 0.11, -0.05}, 31.0);
    addCamera(scene, "panes", {-0.22, 0.24, 0.62}, {-0.34, 0.11, -0.25}, 42.0);
    scene.options.requested["toneMap"] = std::string("khronos_neutral");
    return scene;
}

} // namespace tessera::scenes::builtin
