// Layers of materials, what passes through them, and films.
#include <numbers>

#include "tests/unit/scenes/json/OneMaterial.h"

namespace tessera::scenes {
namespace {

using test::errorOfMaterial;
using test::redOf;
using test::SceneFolder;
using test::sceneOf;

TEST(SceneJsonMaterials, layersOfMetallicRoughnessHaveTheirParametersAndTextures) {
    const SceneFolder folder;
    const Scene scene = sceneOf(folder, R"("model": "metallic_roughness", "anisotropyStrength": 0.5,
        "anisotropyRotationDegrees": 90, "anisotropyTexture": "pictures/albedo.tga",
        "clearcoat": {"factor": 0.25, "texture": "pictures/specular.tga"},
        "clearcoatPerceptualRoughness": {"factor": 0.75, "texture": "pictures/normal.tga"},
        "clearcoatNormalMap": {"file": "pictures/normal.tga", "scale": 2, "texCoord": 1},
        "occlusionMap": {"file": "pictures/albedo.tga", "strength": 0.5, "texCoord": 1},
        "sheenColor": {"factor": [0.1, 0.2, 0.3], "texture": "pictures/albedo.tga"},
        "sheenPerceptualRoughness": {"factor": 0.125, "texture": "pictures/specular.tga"})");
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.anisotropyStrength, 0.5f);
    EXPECT_FLOAT_EQ(material.anisotropyRotationRadians, std::numbers::pi_v<float> / 2);
    EXPECT_EQ(material.clearcoat, 0.25f);
    EXPECT_EQ(material.clearcoatPerceptualRoughness, 0.75f);
    EXPECT_EQ(material.clearcoatNormalScale, 2.0f);
    EXPECT_EQ(material.occlusionStrength, 0.5f);
    EXPECT_EQ(material.texture(TextureSlot::Occlusion).texCoordSet, 1);
    EXPECT_EQ(material.sheenColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.sheenPerceptualRoughness, 0.125f);
    EXPECT_EQ(redOf(scene, TextureSlot::Anisotropy), 10);
    EXPECT_EQ(redOf(scene, TextureSlot::Clearcoat), 40);
    EXPECT_EQ(redOf(scene, TextureSlot::ClearcoatRoughness), 128);
    EXPECT_EQ(redOf(scene, TextureSlot::ClearcoatNormal), 128);
    EXPECT_EQ(material.texture(TextureSlot::ClearcoatNormal).texCoordSet, 1);
    EXPECT_EQ(redOf(scene, TextureSlot::SheenColor), 10);
    EXPECT_EQ(redOf(scene, TextureSlot::SheenRoughness), 40);
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "sheenColor": [0, 2, 0])"),
              "/materials/0/sheenColor/1: is 2; at most 1 is allowed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "clearcoat": -1)"),
              "/materials/0/clearcoat: is -1; at least 0 is needed");
}

TEST(SceneJsonMaterials, glassHasItsTransmissionThicknessAndAttenuation) {
    const SceneFolder folder;
    const Material material = sceneOf(folder, R"("model": "metallic_roughness", "transmission": 0.75,
        "thicknessMetres": 0.02, "attenuationColor": [0.1, 0.5, 1], "attenuationDistanceMetres": 0.125,
        "dispersion": 0.25)")
                                  .materials[0];
    EXPECT_EQ(material.transmission, 0.75f);
    EXPECT_EQ(material.thicknessMetres, 0.02f);
    EXPECT_EQ(material.attenuationColor, glm::vec3(0.1f, 0.5f, 1.0f));
    EXPECT_EQ(material.attenuationDistanceMetres, 0.125f);
    EXPECT_EQ(material.dispersion, 0.25f);
    EXPECT_TRUE(isTransparent(material)) << "whatever its alpha mode";
    EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "transmission": 2)"),
              "/materials/0/transmission: is 2; at most 1 is allowed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "thicknessMetres": -1)"),
              "/materials/0/thicknessMetres: is -1; at least 0 is needed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "dispersion": -1)"),
              "/materials/0/dispersion: is -1; at least 0 is needed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "attenuationColor": [0, 2, 0])"),
              "/materials/0/attenuationColor/1: is 2; at most 1 is allowed");
}

TEST(SceneJsonMaterials, aFilmHasItsShareIndexAndThickness) {
    const SceneFolder folder;
    const Material material = sceneOf(folder, R"("model": "metallic_roughness", "iridescence": 0.75,
        "iridescenceIor": 1.5, "iridescenceThicknessNm": 250)")
                                  .materials.at(0);
    EXPECT_EQ(material.iridescence, 0.75f);
    EXPECT_EQ(material.iridescenceIor, 1.5f);
    EXPECT_EQ(material.iridescenceThicknessNm, 250.0f);
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "iridescenceIor": 0.5)"),
              "/materials/0/iridescenceIor: is 0.5; at least 1 is needed");
}

TEST(SceneJsonMaterials, glassAndFilmsHaveTextures) {
    const SceneFolder folder;
    const Scene scene = sceneOf(folder, R"("model": "metallic_roughness",
        "transmission": {"factor": 0.75, "texture": "pictures/albedo.tga"},
        "thicknessMetres": {"factor": 0.5, "texture": {"file": "pictures/specular.tga", "texCoord": 1}},
        "iridescence": {"factor": 0.25, "texture": "pictures/specular.tga"},
        "iridescenceThicknessNm": {"factor": 250, "texture": "pictures/normal.tga"},
        "iridescenceLeastThicknessNm": 50)");
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.transmission, 0.75f);
    EXPECT_EQ(material.thicknessMetres, 0.5f);
    EXPECT_EQ(material.iridescence, 0.25f);
    EXPECT_EQ(material.iridescenceThicknessNm, 250.0f);
    EXPECT_EQ(material.iridescenceLeastThicknessNm, 50.0f);
    EXPECT_EQ(redOf(scene, TextureSlot::Transmission), 10);
    EXPECT_EQ(redOf(scene, TextureSlot::Thickness), 40);
    EXPECT_EQ(material.texture(TextureSlot::Thickness).texCoordSet, 1);
    EXPECT_EQ(redOf(scene, TextureSlot::Iridescence), 40);
    EXPECT_EQ(redOf(scene, TextureSlot::IridescenceThickness), 128);
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "transmission": {"factor": 2})"),
              "/materials/0/transmission/factor: is 2; at most 1 is allowed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "iridescenceLeastThicknessNm": -1)"),
              "/materials/0/iridescenceLeastThicknessNm: is -1; at least 0 is needed");
}

TEST(SceneJsonMaterials, onlyATextureThatMayGiveAFilmAThicknessMakesOneOfNone) {
    Material material;
    material.iridescence = 0.5f;
    material.iridescenceThicknessNm = 0.0f;
    EXPECT_FALSE(isIridescent(material));
    material.texture(TextureSlot::IridescenceThickness).image = 0;
    EXPECT_TRUE(isIridescent(material)) << "as thick as the least where the texture is 0";
    material.iridescenceLeastThicknessNm = 0.0f;
    EXPECT_FALSE(isIridescent(material));
}

TEST(SceneJsonMaterials, onlyMetallicRoughnessHasAFilmAndNoSubsurfaceBelowIt) {
    Material material;
    material.subsurface.method = SubsurfaceMethod::DepthMap;
    material.iridescence = 0.5f;
    for (const MaterialModelInfo& model : materialModels()) {
        material.model = model.model;
        EXPECT_EQ(isIridescent(material), model.model == MaterialModel::MetallicRoughness) << model.name;
    }
    material.model = MaterialModel::MetallicRoughness;
    EXPECT_EQ(subsurfaceOf(material, {}), SubsurfaceMethod::None);
    material.iridescenceThicknessNm = 0.0f;
    EXPECT_FALSE(isIridescent(material));
    EXPECT_EQ(subsurfaceOf(material, {}), SubsurfaceMethod::DepthMap);
}

TEST(SceneJsonMaterials, onlyMetallicRoughnessTransmits) {
    Material material;
    material.transmission = 1.0f;
    for (const MaterialModelInfo& model : materialModels()) {
        material.model = model.model;
        EXPECT_EQ(isTransmissive(material), model.model == MaterialModel::MetallicRoughness) << model.name;
    }
}

} // namespace
} // namespace tessera::scenes
