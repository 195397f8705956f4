// Materials of glTF files and their extensions, without textures and variants.

#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

TEST(GltfMaterials, factorsAreImportedExactly) {
    const Material material = importedMaterial(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4],
        "metallicFactor": 0.5, "roughnessFactor": 0.25}, "emissiveFactor": [1, 2, 3], "doubleSided": true})");
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.model, MaterialModel::MetallicRoughness);
    expectMembers(material, "baseColor 0.1 0.2 0.3 0.4, metallic 0.5, perceptualRoughness 0.25, emissive 1 2 3, "
                            "doubleSided 1");
}

TEST(GltfMaterials, defaultsAreThoseOfTheSpecification) {
    const Material material = importedMaterial("{}");
    expectMembers(material,
                  "baseColor 1 1 1 1, metallic 1, perceptualRoughness 1, emissive 0 0 0, ior 1.5, doubleSided 0");
    EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
    for (const TextureUse& use : material.textures) EXPECT_EQ(use.image, kNone);
}

TEST(GltfMaterials, factorsOfExtensionsAreImportedExactly) {
    for (const auto& [extensions, members] : {
             std::pair(R"("KHR_materials_transmission": {"transmissionFactor": 0.75})", "transmission 0.75"),
             {R"("KHR_materials_transmission": {})", "transmission 0"},
             {R"("KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 2,
                                          "attenuationColor": [0.25, 0.5, 1]})",
              "thicknessMetres 0.5, attenuationDistanceMetres 2, attenuationColor 0.25 0.5 1"},
             {R"("KHR_materials_volume": {})", // nothing is absorbed
              "thicknessMetres 0, attenuationDistanceMetres 0, attenuationColor 1 1 1"},
             {R"("KHR_materials_dispersion": {"dispersion": 0.375})", "dispersion 0.375"},
             {R"("KHR_materials_dispersion": {})", "dispersion 0"},
             {R"("KHR_materials_iridescence": {"iridescenceFactor": 0.75, "iridescenceIor": 1.5,
                  "iridescenceThicknessMinimum": 50, "iridescenceThicknessMaximum": 250})",
              "iridescence 0.75, iridescenceIor 1.5, iridescenceThicknessNm 250, iridescenceLeastThicknessNm 50"},
             {R"("KHR_materials_iridescence": {})",
              "iridescence 0, iridescenceIor 1.3, iridescenceThicknessNm 400, iridescenceLeastThicknessNm 100"},
             {R"("KHR_materials_ior": {"ior": 1.25})", "ior 1.25"},
             {R"("KHR_materials_ior": {})", "ior 1.5"},
             {R"("KHR_materials_ior": {"ior": 65536})", "ior 65536"},
             {R"("KHR_materials_ior": {"ior": 0})", "ior 0"},
             {R"("KHR_materials_specular": {"specularFactor": 0.25, "specularColorFactor": [1, 2, 0.5]})",
              "specularFactor 0.25, specularColor 1 2 0.5"},
             {R"("KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 1.5})",
              "anisotropyStrength 0.6, anisotropyRotationRadians 1.5"},
             {R"("KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25,
                                             "clearcoatNormalTexture": {"index": 0, "scale": 2}})",
              "clearcoat 0.5, clearcoatPerceptualRoughness 0.25, clearcoatNormalScale 2"},
             {R"("KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.75})",
              "sheenColor 0.1 0.2 0.3, sheenPerceptualRoughness 0.75"},
         }) {
        SCOPED_TRACE(extensions);
        expectMembers(importedMaterial((std::string(R"({"extensions": {)") + extensions + "}}").c_str()), members);
    }
}

/// Imports a pane that is 0.5 thick in mesh space.
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
    // Rotated, below a parent, and two with the same scale.
    expectThickness(paneOf(R"([{"children": [1, 2], "scale": [0.5, 0.5, 0.5]},
                               {"mesh": 0, "scale": [4, 4, 4], "rotation": [0.6, 0, 0, 0.8]},
                               {"mesh": 0, "scale": [4, 4, 4], "translation": [1, 2, 3]}])"),
                    1.0f);
    // The second is scaled to nothing and the third is not in the scene; neither counts.
    expectThickness(
        paneOf(R"([{"mesh": 0, "scale": [3, 3, 3]}, {"mesh": 0, "scale": [0, 0, 0]}, {"mesh": 0}])", "[0, 1]"), 1.5f);
}

TEST(GltfMaterials, aThicknessWithoutOneScaleStaysAsItIsWithAWarning) {
    for (const char* nodes :
         {R"([{"mesh": 0, "scale": [1, 1, 2]}])",
          R"([{"mesh": 0, "matrix": [1,0,0,0, 0.6,0.8,0,0, 0,0,1,0, 0,0,0,1]}])", // sheared
          R"([{"mesh": 0, "scale": [3, 3, 3], "children": [1]}, {"mesh": 0, "scale": [1, 1, 2]}])",
          // The square of its scale is infinite.
          R"([{"scale": [1e38, 1e38, 1e38], "children": [1]}, {"scale": [1e38, 1e38, 1e38], "children": [2]},
              {"scale": [1e38, 1e38, 1e38], "children": [3]}, {"scale": [1e38, 1e38, 1e38], "children": [4]},
              {"mesh": 0, "scale": [1e38, 1e38, 1e38]}])"}) {
        const Scene scene = paneOf(nodes);
        EXPECT_EQ(scene.materials.at(0).thicknessMetres, 0.5f) << nodes;
        EXPECT_TRUE(hasWarning(scene, kNoOneScale)) << nodes;
    }
}

TEST(GltfMaterials, aMaterialThatNodesShowAtSeveralScalesIsAsThickAsEachMakesIt) {
    const Scene scene = paneOf(R"([{"mesh": 0, "scale": [3, 3, 3], "children": [1, 2]},
                                   {"mesh": 0, "scale": [2, 2, 2]}, {"mesh": 0}])");
    EXPECT_FALSE(hasWarning(scene, kNoOneScale));
    ASSERT_EQ(scene.materials.size(), 2u);
    for (const auto& [node, wantedMetres] : {std::pair<std::size_t, float>(0, 1.5f), {1, 3.0f}, {2, 1.5f}}) {
        const auto material = std::size_t(scene.nodes.at(node).instances.at(0).material);
        EXPECT_FLOAT_EQ(scene.materials.at(material).thicknessMetres, wantedMetres) << node;
        EXPECT_EQ(scene.materials.at(material).attenuationDistanceMetres, 2.0f);
    }
    EXPECT_NE(scene.materials[0].name, scene.materials[1].name);
    checkScene(scene);
}

TEST(GltfMaterials, alphaModesAreImportedExactly) {
    const Material mask = importedMaterial(R"({"alphaMode": "MASK", "alphaCutoff": 0.75})");
    EXPECT_EQ(mask.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(mask.alphaCutoff, 0.75f);
    EXPECT_EQ(importedMaterial(R"({"alphaMode": "MASK"})").alphaCutoff, 0.5f);
    EXPECT_EQ(importedMaterial(R"({"alphaMode": "BLEND"})").alphaMode, AlphaMode::Blend);
}

TEST(GltfMaterials, everyTextureLandsInItsSlot) {
    using enum TextureSlot;
    struct Place {
        TextureSlot slot;
        const char* owner; ///< the object that has it
        const char* key;
    };
    constexpr Place kPlaces[] = {
        {BaseColor, "pbrMetallicRoughness", "baseColorTexture"},
        {MetallicRoughness, "pbrMetallicRoughness", "metallicRoughnessTexture"},
        {Normal, "", "normalTexture"},
        {Emissive, "", "emissiveTexture"},
        {Occlusion, "", "occlusionTexture"},
        {SpecularFactor, "extensions/KHR_materials_specular", "specularTexture"},
        {SpecularColor, "extensions/KHR_materials_specular", "specularColorTexture"},
        {Anisotropy, "extensions/KHR_materials_anisotropy", "anisotropyTexture"},
        {Clearcoat, "extensions/KHR_materials_clearcoat", "clearcoatTexture"},
        {ClearcoatRoughness, "extensions/KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
        {ClearcoatNormal, "extensions/KHR_materials_clearcoat", "clearcoatNormalTexture"},
        {SheenColor, "extensions/KHR_materials_sheen", "sheenColorTexture"},
        {SheenRoughness, "extensions/KHR_materials_sheen", "sheenRoughnessTexture"},
        {Transmission, "extensions/KHR_materials_transmission", "transmissionTexture"},
        {Thickness, "extensions/KHR_materials_volume", "thicknessTexture"},
        {Iridescence, "extensions/KHR_materials_iridescence", "iridescenceTexture"},
        {IridescenceThickness, "extensions/KHR_materials_iridescence", "iridescenceThicknessTexture"}};
    EXPECT_EQ(std::size(kPlaces) + 1, kTextureSlotCount) << "all but that of the index of refraction, which glTF lacks";
    for (const Place& place : kPlaces) {
        Json patch;
        const std::string pointer = std::string(*place.owner == '\0' ? "" : "/") + place.owner + "/" + place.key;
        patch[Json::json_pointer(pointer)]["index"] = 0;
        const Material material = importedMaterial(patch.dump().c_str());
        for (std::size_t i = 0; i < kTextureSlotCount; ++i)
            EXPECT_EQ(material.textures[i].image, i == std::size_t(place.slot) ? 0 : kNone) << pointer;
    }
}

TEST(GltfMaterials, scalesAndStrengthsAreImportedExactly) {
    for (const auto& [patch, member] :
         {std::pair(R"({"normalTexture": {"index": 0, "scale": 0.5}})", "normalScale 0.5"),
          {R"({"normalTexture": {"index": 0}})", "normalScale 1"},
          {R"({"occlusionTexture": {"index": 0, "strength": 0.25}})", "occlusionStrength 0.25"},
          {R"({"occlusionTexture": {"index": 0}})", "occlusionStrength 1"},
          {R"({"emissiveFactor": [1, 0.5, 0],
               "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})",
           "emissive 8 4 0"}})
        expectMembers(importedMaterial(patch), member);
}

TEST(GltfMaterials, unlitIsASingleColor) {
    const Material material = importedMaterial(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1],
        "baseColorTexture": {"index": 0}}, "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_unlit": {}}})");
    EXPECT_EQ(material.model, MaterialModel::SingleColor);
    expectMembers(material, "baseColor 0.5 0.25 1 1, emissive 0 0 0");
    EXPECT_EQ(material.texture(TextureSlot::BaseColor).image, 0);
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
    expectMembers(scene.materials.at(0), "clearcoat 0, ior 1.5");
    EXPECT_TRUE(scene.images.empty());
    EXPECT_THAT(unlitWith(R"({"clearcoatFactor": 2})").error(),
                HasSubstr("clearcoatFactor: is 2; it must be at most 1"));
}

TEST(GltfMaterials, layersAreOffByDefaultAndNeverWarnedOf) {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_materials_anisotropy", "KHR_materials_clearcoat",
                                         "KHR_materials_sheen"]})");
    builder.material().merge_patch(Json::parse(R"({"extensions": {"KHR_materials_anisotropy": {},
        "KHR_materials_clearcoat": {}, "KHR_materials_sheen": {}}})"));
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    expectMembers(scene.materials.at(0), "anisotropyStrength 0, clearcoat 0, sheenColor 0 0 0");
}

TEST(GltfMaterials, layersOutOfRangeAreRefused) {
    for (const auto& [extension, error] :
         {std::pair(R"("KHR_materials_anisotropy": {"anisotropyStrength": 1.5})", ""),
          {R"("KHR_materials_clearcoat": {"clearcoatFactor": -1})", ""},
          {R"("KHR_materials_clearcoat": {"clearcoatRoughnessFactor": 2})", ""},
          {R"("KHR_materials_sheen": {"sheenColorFactor": [0, 0, 2]})", ""},
          {R"("KHR_materials_sheen": {"sheenColorFactor": [0, 0]})", ""},
          {R"("KHR_materials_sheen": {"sheenColorTexture": {"index": 9}})", ""},
          {R"("KHR_materials_iridescence": {"iridescenceIor": 0.5})", "iridescenceIor: is 0.5"},
          {R"("KHR_materials_volume": {"attenuationDistance": 0})",
           "attenuationDistance: is 0; more than 0 is needed"}}) {
        const std::string found = withMaterial((std::string(R"({"extensions": {)") + extension + "}}").c_str()).error();
        EXPECT_NE(found, "") << extension;
        EXPECT_THAT(found, HasSubstr(error)) << extension;
    }
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
    expectMembers(material, "baseColor 0.1 0.2 0.3 0.4, metallic 0, perceptualRoughness 0.25");
    expectMembers(material, "specularColor 0.5 0.6 0.7, ior 0"); // an index of 0 makes F0 the specular colour
    EXPECT_TRUE(scene.images.empty()) << "what stands in for programs without the extension is not read";
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_THAT(scene.notes[0], HasSubstr("(KHR_materials_pbrSpecularGlossiness) are converted"));
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

} // namespace
} // namespace tessera::scenes::gltf::test
