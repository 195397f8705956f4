#include "scenes/import/SceneJsonParts.h"

#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using scenejson::matchesPattern;
using test::SceneFolder;
using testing::ElementsAre;

/// bust.obj twice (materials 0 and 1, both "default") and the lamp (material "brass").
std::string threeParts(const std::string& members) {
    return R"({"tessera": 1, "include": [{"file": "models/bust.obj", "name": "left"},
        {"file": "models/bust.obj", "name": "right"}, {"file": "models/lamp.obj"}], )" +
           members + "}";
}

std::vector<std::string> materialsDrawn(const Scene& scene) {
    std::vector<std::string> names;
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances)
            names.push_back(scene.materials.at(static_cast<std::size_t>(instance.material)).name);
    return names;
}

TEST(SceneJsonOverrides, patternsMatchWholeNames) {
    EXPECT_TRUE(matchesPattern("bust", "bust"));
    EXPECT_FALSE(matchesPattern("bust", "busts"));
    EXPECT_FALSE(matchesPattern("bust", "bus"));
    EXPECT_TRUE(matchesPattern("*", ""));
    EXPECT_TRUE(matchesPattern("b?s*", "bust of a man"));
    EXPECT_FALSE(matchesPattern("b?s", "bs"));
    EXPECT_TRUE(matchesPattern("*a*b*", "xxaxxaxbx"));
    EXPECT_FALSE(matchesPattern("*a*b", "xxaxxaxbx"));
    EXPECT_TRUE(matchesPattern("a**", "a"));
    EXPECT_FALSE(matchesPattern("", "a"));
}

TEST(SceneJsonOverrides, aNodesMaterialReachesAllBelowIt) {
    const SceneFolder folder;
    const std::string chalk = R"("materials": [{"name": "chalk", "model": "lambert"}], "overrides": )";
    const auto drawn = [&](const std::string& overrides) {
        return materialsDrawn(folder.import(threeParts(chalk + overrides)));
    };
    EXPECT_THAT(drawn("[]"), ElementsAre("default", "default", "brass"));
    EXPECT_THAT(drawn(R"([{"node": "left", "material": "chalk"}])"), ElementsAre("chalk", "default", "brass"));
    EXPECT_THAT(drawn(R"([{"node": "bust", "material": "chalk"}])"), ElementsAre("chalk", "chalk", "brass"));
    EXPECT_THAT(drawn(R"([{"node": "*", "material": "chalk"}])"), ElementsAre("chalk", "chalk", "chalk"));
    EXPECT_THAT(drawn(R"([{"node": "?ight", "material": "brass"}])"), ElementsAre("default", "brass", "brass"));
    EXPECT_THAT(drawn(R"([{"node": "*", "material": "chalk"}, {"node": "left", "material": "brass"}])"),
                ElementsAre("brass", "chalk", "chalk"));
}

TEST(SceneJsonOverrides, replacedMaterialsAndTheirPicturesAreDropped) {
    const SceneFolder folder;
    folder.write("models/paint.mtl", "newmtl paint\nmap_Kd ../pictures/specular.tga\n");
    folder.write("models/painted.obj", "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    const Scene scene = folder.import(R"({"tessera": 1, "include": [{"file": "models/painted.obj"}],
        "materials": [{"name": "skin", "model": "lambert", "k_d": {"texture": "pictures/albedo.tga"}}],
        "overrides": [{"node": "painted", "material": "skin"}]})");
    ASSERT_EQ(scene.materials.size(), 1u);
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(std::to_integer<int>(scene.images[0].texels[0]), 10);
}

TEST(SceneJsonOverrides, theDocumentsOwnMaterialIsFoundFirst) {
    const SceneFolder folder;
    const Scene scene = folder.import(threeParts(
        R"("materials": [{"name": "brass", "model": "lambert"}],
           "overrides": [{"node": "left", "material": "brass"}])"));
    EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.nodes[1].instances.at(0).material)).model,
              MaterialModel::Lambert);
}

TEST(SceneJsonOverrides, nodesAndThoseBelowCastShadowsAsTheLastOverrideSays) {
    const SceneFolder folder;
    const Scene scene = folder.import(threeParts(
        R"("overrides": [{"node": "*", "castsShadow": false}, {"node": "left", "castsShadow": true},
                         {"node": "left", "material": "brass"}])"));
    int casting = 0, drawn = 0;
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            ++drawn;
            casting += instance.castsShadow;
            EXPECT_EQ(instance.castsShadow, &node == &scene.nodes[1]);
        }
    }
    EXPECT_EQ(casting, 1);
    EXPECT_GT(drawn, 1);
    EXPECT_TRUE(test::schemaAccepts(threeParts(R"("overrides": [{"node": "left", "castsShadow": true}])")));
    EXPECT_FALSE(test::schemaAccepts(threeParts(R"("overrides": [{"node": "left"}])")));
}

TEST(SceneJsonOverrides, aMaterialOverrideChangesOnlyWhatItGives) {
    const SceneFolder folder;
    const Scene scene = folder.import(
        threeParts(R"("overrides": [{"material": "bra*", "perceptualRoughness": 0.25, "doubleSided": true}])"));
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[2].perceptualRoughness, 0.25f);
    EXPECT_TRUE(scene.materials[2].doubleSided);
    EXPECT_EQ(scene.materials[2].baseColor, glm::vec4(0.8f, 0.8f, 0.8f, 1));
    EXPECT_EQ(scene.materials[2].metallic, 0.0f);
    EXPECT_EQ(scene.materials[0].perceptualRoughness, 0.5f);
}

TEST(SceneJsonOverrides, aMaterialOverrideMayChangeTheModel) {
    const SceneFolder folder;
    const Scene scene = folder.import(threeParts(
        R"("overrides": [{"material": "default", "model": "microfacet", "alpha": 0.125},
                         {"material": "default", "ior": 2}])"));
    for (const std::size_t i : {0u, 1u}) {
        EXPECT_EQ(scene.materials[i].model, MaterialModel::Microfacet);
        EXPECT_EQ(scene.materials[i].alpha, 0.125f);
        EXPECT_EQ(scene.materials[i].ior, 2.0f);
        EXPECT_EQ(scene.materials[i].baseColor, glm::vec4(0.8f, 0.8f, 0.8f, 1));
    }
}

TEST(SceneJsonOverrides, nullRemovesATexture) {
    const SceneFolder folder;
    folder.write("models/paint.mtl", "newmtl paint\nmap_Kd ../pictures/specular.tga\nnorm ../pictures/normal.tga\n");
    folder.write("models/painted.obj", "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    const Scene scene = folder.import(R"({"tessera": 1, "include": [{"file": "models/painted.obj"}],
        "overrides": [{"material": "paint", "baseColor": {"texture": null}, "normalMap": null}]})");
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::BaseColor).image, kNone);
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::Normal).image, kNone);
}

TEST(SceneJsonOverrides, anOverrideThatMatchesNothingIsRefusedWithTheNearest) {
    const SceneFolder folder;
    const auto errorOf = [&](const std::string& members) { return folder.errorBeyondSchemaOf(threeParts(members)); };
    EXPECT_EQ(errorOf(R"("overrides": [{"node": "lift", "material": "brass"}])"),
              "/overrides/0/node: there is no node 'lift'; did you mean 'left'?");
    EXPECT_EQ(errorOf(R"("overrides": [{"node": "left", "material": "bras"}])"),
              "/overrides/0/material: there is no material 'bras'; did you mean 'brass'?");
    EXPECT_EQ(errorOf(R"("overrides": [{"material": "gold", "metallic": 1}])"),
              "/overrides/0/material: there is no included material 'gold'; valid are default, brass");
    EXPECT_EQ(
        errorOf(R"("overrides": [{"material": "brass", "k_d": [1, 1, 1]}])"),
        "/overrides/0: a metallic_roughness material has no key 'k_d'; valid are material, model, baseColor, "
        "metallic, perceptualRoughness, ior, specularFactor, specularColor, metallicRoughnessTexture, "
        "anisotropyStrength, anisotropyRotationDegrees, anisotropyTexture, emissive, emissiveStrength, clearcoat, "
        "clearcoatPerceptualRoughness, clearcoatNormalMap, sheenColor, sheenPerceptualRoughness, iridescence, "
        "iridescenceIor, iridescenceThicknessNm, iridescenceLeastThicknessNm, transmission, "
        "thicknessMetres, attenuationColor, attenuationDistanceMetres, dispersion, normalMap, occlusionMap, tangents, "
        "subsurface, alphaMode, alphaCutoff, doubleSided, castsShadow, fields");
    EXPECT_EQ(folder.errorOf(threeParts(R"("overrides": [{"node": "left"}])")),
              "/overrides/0/node: is overridden by nothing; add a 'material' or 'castsShadow'");
    EXPECT_EQ(folder.errorOf(threeParts(R"("overrides": [{"k_d": [1, 1, 1]}])")),
              "/overrides/0: names neither a 'node' nor a 'material' to override");
    EXPECT_EQ(folder.errorOf(threeParts(R"("overrides": [{"node": "left", "material": "brass", "metallic": 1}])")),
              "/overrides/0: an override of a node has no key 'metallic'; valid are node, material, "
              "castsShadow");
    folder.write("parts/empty.json", R"({"tessera": 1})");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "include": [{"file": "parts/empty.json"}],
                  "materials": [{"name": "m", "model": "lambert"}],
                  "overrides": [{"node": "empty", "material": "m"}]})"),
              "/overrides/0/node: nothing is drawn at or below the nodes 'empty'; name one that has a mesh");
}

} // namespace
} // namespace tessera::scenes
