#include "base/Error.h"
#include "scenes/Load.h"
#include "tests/support/AssetsFolder.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/json/SceneFiles.h"
#include "tests/unit/scenes/write/SameScene.h"

namespace tessera::scenes {
namespace {

using namespace test;
using SceneJsonBase = SceneFiles;
using SceneJsonFields = SceneFiles;

std::string basedOnLamps(const std::string& members) {
    return R"({"tessera": 1, "base": {"file": "parts/lamps.json"})" + members + "}";
}

TEST_F(SceneJsonBase, aBaseAloneIsExactlyTheSceneItself) {
    const Scene base = loadScene((folder.path() / "parts" / "lamps.json").string());
    expectSameScene(folder.import(basedOnLamps(R"(, "name": "lamps")")), base);
    EXPECT_EQ(folder.import(basedOnLamps("")).name, "scene") << "named after the file";
}

TEST_F(SceneJsonBase, aBuiltinBaseMakesAsManyLightsAsRequested) {
    expectSameScene(
        folder.import(R"({"tessera": 1, "name": "lattice", "base": {"file": "builtin:lattice", "lights": 7}})"),
        loadScene("lattice", loading(&LoadOptions::lights, 7)));
}

TEST_F(SceneJsonBase, aBuiltinBaseMayKeepToItsOwnModels) {
    folder.write("LeePerrySmith/head.obj", "v 0 0\n");
    const tessera::test::AssetsFolder assets(folder.path().c_str());
    const auto based = [&](const char* more) {
        return folder.import(std::string(R"({"tessera": 1, "name": "head", "base": {"file": "builtin:head")") + more +
                             "}}");
    };
    EXPECT_THROW(based(""), InputError) << "the folder's model is taken";
    expectSameScene(based(R"(, "assets": false)"), loadScene("head", loading(&LoadOptions::useAssets, false)));
}

TEST_F(SceneJsonBase, lightsCamerasBackgroundAndOptionsReplaceThoseOfTheBase) {
    const Scene scene = folder.import(basedOnLamps(R"(,
        "lights": [], "cameras": [{"name": "a", "position": [0, 0, 1], "target": [0, 0, 0]}],
        "environment": {"background": [1, 2, 3]}, "options": {"layout": "packed", "defaultLight": false})"));
    EXPECT_TRUE(scene.lights.empty());
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "a");
    EXPECT_EQ(scene.background, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(scene.options.requested.at("layout"), OptionValue("packed"));
    EXPECT_EQ(scene.options.defaultLight, false);
    EXPECT_FALSE(scene.options.requested.contains("technique")) << "of the base";
}

TEST_F(SceneJsonBase, aMaterialThatReplacesTakesThePlaceOfTheBases) {
    folder.write("painted.json", R"({"tessera": 1, "include": [{"file": "models/bust.obj"}],
        "materials": [{"name": "skin", "model": "lambert", "k_d": {"texture": "pictures/albedo.tga"}}],
        "overrides": [{"node": "bust", "material": "skin"}]})");
    const Scene scene = folder.import(R"({"tessera": 1, "base": {"file": "painted.json"},
        "materials": [{"replaces": 0, "name": "gold", "model": "metallic_roughness",
                       "baseColor": {"factor": [1, 0.8, 0.3], "texture": {"image": 0, "texCoord": 1}}}]})");
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "gold");
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::BaseColor).image, 0);
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::BaseColor).texCoordSet, 1);
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(SceneJsonBase, aVariantOfABaseOrAnIncludeIsShownUnlessAnotherIsRequested) {
    folder.write("car.gltf", kCar);
    const auto worn = [](const Scene& scene) {
        std::string names;
        for (const Node& node : scene.nodes)
            for (const MeshInstance& instance : node.instances)
                names += scene.materials.at(std::size_t(instance.material)).name + " ";
        return names;
    };
    EXPECT_EQ(worn(folder.import(R"({"tessera": 1, "base": {"file": "car.gltf", "variant": "red"}})")), "ruby ");
    const std::string cars = R"({"tessera": 1, "include": [{"file": "car.gltf"}, {"file": "car.gltf", "variant": "red"},
        {"file": "car.gltf"}, {"file": "car.gltf", "variant": "red"}]})";
    EXPECT_EQ(worn(folder.import(cars)), "paint ruby paint ruby ");
    LoadOptions red;
    red.import.variant = "red";
    EXPECT_EQ(worn(loadScene(folder.file("cars.json", cars), red)), "ruby ruby ruby ruby ");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "base": {"file": "car.gltf", "variant": "rde"}})"),
              "/base/variant: there is no variant 'rde'; did you mean 'red'?");
}

TEST_F(SceneJsonBase, aSceneThatRequestsNoDefaultLightNeverGetsOne) {
    const auto isLit = [&](const std::string& members) {
        const std::string text = R"({"tessera": 1, "include": [{"file": "models/bust.obj"}])" + members + "}";
        return loadScene(folder.file("dark.json", text)).environment.has_value();
    };
    EXPECT_TRUE(isLit(""));
    EXPECT_TRUE(isLit(R"(, "options": {"defaultLight": true})"));
    EXPECT_FALSE(isLit(R"(, "options": {"defaultLight": false})"));
}

TEST_F(SceneJsonFields, membersAreSetLastAndWhateverTheType) {
    const Scene scene = folder.import(R"({"tessera": 1,
        "lights": [{"type": "point", "position": [0, 0, 0], "falloff": {"type": "inverse_square", "range": 3},
                    "fields": {"outerConeRadians": 0.25, "rangeMetres": null, "animation": {"kind": "wobble"}}}],
        "cameras": [{"position": [0, 0, 1], "target": [0, 0, 0], "fields": {"halfHeightMetres": 7}}],
        "materials": [{"name": "a", "model": "lambert", "fields": {"alphaY": 0.75, "masking": "directional"}}]})");
    EXPECT_EQ(scene.lights.at(0).outerConeRadians, 0.25f);
    EXPECT_EQ(scene.lights[0].rangeMetres, kInfinity);
    EXPECT_EQ(scene.lights[0].animation.value().kind, LightAnimationKind::Wobble);
    EXPECT_EQ(scene.cameras.at(0).halfHeightMetres, 7.0);
    EXPECT_EQ(scene.materials.at(0).alphaY, 0.75f);
    EXPECT_EQ(scene.materials[0].masking, Masking::Directional);
}

TEST_F(SceneJsonBase, mistakesAreNamedWithTheirPlace) {
    const auto based = [](const std::string& base) { return R"({"tessera": 1, "base": {"file": )" + base + "}}"; };
    const auto material = [](const std::string& members) {
        return R"("materials": [{"name": "a", "model": "lambert", )" + members + "}]";
    };
    for (const auto& [text, error] :
         {std::pair<std::string, const char*>(
              based(R"("models/bust.obj", "lights": 3)"),
              "/base/lights: only a built-in scene makes a requested number of lights; remove it"),
          {based(R"("models/bust.obj", "assets": false)"),
           "/base/assets: only a built-in scene chooses between models of TESSERA_ASSETS and its own; remove it"},
          {based(R"("builtin:hal")"), "/base/file: there is no built-in scene 'hal'; did you mean 'hall'?"},
          {based(R"("scene.json")"),
           "/base/file: includes itself: scene.json -> scene.json; remove one of the includes"},
          {basedOnLamps(", " + material(R"("replaces": 1)")), "/materials/0/replaces: is 1; at most 0 is allowed"},
          {R"({"tessera": 1, )" + material(R"("replaces": 0)") + "}",
           "/materials/0/replaces: there is no material of a base to replace; remove it"},
          {basedOnLamps(", " + material(R"("normalMap": {"image": 0})")),
           "/materials/0/normalMap/image: there is no picture of a base; name a 'file'"},
          {R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0, 0], "fields": {"colour": 1}}]})",
           "/lights/0/fields: a light's fields has no key 'colour'; did you mean 'color'?"}})
        EXPECT_EQ(folder.errorBeyondSchemaOf(text), error);
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, )" +
                             material(R"("normalMap": {"image": 0, "file": "pictures/normal.tga"})") + "}"),
              "/materials/0/normalMap/file: is given beside 'image'; keep one");
}

} // namespace
} // namespace tessera::scenes
