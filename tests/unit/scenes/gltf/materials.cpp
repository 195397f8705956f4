#include <gtest/gtest.h>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

Material importedMaterial(const char* patch) {
    Builder builder;
    builder.material().merge_patch(Json::parse(patch));
    builder.addTexture();
    const Scene scene = builder.import();
    return scene.materials.at(static_cast<std::size_t>(scene.nodes.at(0).instances.at(0).material));
}

TEST(GltfMaterials, factorsAreImportedExactly) {
    const Material material = importedMaterial(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4],
        "metallicFactor": 0.5, "roughnessFactor": 0.25}, "emissiveFactor": [1, 2, 3], "doubleSided": true})");
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.model, MaterialModel::MetallicRoughness);
    EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.metallic, 0.5f);
    EXPECT_EQ(material.perceptualRoughness, 0.25f);
    EXPECT_EQ(material.emissive, glm::vec3(1, 2, 3));
    EXPECT_TRUE(material.doubleSided);
}

TEST(GltfMaterials, defaultsAreThoseOfTheSpecification) {
    const Material material = importedMaterial("{}");
    EXPECT_EQ(material.baseColor, glm::vec4(1));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.perceptualRoughness, 1.0f);
    EXPECT_EQ(material.emissive, glm::vec3(0));
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
    EXPECT_FALSE(material.doubleSided);
    for (const TextureUse& use : material.textures) EXPECT_EQ(use.image, kNone);
}

TEST(GltfMaterials, transmissionAndVolumeAreImportedExactly) {
    const Material material = importedMaterial(R"({"extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 0.75},
        "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 2,
                                 "attenuationColor": [0.25, 0.5, 1]},
        "KHR_materials_dispersion": {"dispersion": 0.375}}})");
    EXPECT_EQ(material.transmission, 0.75f);
    EXPECT_EQ(material.thicknessMetres, 0.5f);
    EXPECT_EQ(material.attenuationDistanceMetres, 2.0f);
    EXPECT_EQ(material.attenuationColor, glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(material.dispersion, 0.375f);
    const Material plain = importedMaterial(R"({"extensions": {"KHR_materials_transmission": {},
                                               "KHR_materials_volume": {},
                                               "KHR_materials_dispersion": {}}})");
    EXPECT_EQ(plain.transmission, 0.0f);
    EXPECT_EQ(plain.thicknessMetres, 0.0f);
    EXPECT_EQ(plain.attenuationDistanceMetres, 0.0f) << "nothing is absorbed";
    EXPECT_EQ(plain.attenuationColor, glm::vec3(1.0f));
    EXPECT_EQ(plain.dispersion, 0.0f);
}

TEST(GltfMaterials, iridescenceIsImportedExactlyWithItsRangeOfThicknesses) {
    const Material material = importedMaterial(R"({"extensions": {"KHR_materials_iridescence": {
        "iridescenceFactor": 0.75, "iridescenceIor": 1.5, "iridescenceThicknessMinimum": 50,
        "iridescenceThicknessMaximum": 250}}})");
    EXPECT_EQ(material.iridescence, 0.75f);
    EXPECT_EQ(material.iridescenceIor, 1.5f);
    EXPECT_EQ(material.iridescenceThicknessNm, 250.0f);
    EXPECT_EQ(material.iridescenceLeastThicknessNm, 50.0f);
    const Material plain = importedMaterial(R"({"extensions": {"KHR_materials_iridescence": {}}})");
    EXPECT_EQ(plain.iridescence, 0.0f);
    EXPECT_EQ(plain.iridescenceIor, 1.3f);
    EXPECT_EQ(plain.iridescenceThicknessNm, 400.0f);
    EXPECT_EQ(plain.iridescenceLeastThicknessNm, 100.0f);
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"extensions": {"KHR_materials_iridescence": {
        "iridescenceIor": 0.5}}})"));
    EXPECT_NE(builder.error().find("iridescenceIor: is 0.5"), std::string::npos) << builder.error();
}

/// A pane 0.5 thick in its mesh's space, and what is imported of it.
Scene paneOf(const char* nodes, const char* roots = "[0]") {
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 2}}})"));
    builder.json["nodes"] = Json::parse(nodes);
    builder.json["scenes"][0]["nodes"] = Json::parse(roots);
    return builder.import();
}

constexpr const char* kNoOneScale = "the thickness of material 0 is taken in metres";

TEST(GltfMaterials, aThicknessIsScaledAsTheNodesThatShowIt) {
    const auto expectThickness = [](const Scene& scene, float wantedMetres) {
        EXPECT_FLOAT_EQ(scene.materials.at(0).thicknessMetres, wantedMetres);
        EXPECT_EQ(scene.materials.at(0).attenuationDistanceMetres, 2.0f) << "which is one of the world";
        EXPECT_FALSE(hasWarning(scene, kNoOneScale));
    };
    expectThickness(paneOf(R"([{"mesh": 0}])"), 0.5f);
    expectThickness(paneOf(R"([{"mesh": 0, "scale": [3, 3, 3]}])"), 1.5f);
    expectThickness(paneOf(R"([{"mesh": 0, "scale": [-2, 2, 2]}])"), 1.0f);
    // Turned, below a parent, and twice alike.
    expectThickness(paneOf(R"([{"children": [1, 2], "scale": [0.5, 0.5, 0.5]},
                               {"mesh": 0, "scale": [4, 4, 4], "rotation": [0.6, 0, 0, 0.8]},
                               {"mesh": 0, "scale": [4, 4, 4], "translation": [1, 2, 3]}])"),
                    1.0f);
    // Nothing is seen of the second, and the third is no part of the scene.
    expectThickness(
        paneOf(R"([{"mesh": 0, "scale": [3, 3, 3]}, {"mesh": 0, "scale": [0, 0, 0]}, {"mesh": 0}])", "[0, 1]"), 1.5f);
}

TEST(GltfMaterials, aThicknessWithoutOneScaleStaysAsItIsWithAWarning) {
    for (const char* nodes :
         {R"([{"mesh": 0, "scale": [1, 1, 2]}])",
          R"([{"mesh": 0, "matrix": [1,0,0,0, 0.6,0.8,0,0, 0,0,1,0, 0,0,0,1]}])", // sheared
          R"([{"mesh": 0, "scale": [3, 3, 3], "children": [1]}, {"mesh": 0, "scale": [2, 2, 2]}])"}) {
        const Scene scene = paneOf(nodes);
        EXPECT_EQ(scene.materials.at(0).thicknessMetres, 0.5f) << nodes;
        EXPECT_TRUE(hasWarning(scene, kNoOneScale)) << nodes;
    }
}

TEST(GltfMaterials, anAttenuationDistanceOf0IsRefused) {
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"extensions": {
        "KHR_materials_volume": {"attenuationDistance": 0}}})"));
    EXPECT_NE(builder.error().find("attenuationDistance: is 0; more than 0 is needed"), std::string::npos);
}

TEST(GltfMaterials, alphaModesAreImportedExactly) {
    const Material mask = importedMaterial(R"({"alphaMode": "MASK", "alphaCutoff": 0.75})");
    EXPECT_EQ(mask.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(mask.alphaCutoff, 0.75f);
    EXPECT_EQ(importedMaterial(R"({"alphaMode": "MASK"})").alphaCutoff, 0.5f);
    EXPECT_EQ(importedMaterial(R"({"alphaMode": "BLEND"})").alphaMode, AlphaMode::Blend);
}

TEST(GltfMaterials, everyTextureLandsInItsSlot) {
    const std::pair<const char*, TextureSlot> places[] = {
        {R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})", TextureSlot::BaseColor},
        {R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}})", TextureSlot::MetallicRoughness},
        {R"({"normalTexture": {"index": 0}})", TextureSlot::Normal},
        {R"({"emissiveTexture": {"index": 0}})", TextureSlot::Emissive},
        {R"({"extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0}}}})",
         TextureSlot::SpecularFactor},
        {R"({"extensions": {"KHR_materials_specular": {"specularColorTexture": {"index": 0}}}})",
         TextureSlot::SpecularColor},
        {R"({"extensions": {"KHR_materials_anisotropy": {"anisotropyTexture": {"index": 0}}}})",
         TextureSlot::Anisotropy},
        {R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 0}}}})", TextureSlot::Clearcoat},
        {R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatRoughnessTexture": {"index": 0}}}})",
         TextureSlot::ClearcoatRoughness},
        {R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatNormalTexture": {"index": 0}}}})",
         TextureSlot::ClearcoatNormal},
        {R"({"extensions": {"KHR_materials_sheen": {"sheenColorTexture": {"index": 0}}}})", TextureSlot::SheenColor},
        {R"({"extensions": {"KHR_materials_sheen": {"sheenRoughnessTexture": {"index": 0}}}})",
         TextureSlot::SheenRoughness},
        {R"({"occlusionTexture": {"index": 0}})", TextureSlot::Occlusion},
        {R"({"extensions": {"KHR_materials_transmission": {"transmissionTexture": {"index": 0}}}})",
         TextureSlot::Transmission},
        {R"({"extensions": {"KHR_materials_volume": {"thicknessTexture": {"index": 0}}}})", TextureSlot::Thickness},
        {R"({"extensions": {"KHR_materials_iridescence": {"iridescenceTexture": {"index": 0}}}})",
         TextureSlot::Iridescence},
        {R"({"extensions": {"KHR_materials_iridescence": {"iridescenceThicknessTexture": {"index": 0}}}})",
         TextureSlot::IridescenceThickness},
    };
    EXPECT_EQ(std::size(places) + 1, kTextureSlotCount) << "all but that of the index of refraction, which glTF lacks";
    for (const auto& [patch, slot] : places) {
        const Material material = importedMaterial(patch);
        for (std::size_t i = 0; i < kTextureSlotCount; ++i)
            EXPECT_EQ(material.textures[i].image, i == static_cast<std::size_t>(slot) ? 0 : kNone) << patch;
    }
}

TEST(GltfMaterials, normalScaleIsImportedExactly) {
    EXPECT_EQ(importedMaterial(R"({"normalTexture": {"index": 0, "scale": 0.5}})").normalScale, 0.5f);
    EXPECT_EQ(importedMaterial(R"({"normalTexture": {"index": 0}})").normalScale, 1.0f);
}

TEST(GltfMaterials, occlusionStrengthIsImportedExactly) {
    EXPECT_EQ(importedMaterial(R"({"occlusionTexture": {"index": 0, "strength": 0.25}})").occlusionStrength, 0.25f);
    EXPECT_EQ(importedMaterial(R"({"occlusionTexture": {"index": 0}})").occlusionStrength, 1.0f);
}

TEST(GltfMaterials, unlitIsASingleColor) {
    const Material material = importedMaterial(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1],
        "baseColorTexture": {"index": 0}}, "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_unlit": {}}})");
    EXPECT_EQ(material.model, MaterialModel::SingleColor);
    EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 1, 1));
    EXPECT_EQ(material.texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(material.emissive, glm::vec3(0));
}

TEST(GltfMaterials, layersOfAnUnlitMaterialAreCheckedAndLeftOut) {
    const auto unlitWith = [](const char* coat) {
        Builder builder;
        builder.material()["extensions"] = {{"KHR_materials_unlit", Json::object()},
                                            {"KHR_materials_ior", {{"ior", 2}}},
                                            {"KHR_materials_clearcoat", Json::parse(coat)}};
        builder.addTexture();
        return builder;
    };
    const Scene scene = unlitWith(R"({"clearcoatFactor": 1, "clearcoatTexture": {"index": 0}})").import();
    EXPECT_EQ(scene.materials.at(0).clearcoat, 0.0f);
    EXPECT_EQ(scene.materials.at(0).ior, 1.5f);
    EXPECT_TRUE(scene.images.empty());
    EXPECT_NE(unlitWith(R"({"clearcoatFactor": 2})").error().find("clearcoatFactor: is 2; it must be at most 1"),
              std::string::npos);
}

TEST(GltfMaterials, emissiveStrengthMultipliesTheEmission) {
    EXPECT_EQ(importedMaterial(R"({"emissiveFactor": [1, 0.5, 0],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})")
                  .emissive,
              glm::vec3(8, 4, 0));
}

TEST(GltfMaterials, iorIsImportedExactly) {
    EXPECT_EQ(importedMaterial(R"({"extensions": {"KHR_materials_ior": {"ior": 1.25}}})").ior, 1.25f);
    EXPECT_EQ(importedMaterial(R"({"extensions": {"KHR_materials_ior": {}}})").ior, 1.5f);
    EXPECT_EQ(importedMaterial(R"({"extensions": {"KHR_materials_ior": {"ior": 4294967296}}})").ior, 4294967296.0f);
    EXPECT_EQ(importedMaterial(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})").ior, 0.0f);
    EXPECT_THROW(importedMaterial(R"({"extensions": {"KHR_materials_ior": {"ior": 0.5}}})"), InputError);
}

TEST(GltfMaterials, specularFactorsAreImportedExactly) {
    const Material material = importedMaterial(
        R"({"extensions": {"KHR_materials_specular": {"specularFactor": 0.25, "specularColorFactor": [1, 2, 0.5]}}})");
    EXPECT_EQ(material.specularFactor, 0.25f);
    EXPECT_EQ(material.specularColor, glm::vec3(1, 2, 0.5f));
}

TEST(GltfMaterials, layersAreImportedExactly) {
    const Material material = importedMaterial(R"({"extensions": {
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 1.5},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25,
                                    "clearcoatNormalTexture": {"index": 0, "scale": 2}},
        "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.75}}})");
    EXPECT_EQ(material.anisotropyStrength, 0.6f);
    EXPECT_EQ(material.anisotropyRotationRadians, 1.5f);
    EXPECT_EQ(material.clearcoat, 0.5f);
    EXPECT_EQ(material.clearcoatPerceptualRoughness, 0.25f);
    EXPECT_EQ(material.clearcoatNormalScale, 2.0f);
    EXPECT_EQ(material.sheenColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.sheenPerceptualRoughness, 0.75f);
}

TEST(GltfMaterials, layersAreOffByDefaultAndNeverWarnedOf) {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_materials_anisotropy", "KHR_materials_clearcoat",
                                         "KHR_materials_sheen"]})");
    builder.material().merge_patch(Json::parse(R"({"extensions": {"KHR_materials_anisotropy": {},
        "KHR_materials_clearcoat": {}, "KHR_materials_sheen": {}}})"));
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.anisotropyStrength, 0.0f);
    EXPECT_EQ(material.clearcoat, 0.0f);
    EXPECT_EQ(material.sheenColor, glm::vec3(0));
}

TEST(GltfMaterials, layersOutOfRangeAreRefused) {
    for (const char* patch : {R"({"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1.5}}})",
                              R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": -1}}})",
                              R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatRoughnessFactor": 2}}})",
                              R"({"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0, 0, 2]}}})",
                              R"({"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0, 0]}}})",
                              R"({"extensions": {"KHR_materials_sheen": {"sheenColorTexture": {"index": 9}}}})"})
        EXPECT_THROW(importedMaterial(patch), InputError) << patch;
}

// ---- Textures ------------------------------------------------------------------------------------------------------

TextureUse importedUse(const char* info, const char* sampler = nullptr) {
    Builder builder;
    builder.material()["pbrMetallicRoughness"]["baseColorTexture"] = Json::parse(info);
    builder.addTexture();
    if (sampler != nullptr) {
        builder.json["samplers"] = Json::array({Json::parse(sampler)});
        builder.json["textures"][0]["sampler"] = 0;
    }
    return builder.import().materials.at(0).texture(TextureSlot::BaseColor);
}

TEST(GltfTextures, samplerSettingsAreImportedExactly) {
    const TextureUse use =
        importedUse(R"({"index": 0})", R"({"magFilter": 9728, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648})");
    EXPECT_EQ(use.sampler,
              (Sampler{Filter::Nearest, Filter::LinearMipmapNearest, Wrap::ClampToEdge, Wrap::MirroredRepeat}));
    const Filter filters[] = {Filter::NearestMipmapNearest, Filter::LinearMipmapNearest, Filter::NearestMipmapLinear,
                              Filter::LinearMipmapLinear};
    for (int i = 0; i < 4; ++i) {
        const std::string sampler = "{\"minFilter\": " + std::to_string(9984 + i) + "}";
        EXPECT_EQ(importedUse(R"({"index": 0})", sampler.c_str()).sampler.minification, filters[i]);
    }
}

TEST(GltfTextures, samplerDefaultsAreRepeatAndTrilinear) {
    const Sampler trilinear{Filter::Linear, Filter::LinearMipmapLinear, Wrap::Repeat, Wrap::Repeat};
    EXPECT_EQ(importedUse(R"({"index": 0})").sampler, trilinear);
    EXPECT_EQ(importedUse(R"({"index": 0})", "{}").sampler, trilinear);
}

TEST(GltfTextures, transformIsImportedExactly) {
    const TextureUse use = importedUse(R"({"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0.5, 0.25], "scale": [2, 3], "rotation": 0.125, "texCoord": 1}}})");
    EXPECT_EQ(use.transform, (TextureTransform{{0.5f, 0.25f}, {2, 3}, 0.125f}));
    EXPECT_EQ(use.texCoordSet, 1);
    EXPECT_EQ(importedUse(R"({"index": 0})").transform, TextureTransform{});
}

TEST(GltfTextures, transformInsideAnExtensionIsImportedExactly) {
    const Material material =
        importedMaterial(R"({"extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0,
        "texCoord": 1, "extensions": {"KHR_texture_transform": {"scale": [4, 5]}}}}}})");
    EXPECT_EQ(material.texture(TextureSlot::SpecularFactor).transform.scale, glm::vec2(4, 5));
    EXPECT_EQ(material.texture(TextureSlot::SpecularFactor).texCoordSet, 1);
}

TEST(GltfTextures, secondTexCoordSetIsImportedAndAThirdIsWarnedOf) {
    EXPECT_EQ(importedUse(R"({"index": 0, "texCoord": 1})").texCoordSet, 1);
    EXPECT_EQ(importedUse(R"({"index": 0, "texCoord": 2})").image, kNone);
}

TEST(GltfTextures, imageIsReadTheSameFromDataUriFileAndBufferView) {
    Builder builder;
    builder.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    builder.addTexture();
    const Image embedded = builder.import().images.at(0);
    EXPECT_EQ(embedded.name, "image 0");
    EXPECT_EQ(embedded.width, 2);

    builder.folder.write("my pictures/r\xc3\xb6t.png", pngRedBlue());
    builder.json["images"][0] = Json::parse(R"({"uri": "my%20pictures/r%C3%B6t.png"})");
    const Image external = builder.import().images.at(0);
    EXPECT_EQ(external.texels, embedded.texels);
    builder.json["images"][0]["uri"] = "my pictures/r\xc3\xb6t.png";
    EXPECT_EQ(builder.import().images.at(0).texels, embedded.texels);

    const int view = builder.addView(pngRedBlue());
    builder.json["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "in a view"}};
    const Image inView = builder.import().images.at(0);
    EXPECT_EQ(inView.texels, embedded.texels);
    EXPECT_EQ(inView.name, "in a view");
}

TEST(GltfTextures, imageUsedTwiceIsDecodedOnce) {
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}})"));
    builder.addTexture();
    builder.json["textures"].push_back(Json::parse(R"({"source": 0})"));
    EXPECT_EQ(builder.import().images.size(), 1u);
}

TEST(GltfSpecularGlossiness, becomesADielectricThatReflectsItsSpecular) {
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1],
        "baseColorTexture": {"index": 0}}, "extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.1, 0.2, 0.3, 0.4], "specularFactor": [0.5, 0.6, 0.7], "glossinessFactor": 0.75}}})"));
    builder.addTexture();
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const Scene scene = builder.import();
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.model, MaterialModel::MetallicRoughness);
    EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.specularColor, glm::vec3(0.5f, 0.6f, 0.7f)) << "F0 with an index of 0";
    EXPECT_EQ(material.ior, 0.0f);
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.perceptualRoughness, 0.25f);
    EXPECT_TRUE(scene.images.empty()) << "what stands in for programs without the extension is not read";
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("(KHR_materials_pbrSpecularGlossiness) are converted"), std::string::npos);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfSpecularGlossiness, theAlphaOfItsTextureBecomesRoughness) {
    Builder builder;
    builder.material()["extensions"] = Json::parse(R"({"KHR_materials_pbrSpecularGlossiness": {
        "diffuseTexture": {"index": 0}, "specularGlossinessTexture": {"index": 0}, "glossinessFactor": 0.5}})");
    builder.addTexture(); // alpha 255 and 128
    const Scene scene = builder.import();
    const Material& material = scene.materials.at(0);
    ASSERT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(material.texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::SpecularColor).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::MetallicRoughness).image, 1);
    EXPECT_EQ(material.perceptualRoughness, 1.0f);
    EXPECT_EQ(std::to_integer<int>(scene.images[1].texels.at(1)), 128) << "1 - 0.5 x 255/255, to the nearest";
    EXPECT_EQ(std::to_integer<int>(scene.images[1].texels.at(5)), 191) << "1 - 0.5 x 128/255";

    builder.json["images"][0] = Json::parse(R"({"uri": "gone.png"})");
    const Material lost = builder.import().materials.at(0);
    EXPECT_EQ(lost.perceptualRoughness, 0.5f) << "of the factor alone";
    EXPECT_EQ(lost.texture(TextureSlot::MetallicRoughness).image, kNone);
}

/// Two triangles: one that is paint, in 'red' ruby and in 'blue' sky, and one that always is paint.
Builder withVariants() {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}},
        "materials": [{"name": "paint"}, {"name": "sky"}, {"name": "ruby"}]})");
    builder.primitive()["material"] = 0;
    builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    builder.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
        Json::parse(R"([{"material": 2, "variants": [0]}, {"material": 1, "variants": [1]}])");
    return builder;
}

/// The names of the materials of the first node's instances.
std::vector<std::string> worn(const Scene& scene) {
    std::vector<std::string> names;
    for (const MeshInstance& instance : scene.nodes.at(0).instances)
        names.push_back(scene.materials.at(std::size_t(instance.material)).name);
    return names;
}

TEST(GltfVariants, aVariantBindsItsMaterialsAndKeepsTheNumbersOfOthers) {
    using Names = std::vector<std::string>;
    Builder builder = withVariants();
    const Scene plain = builder.import();
    EXPECT_EQ(plain.variants, (Names{"red", "blue"}));
    EXPECT_EQ(worn(plain), (Names{"paint", "paint"}));
    EXPECT_EQ(plain.materials.size(), 1u) << "what is not shown is not read";
    EXPECT_TRUE(plain.warnings.empty());
    EXPECT_EQ(plain.notes, (Names{"shows its materials as they are without a variant; its variants are red, blue"}));
    builder.wishes.variant = "blue";
    const Scene blue = builder.import();
    EXPECT_EQ(worn(blue), (Names{"sky", "paint"}));
    EXPECT_EQ(blue.materials.at(0).name, "paint");
    EXPECT_EQ(blue.notes, (Names{"shows the variant 'blue'; its variants are red, blue"}));
    builder.wishes.variant = "green"; // of another model of the scene
    EXPECT_EQ(worn(builder.import()), (Names{"paint", "paint"}));
}

TEST(GltfVariants, skinnedAndMorphedMeshesShowThemToo) {
    Builder builder = withVariants();
    builder.primitive()["targets"] = Json::parse(R"([{"POSITION": 0}])");
    builder.json["meshes"][0]["primitives"].erase(1);
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.wishes.variant = "red";
    EXPECT_EQ(worn(builder.import()), (std::vector<std::string>{"ruby"}));
}

TEST(GltfVariants, whatIsNotThereIsRefused) {
    Builder builder = withVariants();
    builder.primitive()["extensions"]["KHR_materials_variants"]["mappings"][0]["variants"][0] = 2;
    EXPECT_NE(builder.error().find("/variants/0: points at /extensions/KHR_materials_variants/variants/2, but there "
                                   "are only 2"),
              std::string::npos)
        << builder.error();
}

TEST(GltfTextures, missingOrBrokenImageIsACheckerboardOfColoursAndNothingElse) {
    Builder builder;
    builder.material().merge_patch(Json::parse(
        R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
            "normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}})"));
    builder.addTexture();
    builder.json["images"] = Json::parse(R"([{"uri": "gone.png"}, {"uri": "data:image/png;base64,QUJD"}])");
    builder.json["textures"].push_back(Json::parse(R"({"source": 1})"));
    const Scene scene = builder.import();
    ASSERT_EQ(scene.images.size(), 1u) << "one stands in for both";
    EXPECT_NE(scene.images[0].texels.front(), scene.images[0].texels[8 * 4]) << "its squares are 8 texels wide";
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::Emissive).image, 0);
    EXPECT_EQ(material.texture(TextureSlot::Normal).image, kNone);
    EXPECT_EQ(material.texture(TextureSlot::MetallicRoughness).image, kNone);
    EXPECT_EQ(scene.warnings.size(), 2u) << "once each, however often they are used";
    EXPECT_TRUE(hasWarning(scene, "gone.png: there is no such file"));
    EXPECT_TRUE(hasWarning(scene, "model.gltf: /images/1: is in no known picture format"));
    EXPECT_TRUE(hasWarning(scene, "; its colours are a checkerboard, and what else it holds is left out"));

    builder.json["textures"][0] = Json::object();
    EXPECT_TRUE(hasWarning(builder.import(), "/textures/0: has no source in a supported format"));
}

TEST(GltfTextures, webpGoesBeforeTheOtherPictureAndThatStandsInForIt) {
    Builder builder;
    builder.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    builder.addTexture();
    std::filesystem::copy_file(std::filesystem::path(TESSERA_SOURCE_DIR) / "tests/fuzz/corpus/picture/small.webp",
                               builder.folder.write("a.webp", std::string()),
                               std::filesystem::copy_options::overwrite_existing);
    builder.json["images"].push_back(Json::parse(R"({"uri": "a.webp", "mimeType": "image/webp"})"));
    builder.json["textures"][0] = Json::parse(R"({"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}})");
    const Scene both = builder.import();
    ASSERT_EQ(both.images.size(), 1u);
    EXPECT_EQ(both.images[0].name, "a.webp");
    EXPECT_TRUE(both.warnings.empty());

    builder.json["textures"][0].erase("source");
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_EQ(builder.import().images.at(0).name, "a.webp");

    builder.json["textures"][0]["source"] = 0;
    builder.json["images"][1]["uri"] = "gone.webp";
    const Scene other = builder.import();
    ASSERT_EQ(other.images.size(), 1u);
    EXPECT_EQ(other.images[0].width, 2) << "the PNG";
    EXPECT_EQ(other.warnings.size(), 1u);
    EXPECT_TRUE(hasWarning(other, "; the texture's other picture is used instead"));
}

TEST(GltfTextures, noStandInIsDrawnForWantOfMemory) {
    Builder builder;
    builder.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    builder.addTexture();
    // A TGA of one grey, whose runs of 128 texels take two bytes each.
    std::vector<std::uint8_t> tga{0, 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 16, 0, 8, 8, 0x20};
    for (int run = 0; run < 4096 * 2048 / 128; ++run) tga.insert(tga.end(), {0xff, 7});
    builder.folder.write("grey.tga", bytesOf(tga));
    builder.json["images"][0] = Json::parse(R"({"uri": "grey.tga"})");
    const std::filesystem::path file = builder.folder.write("model.gltf", builder.json.dump());
    EXPECT_EQ(underLedger(importGltf, file).images.at(0).width, 4096);
    EXPECT_THROW(underLedger(importGltf, file, 8 * kMiB), MemoryRefused);
}

TEST(GltfTextures, missingOrBrokenImageIsRefusedByNameWhereTheLoadIsStrict) {
    Builder builder;
    builder.wishes.isStrict = true;
    builder.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    builder.addTexture();
    builder.json["images"][0] = Json::parse(R"({"uri": "gone.png"})");
    EXPECT_NE(builder.error().find("gone.png: there is no such file"), std::string::npos);
    EXPECT_NE(builder.error().find("model.gltf: /images/0: "), std::string::npos);
    builder.json["images"][0] = Json::parse(R"({"uri": "https://example.org/a.png"})");
    EXPECT_NE(builder.error().find("/images/0: its uri 'https://example.org/a.png' is not a relative path"),
              std::string::npos);
    builder.json["images"][0] = Json::parse(R"({"uri": "data:image/png;base64,QUJD"})");
    EXPECT_NE(builder.error().find("/images/0: is in no known picture format"), std::string::npos);
    builder.json["images"][0] = Json::parse(R"({"uri": "data:image/png;base64,*"})");
    EXPECT_NE(builder.error().find("/images/0: its base64 has an invalid character at position 0"), std::string::npos);
    builder.json["images"][0] = Json::object();
    EXPECT_NE(builder.error().find("/images/0: has neither a uri nor a bufferView"), std::string::npos);
    builder.json["textures"][0] = Json::object();
    EXPECT_NE(builder.error().find("/textures/0: has no source in a supported format"), std::string::npos);
}

} // namespace
} // namespace tessera::scenes::gltf::test
