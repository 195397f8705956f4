// Materials of points and lines.

#include "tests/unit/scenes/gltf/AnimationBuilder.h"
#include "tests/unit/scenes/gltf/ThinSolids.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Adds a triangle of the same material beside the points or lines.
void addTriangle(Builder& builder) {
    builder.json["meshes"][0]["primitives"].push_back(Json::parse(R"({"attributes": {"POSITION": 0}, "material": 0})"));
}

TEST(GltfThinSolidMaterials, withoutNormalsTheyShowBaseColourAndEmissionUnlit) {
    Builder builder = thin(0);
    builder.material().merge_patch(Json::parse(R"({"emissiveFactor": [0.5, 0, 0.25], "alphaMode": "MASK",
        "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 0.5]}})"));
    addTriangle(builder);
    const Scene scene = builder.import();
    const auto expectMaterial = [](const Material& material, const char* name, MaterialModel model,
                                   const glm::vec4& color) {
        EXPECT_EQ(material.name, name);
        EXPECT_EQ(material.model, model) << name;
        EXPECT_EQ(material.baseColor, color) << name;
    };
    expectMaterial(materialOf(scene), "paint, unlit", MaterialModel::SingleColor, {0.75f, 0.5f, 1.0f, 0.5f});
    EXPECT_EQ(materialOf(scene).alphaMode, AlphaMode::Mask);
    expectMaterial(materialOf(scene, 1), "paint", MaterialModel::MetallicRoughness, {0.25f, 0.5f, 0.75f, 0.5f});
    expectMaterial(materialOf(thin(3).import()), "default, unlit", MaterialModel::SingleColor, glm::vec4(1.0f));
}

TEST(GltfThinSolidMaterials, aMaterialThatIsUnlitAnywayStaysOne) {
    Builder builder = thin(0);
    builder.material().merge_patch(Json::parse(R"({"extensions": {"KHR_materials_unlit": {}}})"));
    addTriangle(builder);
    const Scene scene = builder.import();
    EXPECT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(materialOf(scene).name, "paint");
}

TEST(GltfThinSolidMaterials, emissionBesideTexturesIsLeftOutWithAWarning) {
    Builder builder = thin(0);
    builder.material().merge_patch(Json::parse(R"({"emissiveFactor": [1, 1, 1],
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "baseColorTexture": {"index": 0}}})"));
    builder.addTexture();
    const Scene scene = builder.import();
    EXPECT_EQ(materialOf(scene).baseColor, glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    EXPECT_NE(materialOf(scene).texture(TextureSlot::BaseColor).image, kNone);
    EXPECT_TRUE(hasWarning(scene, "/materials/0: its emission is left out at points and lines"));
}

TEST(GltfThinSolidMaterials, diffuseColoursOfSpecularGlossinessAreShownToo) {
    Builder builder = thin(0);
    builder.material().merge_patch(Json::parse(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [0.5, 0.25, 0, 1]}}})"));
    EXPECT_EQ(materialOf(builder.import()).baseColor, glm::vec4(0.5f, 0.25f, 0.0f, 1.0f));
}

TEST(GltfThinSolidMaterials, withNormalsTheyAreLitByThoseOfTheirFacesWithoutNormalMaps) {
    Builder builder = thin(1, {0, 0, 0, 1, 0, 0});
    addNormals(builder, 2);
    builder.material();
    const Scene plain = builder.import();
    EXPECT_EQ(materialOf(plain).model, MaterialModel::MetallicRoughness);
    EXPECT_EQ(materialOf(plain).name, "paint");
    EXPECT_GT(volumeOf(plain.meshes.at(0), 0), 0.0); // with the normals of faces
    builder.json["materials"][0]["normalTexture"] = {{"index", 0}};
    builder.json["materials"][0]["emissiveTexture"] = {{"index", 0}};
    builder.addTexture();
    const Scene mapped = builder.import();
    EXPECT_EQ(materialOf(mapped).name, "paint, without texture coordinates, without normal maps");
    EXPECT_EQ(materialOf(mapped).texture(TextureSlot::Normal).image, kNone);
    EXPECT_NE(materialOf(mapped).texture(TextureSlot::Emissive).image, kNone);
}

TEST(GltfThinSolidMaterials, variantsAreUnlitToo) {
    Builder builder = thin(1);
    builder.merge(R"({"extensionsUsed": ["KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}]}},
        "materials": [{"name": "paint"}, {"name": "ruby"}]})");
    builder.primitive()["material"] = 0;
    builder.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
        Json::parse(R"([{"material": 1, "variants": [0]}])");
    builder.importOptions.variant = "red";
    EXPECT_EQ(materialOf(builder.import()).name, "ruby, unlit");
}

TEST(GltfThinSolidMaterials, clipsChangeTheColourOfBothMaterials) {
    Builder builder = thin(0);
    builder.material();
    addTriangle(builder);
    addPointer(builder, "/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1, 1, 0, 0, 0, 1});
    addPointer(builder, "/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.rig.clips.at(0).channels.size(), 2u);
    EXPECT_EQ(scene.rig.clips.at(1).channels.size(), 1u) << "what is unlit has no metalness";
}

TEST(GltfThinSolidMaterials, aClipOfTheColourLeavesOutWhatHoldsEmissionToo) {
    Builder builder = thin(0);
    builder.material()["emissiveFactor"] = {1, 0, 0};
    addPointer(builder, "/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1, 1, 0, 0, 0, 1});
    const Scene scene = builder.import();
    EXPECT_THAT(scene.rig.clips.at(0).channels, IsEmpty());
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("/materials/0: a clip of its base colour is left out at points")));
}

} // namespace
} // namespace tessera::scenes::gltf::test
