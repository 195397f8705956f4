#include "scenes/import/SceneJsonParts.h"

#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using scenejson::matchesPattern;
using SceneJsonOverrides = SceneFiles;

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
            names.push_back(scene.materials.at(std::size_t(instance.material)).name);
    return names;
}

TEST_F(SceneJsonOverrides, patternsMatchWholeNames) {
    for (const auto& [pattern, name] :
         {std::pair("bust", "bust"), {"*", ""}, {"b?s*", "bust of a man"}, {"*a*b*", "xxaxxaxbx"}, {"a**", "a"}})
        EXPECT_TRUE(matchesPattern(pattern, name)) << pattern << ' ' << name;
    for (const auto& [pattern, name] :
         {std::pair("bust", "busts"), {"bust", "bus"}, {"b?s", "bs"}, {"*a*b", "xxaxxaxbx"}, {"", "a"}})
        EXPECT_FALSE(matchesPattern(pattern, name)) << pattern << ' ' << name;
}

TEST_F(SceneJsonOverrides, aNodesMaterialReachesAllBelowIt) {
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

TEST_F(SceneJsonOverrides, replacedMaterialsAndTheirPicturesAreDropped) {
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

TEST_F(SceneJsonOverrides, theDocumentsOwnMaterialIsFoundFirst) {
    const Scene scene = folder.import(threeParts(
        R"("materials": [{"name": "brass", "model": "lambert"}],
           "overrides": [{"node": "left", "material": "brass"}])"));
    EXPECT_EQ(scene.materials.at(std::size_t(scene.nodes[1].instances.at(0).material)).model, MaterialModel::Lambert);
}

TEST_F(SceneJsonOverrides, nodesAndThoseBelowCastShadowsAsTheLastOverrideSays) {
    const Scene scene = folder.import(threeParts(
        R"("overrides": [{"node": "*", "castsShadow": false}, {"node": "left", "castsShadow": true},
                         {"node": "left", "material": "brass"}])"));
    ASSERT_EQ(scene.nodes[1].instances.size(), 1u);
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) EXPECT_EQ(instance.castsShadow, &node == &scene.nodes[1]);
    EXPECT_TRUE(test::schemaAccepts(threeParts(R"("overrides": [{"node": "left", "castsShadow": true}])")));
    EXPECT_FALSE(test::schemaAccepts(threeParts(R"("overrides": [{"node": "left"}])")));
}

TEST_F(SceneJsonOverrides, aMaterialOverrideChangesOnlyWhatItGives) {
    const Scene scene = folder.import(
        threeParts(R"("overrides": [{"material": "bra*", "perceptualRoughness": 0.25, "doubleSided": true}])"));
    ASSERT_EQ(scene.materials.size(), 3u);
    expectMembers(scene.materials[2], "perceptualRoughness 0.25, doubleSided 1, baseColor 0.8 0.8 0.8 1, metallic 0");
    expectMembers(scene.materials[0], "perceptualRoughness 0.5");
}

TEST_F(SceneJsonOverrides, aMaterialOverrideMayChangeTheModel) {
    const Scene scene = folder.import(threeParts(
        R"("overrides": [{"material": "default", "model": "microfacet", "alpha": 0.125},
                         {"material": "default", "ior": 2}])"));
    for (const std::size_t i : {0u, 1u}) {
        EXPECT_EQ(scene.materials[i].model, MaterialModel::Microfacet);
        expectMembers(scene.materials[i], "alpha 0.125, ior 2, baseColor 0.8 0.8 0.8 1");
    }
}

TEST_F(SceneJsonOverrides, nullRemovesATexture) {
    folder.write("models/paint.mtl", "newmtl paint\nmap_Kd ../pictures/specular.tga\nnorm ../pictures/normal.tga\n");
    folder.write("models/painted.obj", "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    const Scene scene = folder.import(R"({"tessera": 1, "include": [{"file": "models/painted.obj"}],
        "overrides": [{"material": "paint", "baseColor": {"texture": null}, "normalMap": null}]})");
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::BaseColor).image, kNone);
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::Normal).image, kNone);
}

TEST_F(SceneJsonOverrides, anOverrideThatMatchesNothingIsRefusedWithTheNearest) {
    const auto overridden = [](const std::string& members) {
        return threeParts(R"("overrides": [{)" + members + "}]");
    };
    for (const auto& [members, error] :
         {std::pair(R"("node": "lift", "material": "brass")", "/node: there is no node 'lift'; did you mean 'left'?"),
          {R"("node": "left", "material": "bras")", "/material: there is no material 'bras'; did you mean 'brass'?"},
          {R"("material": "gold", "metallic": 1)",
           "/material: there is no included material 'gold'; valid are default, brass"},
          {R"("material": "brass", "k_d": [1, 1, 1])",
           ": a metallic_roughness material has no key 'k_d'; valid are material, model, baseColor, "
           "metallic, perceptualRoughness, ior, specularFactor, specularColor, metallicRoughnessTexture, "
           "anisotropyStrength, anisotropyRotationDegrees, anisotropyTexture, emissive, emissiveStrength, clearcoat, "
           "clearcoatPerceptualRoughness, clearcoatNormalMap, sheenColor, sheenPerceptualRoughness, iridescence, "
           "iridescenceIor, iridescenceThicknessNm, iridescenceLeastThicknessNm, transmission, "
           "thicknessMetres, attenuationColor, attenuationDistanceMetres, dispersion, normalMap, occlusionMap, "
           "tangents, subsurface, alphaMode, alphaCutoff, doubleSided, castsShadow, fields"}})
        EXPECT_EQ(folder.errorBeyondSchemaOf(overridden(members)), std::string("/overrides/0") + error);
    for (const auto& [members, error] :
         {std::pair(R"("node": "left")", "/node: is overridden by nothing; add a 'material' or 'castsShadow'"),
          {R"("k_d": [1, 1, 1])", ": names neither a 'node' nor a 'material' to override"},
          {R"("node": "left", "material": "brass", "metallic": 1)",
           ": an override of a node has no key 'metallic'; valid are node, material, castsShadow"}})
        EXPECT_EQ(folder.errorOf(overridden(members)), std::string("/overrides/0") + error);
    folder.write("parts/empty.json", R"({"tessera": 1})");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "include": [{"file": "parts/empty.json"}],
                  "materials": [{"name": "m", "model": "lambert"}],
                  "overrides": [{"node": "empty", "material": "m"}]})"),
              "/overrides/0/node: nothing is drawn at or below the nodes 'empty'; name one that has a mesh");
}

} // namespace
} // namespace tessera::scenes
