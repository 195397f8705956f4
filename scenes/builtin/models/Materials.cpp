#include "scenes/builtin/models/Materials.h"

#include "scenes/builtin/Author.h"
#include "scenes/builtin/models/Textures.h"

namespace tessera::scenes::builtin::models {
namespace {

TextureUse repeated(int image, const glm::vec2& times) {
    TextureUse use;
    use.image = image;
    use.transform.scale = times;
    return use;
}

/// Textures repeat around a sphere twice as often as from pole to pole, so that they are square at its equator.
TextureUse around(int image, float times) {
    return repeated(image, {2.0f * times, times});
}

Material named(const char* name, MaterialModel model, const glm::vec3& color) {
    Material material;
    material.name = name;
    material.model = model;
    material.baseColor = glm::vec4(color, 1.0f);
    return material;
}

std::vector<int> addTeaching(Scene& scene) {
    Material lantern = named("single_color, lantern", MaterialModel::SingleColor, glm::vec3(1.6f));
    lantern.texture(TextureSlot::BaseColor) = repeated(addImage(scene, lanternColors()), {1, 1});
    Material terrazzo = named("lambert, terrazzo", MaterialModel::Lambert, glm::vec3(0.32f));
    terrazzo.texture(TextureSlot::BaseColor) = around(addImage(scene, terrazzoColors()), 1);
    Material glaze = named("blinn_phong, glazed bands", MaterialModel::BlinnPhong, {0.055f, 0.006f, 0.008f});
    glaze.exponent = 220.0f;
    glaze.specularColor = glm::vec3(1.0f);
    glaze.texture(TextureSlot::SpecularColor) = around(addImage(scene, glazeColors()), 1);
    Material satin = named("microfacet, masking walter", MaterialModel::Microfacet, {0.008f, 0.030f, 0.027f});
    satin.alpha = 0.35f;
    satin.ior = 2.6f;
    Material handout = satin;
    handout.name = "microfacet, masking half_vector";
    handout.masking = Masking::HalfVector;
    handout.doubleSided = true; // on an open shape
    std::vector<int> materials;
    for (const Material& material : {lantern, terrazzo, glaze, satin, handout})
        materials.push_back(addMaterial(scene, material));
    return materials;
}

std::vector<int> addDirectional(Scene& scene) {
    Material silk =
        named("microfacet_anisotropic, masking walter", MaterialModel::MicrofacetAnisotropic, {0.022f, 0.008f, 0.030f});
    silk.alpha = 0.55f;
    silk.alphaY = 0.10f;
    silk.ior = 3.0f;
    silk.specularColor = {1.0f, 0.75f, 0.95f};
    Material along = silk;
    along.name = "microfacet_anisotropic, masking directional";
    along.alpha = 0.10f;
    along.alphaY = 0.55f;
    along.masking = Masking::Directional;
    along.specularColor = {0.75f, 0.85f, 1.0f};
    Material turned = metallicRoughness("metallic_roughness, turned steel", {0.62f, 0.61f, 0.58f}, 1.0f, 0.30f);
    turned.anisotropyStrength = 0.85f;
    turned.doubleSided = true;
    Material swirled = metallicRoughness("metallic_roughness, swirled copper", {0.90f, 0.46f, 0.28f}, 1.0f, 0.28f);
    swirled.anisotropyStrength = 0.9f;
    swirled.texture(TextureSlot::Anisotropy) = around(addImage(scene, swirlDirections()), 3);
    Material gold = metallicRoughness("metallic_roughness, gold", {1.0f, 0.72f, 0.30f}, 1.0f, 0.32f);
    std::vector<int> materials;
    for (const Material& material : {silk, along, turned, swirled, gold})
        materials.push_back(addMaterial(scene, material));
    return materials;
}

std::vector<int> addLayered(Scene& scene) {
    Material paint = metallicRoughness("clearcoat over flakes", {0.02f, 0.12f, 0.55f}, 0.85f, 0.42f);
    paint.clearcoat = 1.0f;
    paint.clearcoatPerceptualRoughness = 0.08f;
    paint.texture(TextureSlot::Normal) = around(addImage(scene, flakeNormals()), 2);
    Material carbon = metallicRoughness("clearcoat over fibres", glm::vec3(1.0f), 0.6f, 0.45f);
    carbon.anisotropyStrength = 0.8f;
    carbon.clearcoat = 1.0f;
    carbon.clearcoatPerceptualRoughness = 0.06f;
    carbon.texture(TextureSlot::BaseColor) = around(addImage(scene, fibreColors()), 1);
    carbon.texture(TextureSlot::Anisotropy) = around(addImage(scene, fibreDirections()), 1);
    Material velvet = metallicRoughness("sheen, velvet", {0.10f, 0.003f, 0.012f}, 0.0f, 0.9f);
    velvet.specularFactor = 0.3f;
    velvet.sheenColor = {1.0f, 0.30f, 0.38f};
    velvet.sheenPerceptualRoughness = 0.45f;
    Material cloth = metallicRoughness("sheen, checked cloth", glm::vec3(1.0f), 0.0f, 0.95f);
    cloth.sheenColor = {0.55f, 0.60f, 0.75f};
    cloth.sheenPerceptualRoughness = 0.75f;
    cloth.texture(TextureSlot::BaseColor) = around(addImage(scene, clothColors()), 2);
    cloth.texture(TextureSlot::Normal) = around(addImage(scene, clothNormals()), 2);
    cloth.texture(TextureSlot::SheenRoughness) = around(addImage(scene, fuzzRoughness()), 1);
    Material ember = metallicRoughness("clearcoat with waves over embers", {0.02f, 0.02f, 0.022f}, 0.0f, 0.6f);
    ember.emissive = glm::vec3(1.5f);
    ember.clearcoat = 1.0f;
    ember.clearcoatPerceptualRoughness = 0.12f;
    ember.texture(TextureSlot::Emissive) = around(addImage(scene, glowColors()), 1);
    ember.texture(TextureSlot::ClearcoatNormal) = around(addImage(scene, peelNormals()), 3);
    std::vector<int> materials;
    for (const Material& material : {paint, carbon, velvet, cloth, ember})
        materials.push_back(addMaterial(scene, material));
    return materials;
}

} // namespace

Exhibits addExhibits(Scene& scene) {
    Exhibits exhibits;
    exhibits.teaching = addTeaching(scene);
    exhibits.directional = addDirectional(scene);
    exhibits.layered = addLayered(scene);
    return exhibits;
}

} // namespace tessera::scenes::builtin::models
