#include "base/Error.h"
#include "scenes/Load.h"
#include "tests/support/AssetsFolder.h"
#include "tests/unit/scenes/json/SceneFiles.h"
#include "tests/unit/scenes/write/SameScene.h"

namespace tessera::scenes {
namespace {

using test::SceneFolder;

constexpr const char* kLamps = R"("tessera": 1, "base": {"file": "parts/lamps.json"})";

std::string basedOnLamps(const std::string& members) {
    return std::string("{") + kLamps + members + "}";
}

TEST(SceneJsonBase, aBaseAloneIsExactlyTheSceneItself) {
    const SceneFolder folder;
    const Scene base = loadScene((folder.path() / "parts" / "lamps.json").string());
    expectSameScene(folder.import(basedOnLamps(R"(, "name": "lamps")")), base);
    EXPECT_EQ(folder.import(basedOnLamps("")).name, "scene") << "named after the file";
}

TEST(SceneJsonBase, aBuiltinBaseMakesAsManyLightsAsAsked) {
    const SceneFolder folder;
    LoadOptions seven;
    seven.lights = 7;
    expectSameScene(
        folder.import(R"({"tessera": 1, "name": "lattice", "base": {"file": "builtin:lattice", "lights": 7}})"),
        loadScene("lattice", seven));
}

TEST(SceneJsonBase, aBuiltinBaseMayKeepToItsOwnModels) {
    const SceneFolder folder;
    folder.write("LeePerrySmith/head.obj", "v 0 0\n");
    const tessera::test::AssetsFolder assets(folder.path().c_str());
    const auto based = [&](const char* more) {
        return folder.import(std::string(R"({"tessera": 1, "name": "head", "base": {"file": "builtin:head")") + more +
                             "}}");
    };
    EXPECT_THROW(based(""), InputError) << "the folder's model is taken";
    LoadOptions own;
    own.useAssets = false;
    expectSameScene(based(R"(, "assets": false)"), loadScene("head", own));
}

TEST(SceneJsonBase, lightsCamerasBackgroundAndOptionsReplaceThoseOfTheBase) {
    const SceneFolder folder;
    const Scene scene = folder.import(basedOnLamps(R"(,
        "lights": [], "cameras": [{"name": "a", "position": [0, 0, 1], "target": [0, 0, 0]}],
        "environment": {"background": [1, 2, 3]}, "options": {"layout": "packed", "defaultLight": false})"));
    EXPECT_TRUE(scene.lights.empty());
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "a");
    EXPECT_EQ(scene.background, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(scene.options.wishes.at("layout"), Wish("packed"));
    EXPECT_EQ(scene.options.defaultLight, false);
    EXPECT_FALSE(scene.options.wishes.contains("technique")) << "of the base";
}

TEST(SceneJsonBase, aMaterialThatReplacesTakesThePlaceOfTheBases) {
    const SceneFolder folder;
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

/// A triangle that is paint, in 'red' ruby.
constexpr const char* kCar = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}]}},
    "materials": [{"name": "paint"}, {"name": "ruby"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "extensions": {"KHR_materials_variants":
        {"mappings": [{"material": 1, "variants": [0]}]}}}]}],
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}]})";

TEST(SceneJsonBase, aVariantOfABaseOrAnIncludeIsShownUnlessAnotherIsAskedFor) {
    const SceneFolder folder;
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
    EXPECT_EQ(worn(loadScene(folder.write("cars.json", cars).string(), red)), "ruby ruby ruby ruby ");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "base": {"file": "car.gltf", "variant": "rde"}})"),
              "/base/variant: there is no variant 'rde'; did you mean 'red'?");
}

TEST(SceneJsonBase, aSceneThatWishesNoDefaultLightNeverGetsOne) {
    const SceneFolder folder;
    const auto isLit = [&](const std::string& members) {
        const std::string text = R"({"tessera": 1, "include": [{"file": "models/bust.obj"}])" + members + "}";
        return loadScene(folder.write("dark.json", text).string()).environment.has_value();
    };
    EXPECT_TRUE(isLit(""));
    EXPECT_TRUE(isLit(R"(, "options": {"defaultLight": true})"));
    EXPECT_FALSE(isLit(R"(, "options": {"defaultLight": false})"));
}

TEST(SceneJsonFields, membersAreSetLastAndWhateverTheType) {
    const SceneFolder folder;
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

TEST(SceneJsonBase, mistakesAreNamedWithTheirPlace) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "base": {"file": "models/bust.obj", "lights": 3}})"),
              "/base/lights: only a built-in scene makes as many lights as it is asked for; remove it");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "base": {"file": "models/bust.obj", "assets": false}})"),
              "/base/assets: only a built-in scene chooses between models of TESSERA_ASSETS and its own; remove it");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "base": {"file": "builtin:hal"}})"),
              "/base/file: there is no built-in scene 'hal'; did you mean 'hall'?");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  basedOnLamps(R"(, "materials": [{"replaces": 1, "name": "a", "model": "lambert"}])")),
              "/materials/0/replaces: is 1; at most 0 is allowed");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  R"({"tessera": 1, "materials": [{"replaces": 0, "name": "a", "model": "lambert"}]})"),
              "/materials/0/replaces: there is no material of a base to replace; remove it");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  basedOnLamps(R"(, "materials": [{"name": "a", "model": "lambert", "normalMap": {"image": 0}}])")),
              "/materials/0/normalMap/image: there is no picture of a base; name a 'file'");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "materials": [{"name": "a", "model": "lambert",
                  "normalMap": {"image": 0, "file": "pictures/normal.tga"}}]})"),
              "/materials/0/normalMap/file: is given beside 'image'; keep one");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0, 0], "fields": {"colour": 1}}]})"),
              "/lights/0/fields: a light's fields has no key 'colour'; did you mean 'color'?");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "base": {"file": "scene.json"}})"),
              "/base/file: includes itself: scene.json -> scene.json; remove one of the includes");
}

} // namespace
} // namespace tessera::scenes
