#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/HeadScan.h"
#include "scenes/builtin/Shapes.h"
#include "scenes/builtin/bust/Bust.h"

namespace tessera::scenes::builtin {
namespace {

/// Bottom of the bust above the floor, and its height; a scan is fitted to the same.
constexpr double kPlinthTopY = 0.12;
constexpr double kBustHeightMetres = 0.6;

/// Material and resolution of a bust.
struct BustKind {
    const char* material;
    BustPaint paint = BustPaint::WeatheredMarble;
    int columns = 168, rows = 112, mapTexels = 1024;
};

/// Adds the bust and returns its material.
int addBust(Scene& scene, const BustKind& kind) {
    Bust bust = makeBust(kind.columns, kind.rows, kBustHeightMetres, kind.mapTexels, kind.paint);
    Material skin = microfacet(kind.material, glm::vec3(1.0f), 1.4f, 0.35f);
    skin.normalMapSpace = NormalMapSpace::Object;
    skin.texture(TextureSlot::BaseColor).image = addImage(scene, std::move(bust.albedoMap));
    skin.texture(TextureSlot::Normal).image = addImage(scene, std::move(bust.normalMap));
    // The maps wrap around the bust but not from its crown to its bottom.
    skin.texture(TextureSlot::BaseColor).sampler.wrapV = Wrap::ClampToEdge;
    skin.texture(TextureSlot::Normal).sampler.wrapV = Wrap::ClampToEdge;
    const int mesh = addMesh(scene, "bust", std::move(bust.mesh));
    const int material = addMaterial(scene, skin);
    addNode(scene, "bust", glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, kPlinthTopY, 0.0)), {{mesh, material}});
    return material;
}

/// Adds the scan of TESSERA_ASSETS, in plain stone if the bust is of polished marble, or else the bust. Returns its
/// material.
int addHead(Scene& scene, const BustKind& kind, const LoadOptions& options, LoadLedger& ledger) {
    const std::optional<std::filesystem::path> scan = options.useAssets ? headScanFolder() : std::nullopt;
    if (!scan) return addBust(scene, kind);
    const bool isStone = kind.paint == BustPaint::PolishedMarble;
    return addHeadScan(scene, *scan, kPlinthTopY, kBustHeightMetres,
                       isStone ? ScanPaint(glm::vec3(kPolishedMarble)) : std::nullopt, ledger);
}

void addSurroundings(Scene& scene) {
    Mesh plinth;
    appendLathe(plinth,
                Profile({0.34, 0.0})
                    .lineTo({0.34, 0.03})
                    .curveThrough({{0.31, 0.045}, {0.3, 0.07}}, 6)
                    .curveThrough({{0.31, 0.095}, {0.33, 0.1}}, 6)
                    .lineTo({0.33, kPlinthTopY})
                    .lineTo({0.0, kPlinthTopY}),
                96);
    addNode(scene, "plinth", glm::dmat4(1.0),
            {{addMesh(scene, "plinth", std::move(plinth)),
              addMaterial(scene, metallicRoughness("slate", {0.035f, 0.037f, 0.042f}, 0.0f, 0.32f))}});
    Mesh floor;
    appendFloor(floor, {0.0, 0.0, 0.5}, {12.0, 6.0}, {24, 12});
    addNode(scene, "floor", glm::dmat4(1.0),
            {{addMesh(scene, "floor", std::move(floor)),
              addMaterial(scene, metallicRoughness("floor", {0.16f, 0.11f, 0.08f}, 0.0f, 0.38f))}});
    // A plain backdrop 1.4 m behind.
    Mesh wall;
    appendQuad(wall, {-6.0, 0.0, -1.4}, {6.0, 0.0, -1.4}, {6.0, 5.0, -1.4}, {-6.0, 5.0, -1.4});
    addNode(scene, "wall", glm::dmat4(1.0),
            {{addMesh(scene, "wall", std::move(wall)), addMaterial(scene, lambert("wall", {0.1f, 0.115f, 0.13f}))}});
}

void addSpot(Scene& scene, const std::string& name, const glm::dvec3& positionWS, const glm::dvec3& targetWS,
             const glm::vec3& color, float candela, float innerDegrees, float outerDegrees) {
    Light light;
    light.name = name;
    light.type = LightType::Spot;
    light.positionWS = positionWS;
    light.directionWS = glm::normalize(targetWS - positionWS);
    light.color = color;
    light.intensity = candela;
    light.innerConeRadians = glm::radians(innerDegrees);
    light.outerConeRadians = glm::radians(outerDegrees);
    scene.lights.push_back(light);
}

void addStudioLights(Scene& scene) {
    const glm::dvec3 faceWS(0.0, 0.52, 0.0);
    addSpot(scene, "key", {-1.1, 1.35, 1.35}, faceWS, {1.0f, 0.88f, 0.74f}, 4.2f, 14.0f, 32.0f);
    addSpot(scene, "rim", {1.0, 1.2, -1.1}, faceWS, {0.62f, 0.78f, 1.0f}, 5.0f, 16.0f, 34.0f);
    Light fill;
    fill.name = "fill";
    fill.positionWS = {1.5, 0.7, 1.5};
    fill.color = {0.55f, 0.68f, 1.0f};
    fill.intensity = 0.8f;
    scene.lights.push_back(fill);
    addSpot(scene, "backdrop", {-0.2, 2.3, 0.0}, {-0.25, 0.75, -1.4}, {1.0f, 0.72f, 0.5f}, 9.0f, 8.0f, 56.0f);
}

constexpr int kFineColumns = 252, kFineRows = 168, kFineMapTexels = 1536;

/// Portraits with subsurface scattering and a strong light behind the head.
void addSkinSurroundings(Scene& scene, const LoadOptions& options) {
    addSurroundings(scene);
    const glm::dvec3 faceWS(0.0, 0.56, 0.0);
    addSpot(scene, "key", {-0.95, 1.05, 1.1}, faceWS, {1.0f, 0.9f, 0.78f}, 3.4f, 12.0f, 26.0f);
    addSpot(scene, "back", {0.62, 0.78, -0.8}, faceWS, {1.0f, 0.84f, 0.66f}, 4.5f, 12.0f, 24.0f);
    addPointLight(scene, "fill", {1.4, 0.75, 1.5}, {0.5f, 0.66f, 1.0f}, 0.55f);
    addSpot(scene, "backdrop", {-0.2, 2.3, 0.0}, {-0.25, 0.75, -1.4}, {0.55f, 0.66f, 0.8f}, 3.0f, 8.0f, 56.0f);
    for (Light& light : scene.lights) light.castsShadow = true;
    keepFirstLights(scene, options);
    addCamera(scene, "portrait", {0.26, 0.57, 0.98}, {0.0, 0.52, 0.0}, 30.0);
    addCamera(scene, "close", {0.42, 0.6, 0.32}, {0.02, 0.56, 0.02}, 34.0);
    addCamera(scene, "whole", {0.33, 0.56, 1.5}, {0.0, 0.41, 0.0}, 29.0);
    for (Camera& camera : scene.cameras) camera.nearMetres = 0.02;
}

} // namespace

Scene makeHead(const LoadOptions& options, LoadLedger& ledger) {
    Scene scene;
    scene.name = "head";
    addHead(scene, {"marble"}, options, ledger);
    addSurroundings(scene);
    addStudioLights(scene);
    for (Light& light : scene.lights) light.castsShadow = true;
    keepFirstLights(scene, options);
    addCamera(scene, "portrait", {0.33, 0.56, 1.5}, {0.0, 0.41, 0.0}, 29.0);
    addCamera(scene, "three-quarter", {1.2, 0.6, 1.0}, {0.0, 0.43, 0.0}, 32.0);
    addCamera(scene, "close", {-0.22, 0.6, 0.75}, {0.0, 0.53, 0.0}, 32.0);
    for (Camera& camera : scene.cameras) camera.nearMetres = 0.02;
    return scene;
}

Scene makeHeadSkin(const LoadOptions& options, LoadLedger& ledger) {
    Scene scene;
    scene.name = "head_skin";
    Material& skin = scene.materials[std::size_t(
        addHead(scene, {"skin", BustPaint::Skin, kFineColumns, kFineRows, kFineMapTexels}, options, ledger))];
    skin.subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    // Not measured: less than the default, since the bust's ears are thick.
    skin.subsurface.absorptionPerMillimetre = {0.16f, 0.6f, 1.1f};
    addSkinSurroundings(scene, options);
    return scene;
}

Scene makeHeadMarble(const LoadOptions& options, LoadLedger& ledger) {
    Scene scene;
    scene.name = "head_marble";
    Material& marble = scene.materials[std::size_t(addHead(
        scene, {"marble", BustPaint::PolishedMarble, kFineColumns, kFineRows, kFineMapTexels}, options, ledger))];
    marble.alpha = 0.2f;
    marble.ior = 1.5f;
    marble.subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    marble.subsurface.profile = namedProfiles()[1].profile;
    // Not measured: half (red) and 0.4 (green and blue) of the decay of the dipole in the profile's source, sqrt(3
    // absorption extinction) = 0.12, 0.18 and 0.25, so that ears glow.
    marble.subsurface.absorptionPerMillimetre = {0.06f, 0.075f, 0.1f};
    addSkinSurroundings(scene, options);
    return scene;
}

} // namespace tessera::scenes::builtin
