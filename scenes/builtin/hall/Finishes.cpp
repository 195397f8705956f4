#include "scenes/builtin/hall/Finishes.h"

#include "scenes/builtin/Author.h"
#include "scenes/builtin/hall/Textures.h"

namespace tessera::scenes::builtin::hall {
namespace {

/// Assigns an image that covers `metres` of surface to a slot; texture coordinates are in metres.
void useEvery(Material& material, TextureSlot slot, int image, float metres) {
    TextureUse& use = material.texture(slot);
    use.image = image;
    use.transform.scale = glm::vec2(1.0f / metres);
}

Material cloth(const std::string& name, const glm::vec3& color, Image picture, Scene& scene) {
    Material material = metallicRoughness(name, color, 0.0f, 0.85f);
    material.doubleSided = true;
    material.texture(TextureSlot::BaseColor).image = addImage(scene, std::move(picture));
    return material;
}

} // namespace

Finishes addFinishes(Scene& scene) {
    Finishes f{};
    Material floor = metallicRoughness("floor marble", glm::vec3(1.0f), 0.0f, 1.0f);
    useEvery(floor, TextureSlot::BaseColor, addImage(scene, floorColors()), kFloorTextureMetres);
    useEvery(floor, TextureSlot::MetallicRoughness, addImage(scene, floorRoughness()), kFloorTextureMetres);
    useEvery(floor, TextureSlot::Normal, addImage(scene, floorNormals()), kFloorTextureMetres);
    f.floor = addMaterial(scene, floor);

    Material wall = metallicRoughness("ashlar", glm::vec3(1.0f), 0.0f, 0.85f);
    useEvery(wall, TextureSlot::BaseColor, addImage(scene, ashlarColors()), kAshlarTextureMetres);
    useEvery(wall, TextureSlot::Normal, addImage(scene, ashlarNormals()), kAshlarTextureMetres);
    f.wall = addMaterial(scene, wall);

    const int marble = addImage(scene, marbleColors());
    Material column = metallicRoughness("column marble", {0.95f, 0.9f, 0.85f}, 0.0f, 0.3f);
    useEvery(column, TextureSlot::BaseColor, marble, 2.0f);
    f.column = addMaterial(scene, column);
    Material trim = metallicRoughness("limestone", {0.62f, 0.56f, 0.47f}, 0.0f, 0.6f);
    f.trim = addMaterial(scene, trim);
    f.plinth = addMaterial(scene, metallicRoughness("basalt", {0.05f, 0.05f, 0.058f}, 0.0f, 0.28f));

    f.gold = addMaterial(scene, metallicRoughness("gilding", {1.0f, 0.72f, 0.29f}, 1.0f, 0.28f));
    f.coffer = addMaterial(scene, metallicRoughness("ultramarine", {0.035f, 0.07f, 0.26f}, 0.0f, 0.55f));
    f.mosaic = addMaterial(scene, metallicRoughness("gold mosaic", {0.92f, 0.66f, 0.26f}, 1.0f, 0.5f));
    useEvery(scene.materials.back(), TextureSlot::Normal, addImage(scene, mosaicNormals()), kMosaicTextureMetres);

    Material carpet = lambert("carpet", glm::vec3(0.3f)); // k_d has no 1/pi: cloth of albedo 0.9
    carpet.texture(TextureSlot::BaseColor).image = addImage(scene, carpetColors());
    f.carpet = addMaterial(scene, carpet);
    f.crimson = addMaterial(
        scene, cloth("crimson banner", glm::vec3(1.0f), bannerColors("crimson", {0.42f, 0.02f, 0.03f}), scene));
    f.azure =
        addMaterial(scene, cloth("azure banner", glm::vec3(1.0f), bannerColors("azure", {0.02f, 0.09f, 0.36f}), scene));

    f.bronze = addMaterial(scene, metallicRoughness("bronze", {0.62f, 0.40f, 0.22f}, 1.0f, 0.38f));
    Material statue = microfacet("statuary marble", glm::vec3(0.26f, 0.25f, 0.235f), 1.5f, 0.22f);
    f.statue = addMaterial(scene, statue);
    Material glaze = microfacet("celadon glaze", glm::vec3(0.05f, 0.17f, 0.15f), 1.55f, 0.06f);
    f.glaze = addMaterial(scene, glaze);
    f.door = addMaterial(scene, metallicRoughness("bronze doors", {0.36f, 0.27f, 0.17f}, 1.0f, 0.45f));
    return f;
}

} // namespace tessera::scenes::builtin::hall
