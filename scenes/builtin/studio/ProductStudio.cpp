#include <glm/gtc/matrix_transform.hpp>

#include "scenes/AreaLight.h"
#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/models/Textures.h"
#include "scenes/builtin/studio/Products.h"

namespace tessera::scenes::builtin {
namespace {

glm::dmat4 studioPlace(double x, double z, double turnRadians = 0.0) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), {x, 0.0, z}), turnRadians, glm::dvec3(0.0, 1.0, 0.0));
}

void addProduct(Scene& scene, Mesh mesh, const glm::dmat4& worldFromProduct, const Material& material) {
    const std::string name = material.name;
    const int meshIndex = addMesh(scene, name, std::move(mesh));
    addNode(scene, name, worldFromProduct, {{meshIndex, addMaterial(scene, material)}});
}

void addProducts(Scene& scene) {
    addProduct(scene, studio::paperSweep(), glm::dmat4(1.0),
               metallicRoughness("paper", {0.72f, 0.71f, 0.70f}, 0.0f, 0.9f));

    Material cloth = metallicRoughness("velvet", {0.035f, 0.010f, 0.085f}, 0.0f, 0.9f);
    cloth.specularFactor = 0.3f;
    cloth.sheenColor = {0.62f, 0.42f, 0.95f};
    cloth.sheenPerceptualRoughness = 0.45f;
    cloth.doubleSided = true; // its hem stands off the floor
    addProduct(scene, studio::drapedCloth(), studioPlace(-0.92, -0.42), cloth);

    addProduct(scene, studio::vase(), studioPlace(0.62, -0.55),
               metallicRoughness("porcelain", {0.83f, 0.83f, 0.79f}, 0.0f, 0.14f));
    scene.materials.back().doubleSided = true; // it is open above

    addProduct(scene, studio::ball(0.30), studioPlace(-0.12, -0.25),
               metallicRoughness("polished steel", {0.78f, 0.79f, 0.80f}, 1.0f, 0.15f));

    Material paint = metallicRoughness("car paint", {0.34f, 0.010f, 0.014f}, 0.75f, 0.42f);
    paint.clearcoat = 1.0f;
    paint.clearcoatPerceptualRoughness = 0.12f;
    TextureUse& flakes = paint.texture(TextureSlot::Normal);
    flakes.image = addImage(scene, models::flakeNormals());
    flakes.transform.scale = {4.0f, 2.0f};
    paint.normalScale = 0.6f;
    addProduct(scene, studio::shell(), studioPlace(0.44, 0.36, 0.45), paint);

    addProduct(scene, studio::ball(0.19), studioPlace(-0.58, 0.30),
               metallicRoughness("rough gold", {1.0f, 0.71f, 0.29f}, 1.0f, 0.45f));

    Material brushed = metallicRoughness("brushed titanium", {0.56f, 0.53f, 0.50f}, 1.0f, 0.34f);
    brushed.anisotropyStrength = 0.85f;
    brushed.doubleSided = true;
    addProduct(scene, studio::ring(), studioPlace(-0.06, 0.62), brushed);

    addProduct(scene, studio::stopper(), studioPlace(1.10, 0.12),
               metallicRoughness("orange plastic", {0.80f, 0.19f, 0.015f}, 0.0f, 0.28f));
}

void addProductLights(Scene& scene) {
    constexpr glm::dvec3 kProductsWS(0.0, 0.35, 0.0);

    Light& key =
        addAreaLight(scene, "key", LightType::Rectangle, {-2.5, 2.9, 2.0}, kProductsWS, {1.0f, 0.95f, 0.88f}, 13.0f);
    key.widthMetres = 1.9f;
    key.heightMetres = 1.4f;
    key.castsShadow = true;

    Light& rim =
        addAreaLight(scene, "rim", LightType::Rectangle, {2.5, 1.7, -1.0}, kProductsWS, {0.80f, 0.90f, 1.0f}, 14.0f);
    rim.alongWS = acrossFrom(rim.directionWS, {0.0, 1.0, 0.0}).value_or(rim.alongWS); // it stands upright
    rim.widthMetres = 2.2f;
    rim.heightMetres = 0.3f;
    rim.castsShadow = true;

    Light& fill =
        addAreaLight(scene, "fill", LightType::Disk, {2.9, 1.8, 2.8}, kProductsWS, {0.88f, 0.94f, 1.0f}, 0.8f);
    fill.radiusMetres = 1.1f;

    // Broad and dim, for polished surfaces to reflect.
    Light& overhead = addAreaLight(scene, "overhead", LightType::Rectangle, {0.0, 3.4, -0.3}, {0.0, 0.0, -0.3},
                                   glm::vec3(1.0f), 0.7f);
    overhead.widthMetres = 3.2f;
    overhead.heightMetres = 2.4f;

    Light& tube = addAreaLight(scene, "tube", LightType::Tube, {-1.75, 1.05, -1.15}, {-1.75, 2.0, -1.15},
                               {1.0f, 0.30f, 0.55f}, 9.0f);
    tube.radiusMetres = 0.03f;
    tube.lengthMetres = 1.6f;
    tube.rangeMetres = 6.0f;

    constexpr double kGlobeY = 0.165;
    const glm::dvec3 globeWS(0.83, kGlobeY, 0.72);
    Light& globe = addAreaLight(scene, "globe", LightType::Sphere, globeWS, kProductsWS, {1.0f, 0.72f, 0.42f}, 9.0f);
    globe.radiusMetres = 0.07f;
    globe.rangeMetres = 3.0f;
    addProduct(scene, studio::lampFoot(), studioPlace(globeWS.x, globeWS.z),
               metallicRoughness("brass foot", {0.78f, 0.57f, 0.27f}, 1.0f, 0.25f));
}

} // namespace

Scene makeProductStudio(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "studio";
    scene.background = {0.02f, 0.02f, 0.022f};
    addProducts(scene);
    addProductLights(scene);
    keepFirstLights(scene, options);
    addCamera(scene, "front", {0.12, 1.30, 4.1}, {0.06, 0.33, 0.0}, 31.0);
    addCamera(scene, "near", {-1.1, 0.72, 1.75}, {0.05, 0.26, 0.15}, 36.0);
    scene.options.requested["toneMap"] = std::string("khronos_neutral");
    return scene;
}

} // namespace tessera::scenes::builtin
