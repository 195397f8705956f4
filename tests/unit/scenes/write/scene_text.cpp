#include "scenes/write/SceneText.h"

#include <fstream>
#include <set>

#include "scenes/import/SceneJsonNames.h"
#include "scenes/write/ElementJson.h"
#include "tests/support/Sweep.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"
#include "tests/unit/scenes/json/SceneFiles.h"
#include "tests/unit/scenes/write/Edits.h"
#include "tests/unit/scenes/write/SameScene.h"

namespace tessera::scenes {
namespace {

using namespace test;

/// Tests that save scenes in their folder.
class SceneText : public SceneFiles {
protected:
    std::string in(const char* name) const { return (folder.path() / name).string(); }
};
class SceneTextSlow : public SceneText {};

void store(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

/// Writes `scene`, which came from `origin`, to `file` and returns the loaded file. The schema must accept it.
Scene saved(const Scene& scene, const SceneOrigin& origin, const std::filesystem::path& file) {
    const std::string text = sceneText(scene, origin, file);
    EXPECT_TRUE(schemaAccepts(text)) << text;
    store(file, text);
    return loadScene(file.string());
}

std::vector<Falloff> falloffsOf(const LightTypeInfo& type) {
    if (type.isArea) return {Falloff::InverseSquare};
    return {Falloff::InverseSquare, Falloff::Attenuation};
}

/// Changes everything that can be edited: materials by every model in turn, lights and cameras of every kind.
void edit(Scene& scene) {
    Edits edits(7);
    for (std::size_t i = 0; i < scene.materials.size(); i += 2) {
        scene.materials[i] =
            edits.material(MaterialModel(i / 2 % kMaterialModelCount), std::max(1, int(scene.images.size())));
        if (scene.images.empty()) scene.materials[i].textures = {};
    }
    if (!scene.lights.empty()) scene.lights.erase(scene.lights.begin());
    for (const LightTypeInfo& type : lightTypes())
        for (const Falloff falloff : falloffsOf(type)) scene.lights.push_back(edits.light(type.type, falloff));
    scene.cameras.front().worldFromCamera[3] = glm::dvec4(edits.point(), 1.0);
    Camera plan = scene.cameras.front();
    plan.projection = Projection::Orthographic;
    plan.halfHeightMetres = 1.0 / 3.0;
    plan.farMetres = 100.0;
    scene.cameras.push_back(plan); // of the same name
    scene.background = edits.color();
    scene.options.requested["exposureEV"] = 0.1;
    scene.options.requested["toneMap"] = "agx";
    scene.options.requested["prune"] = false;
    scene.options.requested["size"] = std::vector<double>{640, 360};
    scene.name = "edited";
}

void expectRoundTrip(const std::string& nameOrPath, const LoadOptions& options = {}) {
    SCOPED_TRACE(nameOrPath);
    const SceneFolder folder;
    Scene scene = loadScene(nameOrPath, options);
    const SceneOrigin origin = originOf(nameOrPath, options, scene);
    expectSameScene(saved(scene, origin, folder.path() / "same.json"), scene);
    edit(scene);
    expectSameScene(saved(scene, origin, folder.path() / "deep" / "er" / "edited.json"), scene);
}

/// All scenes but one that is slow to make and is written like head_skin; a reduced sweep takes every other one.
void expectRoundTripsOfBuiltinScenes() {
    std::size_t turn = 0;
    for (const BuiltinScene& builtin : builtinScenes())
        if (builtin.name != "head_marble" && (tessera::test::isWholeSweep() || turn++ % 2 == 0))
            expectRoundTrip(std::string(builtin.name));
    expectRoundTrip("lattice", loading(&LoadOptions::lights, 5));
}
TEST_F(SceneText, everyBuiltinSceneIsLoadedBackIdentically) {
    expectRoundTripsOfBuiltinScenes();
}
TEST_F(SceneTextSlow, everyBuiltinSceneIsLoadedBackIdentically) {
    expectRoundTripsOfBuiltinScenes();
}

TEST_F(SceneText, everyKindOfFileIsLoadedBackIdentically) {
    folder.write("models/paint.mtl", "newmtl paint\nKd 0.1 0.2 0.3\nmap_Kd ../pictures/specular.tga\n");
    expectRoundTrip(folder.file("models/painted.obj",
                                "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n"));
    expectRoundTrip((folder.path() / "parts" / "lamps.json").string());
    expectRoundTrip(folder.file("twice.json", R"({"tessera": 1,
        "include": [{"file": "parts/lamps.json", "transform": {"eulerDegrees": [10, 20, 30], "translation": [1, 2, 3]}},
                    {"file": "parts/lamps.json"}, {"file": "builtin:room"}],
        "materials": [{"name": "skin", "model": "lambert", "k_d": {"texture": "pictures/albedo.tga"}}],
        "overrides": [{"node": "lamp", "material": "skin"}],
        "options": {"technique": "forward", "exposureEV": 0.3}})"));
    gltf::test::Builder gltf;
    gltf.material();
    gltf.addTexture();
    gltf.merge(R"({"materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "nodes": [{"mesh": 0, "camera": 0, "rotation": [0.1, 0.2, 0.3, 0.92736], "translation": [0.1, 0.2, 0.3],
                   "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "range": 3.3,
            "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.7}}]}}})");
    expectRoundTrip(gltf.folder.file("model.gltf", gltf.json.dump()));
}

/// A folder with a scene of one image, and its origin.
struct Bust {
    SceneFolder folder;
    std::string path = folder.file("bust.json", R"({"tessera": 1, "base": {"file": "models/bust.obj"},
        "materials": [{"name": "unused", "model": "lambert", "k_d": {"texture": "pictures/albedo.tga"}}]})");
    Scene scene = loadScene(path);
    SceneOrigin origin = originOf(path, {}, scene);
    Scene savedScene() const { return saved(scene, origin, folder.path() / "saved.json"); }
};

TEST_F(SceneText, everyLightIsLoadedBackIdenticallyWithUnusedFields) {
    Bust bust;
    Edits edits(1);
    bust.scene.lights.clear();
    for (const LightTypeInfo& type : lightTypes())
        for (const Falloff falloff : falloffsOf(type)) {
            bust.scene.lights.push_back(edits.light(type.type, falloff));
            for (const LightAnimationKind kind : {LightAnimationKind::Orbit, LightAnimationKind::Wobble,
                                                  LightAnimationKind::Path, LightAnimationKind::Keyframes})
                bust.scene.lights.emplace_back(edits.light(type.type, falloff)).animation = edits.animation(kind);
        }
    Light wide = edits.light(LightType::Spot, Falloff::InverseSquare);
    wide.outerConeRadians = 3.0f; // beyond the right angle that the keys allow
    wide.rangeMetres = kInfinity;
    wide.name.clear();
    bust.scene.lights.push_back(wide);
    EXPECT_TRUE(bust.savedScene().lights == bust.scene.lights);
}

/// Materials of every model with each masking and normal-map space; a reduced sweep takes every third.
void expectRoundTripsOfMaterials() {
    Bust bust;
    Edits edits(2);
    std::size_t turn = 0;
    for (const auto& [name, model] : scenejson::kModels)
        for (const Masking masking : {Masking::Walter, Masking::Directional, Masking::HalfVector})
            for (const NormalMapSpace space : {NormalMapSpace::Tangent, NormalMapSpace::Object}) {
                if (masking == Masking::Directional && model != MaterialModel::MicrofacetAnisotropic) continue;
                if (!tessera::test::isWholeSweep() && turn++ % 3 != 0) continue;
                Material& material = bust.scene.materials[0] = edits.material(model, 1);
                material.masking = masking;
                material.normalMapSpace = space;
                material.tangents =
                    space == NormalMapSpace::Object ? TangentMethod::MikkTSpace : TangentMethod::Lengyel;
                EXPECT_TRUE(bust.savedScene().materials == bust.scene.materials) << name;
                material.textures = {};
                EXPECT_TRUE(bust.savedScene().materials == bust.scene.materials);
            }
}
TEST_F(SceneText, everyMaterialIsLoadedBackIdenticallyWithEveryTexture) {
    expectRoundTripsOfMaterials();
}
TEST_F(SceneTextSlow, everyMaterialIsLoadedBackIdenticallyWithEveryTexture) {
    expectRoundTripsOfMaterials();
}

TEST_F(SceneText, aTextureThatIsRemovedNeverComesBack) {
    Bust bust;
    ASSERT_EQ(bust.scene.materials.at(1).texture(TextureSlot::BaseColor).image, 0);
    bust.scene.materials[1].texture(TextureSlot::BaseColor) = {};
    EXPECT_TRUE(bust.savedScene().materials == bust.scene.materials);
}

TEST_F(SceneText, onlyMaterialsThatWereEditedAreWritten) {
    Bust bust;
    EXPECT_EQ(sceneText(bust.scene, bust.origin, "a.json").find("replaces"), std::string::npos);
    bust.scene.materials[1].doubleSided = true;
    EXPECT_THAT(sceneText(bust.scene, bust.origin, "a.json"), HasSubstr("\"replaces\":1"));
}

TEST_F(SceneText, everyCameraIsLoadedBackIdentically) {
    Bust bust;
    Edits edits(3);
    for (int i = 0; i < 100; ++i) {
        Camera& camera = bust.scene.cameras.emplace_back(bust.scene.cameras.front());
        camera.name = i == 0 ? "" : "edited";
        camera.worldFromCamera[3] = glm::dvec4(edits.point(), 1.0);
        camera.fovYRadians = 0.01 + 3.0 * edits.share(); // rarely an exact number of degrees
        camera.halfHeightMetres = 0.01 + edits.share();
        camera.projection = i % 2 == 0 ? Projection::Perspective : Projection::Orthographic;
        camera.nearMetres = 0.01 + edits.share();
        if (i % 3 == 0) camera.farMetres = 2.0 + edits.share();
    }
    EXPECT_TRUE(bust.savedScene().cameras == bust.scene.cameras);
}

TEST_F(SceneText, aSavedSceneThatIsEditedAndSavedOverItselfIsLoadedBackIdentically) {
    const std::string file = in("edited.json");
    Scene scene = loadScene("models");
    const SceneOrigin models = originOf("models", {}, scene);
    scene.materials[3].baseColor.x = 0.123f;
    saved(scene, models, file);
    for (int round = 0; round < 3; ++round) {
        scene = loadScene(file);
        const SceneOrigin origin = originOf(file, {}, scene);
        EXPECT_EQ(origin.base, "builtin:models");
        EXPECT_EQ(scene.materials[3].baseColor.x, 0.123f) << "an earlier edit stays";
        scene.materials[std::size_t(round)].baseColor.y = 0.5f;
        scene.lights.pop_back();
        expectSameScene(saved(scene, origin, file), scene);
    }
    std::filesystem::remove(file);
    expectSameScene(saved(scene, models, file), scene);
}

TEST_F(SceneText, aSceneOfItsOwnModelsKeepsToThem) {
    const std::string first = folder.file("own.json", R"({"tessera": 1,
        "base": {"file": "builtin:room", "assets": false}})");
    const std::string second = in("second.json");
    const Scene scene = loadScene(first);
    EXPECT_FALSE(originOf(first, {}, scene).useAssets);
    saved(scene, originOf(first, {}, scene), second);
    EXPECT_FALSE(originOf(second, {}, scene).useAssets);
    EXPECT_TRUE(originOf("room", {}, scene).useAssets);
}

TEST_F(SceneText, aSceneSavedElsewhereDoesNotNeedTheEditedFile) {
    const std::string first = in("first.json");
    Scene scene = loadScene(in("models/bust.obj"));
    saved(scene, originOf(in("models/bust.obj"), {}, scene), first);
    scene = loadScene(first);
    const SceneOrigin origin = originOf(first, {}, scene);
    std::filesystem::remove(first);
    expectSameScene(saved(scene, origin, folder.path() / "other" / "second.json"), scene);
}

TEST_F(SceneText, aFileThatTheSceneIsMadeOfIsNotWrittenOver) {
    const std::string file = folder.file("whole.json", R"({"tessera": 1,
        "include": [{"file": "parts/lamps.json"}]})");
    const Scene scene = loadScene(file);
    const SceneOrigin origin = originOf(file, {}, scene);
    for (const std::filesystem::path& made : {std::filesystem::path(file), folder.path() / "parts" / "lamps.json"})
        EXPECT_EQ(inputErrorOf([&] { sceneText(scene, origin, made); }),
                  made.string() +
                      ": the scene is made of this file, which says more than edits; save under another name");
    EXPECT_NO_THROW(saved(scene, origin, folder.path() / "new.json"));
}

TEST_F(SceneText, aSceneWhoseLightWasTakenAwayNeverGetsOneSupplied) {
    const std::string bust = in("models/bust.obj");
    Scene scene = loadScene(bust);
    const SceneOrigin origin = originOf(bust, {}, scene);
    ASSERT_TRUE(scene.environment) << "the one that was supplied";
    scene.environment.reset();
    const Scene back = saved(scene, origin, folder.path() / "dark.json");
    EXPECT_TRUE(back.lights.empty());
    EXPECT_FALSE(back.environment);
    EXPECT_EQ(back.options.defaultLight, false);
}

TEST_F(SceneText, theVariantThatIsShownIsSavedAlsoBySavedFilesOfSavedFiles) {
    const std::string car = folder.file("car.gltf", kCar);
    LoadOptions red;
    red.import.variant = "red";
    Scene scene = loadScene(car, red);
    ASSERT_EQ(scene.materials.size(), 2u);
    const SceneOrigin origin = originOf(car, red, scene);
    scene.materials[1].metallic = 0.25f; // a material of the variant alone
    const std::filesystem::path first = folder.path() / "first.json", second = folder.path() / "second.json";
    expectSameScene(saved(scene, origin, first), scene);
    Scene again = loadScene(first.string());
    const SceneOrigin originAgain = originOf(first.string(), {}, again);
    again.materials[0].metallic = 0.5f;
    expectSameScene(saved(again, originAgain, second), again);
}

TEST_F(SceneText, whatIsEditedOfAVariantsOwnMaterialIsLeftOutOfOthersAndSaid) {
    const std::string car = folder.file("car.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}, {"name": "bare"}]}},
        "materials": [{"name": "paint"}, {"name": "ruby"}, {"name": "sapphire"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "extensions":
            {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]},
                                                     {"material": 2, "variants": [1]}]}}}]}],
        "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}]})");
    LoadOptions red;
    red.import.variant = "red";
    Scene scene = loadScene(car, red);
    const SceneOrigin origin = originOf(car, red, scene);
    scene.materials[0].metallic = 0.5f;
    scene.materials[1].metallic = 0.25f;
    const std::filesystem::path first = folder.path() / "first.json", second = folder.path() / "second.json";
    saved(scene, origin, first);
    for (const char* name : {"blue", "bare"}) {
        LoadOptions other;
        other.import.variant = name;
        const Scene shown = loadScene(first.string(), other);
        EXPECT_EQ(shown.materials[0].metallic, 0.5f) << "a material of all variants";
        if (shown.materials.size() > 1) {
            EXPECT_EQ(shown.materials[1].name, "sapphire");
            EXPECT_EQ(shown.materials[1].metallic, 1.0f);
        }
        ASSERT_EQ(shown.warnings.size(), 1u);
        EXPECT_EQ(shown.warnings[0], "'ruby', which replaces material 1, is not in this variant and left out");
        // Saved in this variant, it loads back identically and without a warning.
        Scene again = saved(shown, originOf(first.string(), other, shown), second);
        EXPECT_EQ(again.materials, shown.materials);
        EXPECT_TRUE(again.warnings.empty());
    }
}

TEST_F(SceneText, theClipThatWasChosenIsSaved) {
    const std::string file = folder.file("walker.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "animations": [
            {"name": "walk", "samplers": [{"input": 1, "output": 2}],
             "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
            {"name": "run", "samplers": [{"input": 1, "output": 2}],
             "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3},
                      {"componentType": 5126, "type": "SCALAR", "count": 1},
                      {"componentType": 5126, "type": "VEC3", "count": 1}]})");
    const auto expectPlaying = [&](const LoadOptions& load, const std::vector<int>& playing) {
        const Scene scene = loadScene(file, load);
        EXPECT_EQ(scene.rig.playing, playing);
        const Scene back = saved(scene, originOf(file, load, scene), folder.path() / "saved.json");
        expectSameScene(back, scene);
        EXPECT_EQ(back.rig.playing, playing);
    };
    expectPlaying({}, {0});
    LoadOptions load = loading(&LoadOptions::clip, "run");
    expectPlaying(load, {1});
    load.clip = "none";
    expectPlaying(load, {});
    EXPECT_EQ(loadScene(in("saved.json"), loading(&LoadOptions::clip, "walk")).rig.playing, std::vector<int>{0})
        << "what a command says goes before";
}

TEST_F(SceneText, namesAreRelativeToTheNewFile) {
    const std::string bust = in("models/bust.obj");
    const Scene scene = loadScene(bust);
    const SceneOrigin origin = originOf(bust, {}, scene);
    const auto has = [&](const std::filesystem::path& file, const std::string& name) {
        return sceneText(scene, origin, file).find("{\"file\":\"" + name + "\"}") != std::string::npos;
    };
    EXPECT_TRUE(has(folder.path() / "a.json", "models/bust.obj"));
    EXPECT_TRUE(has(folder.path() / "models" / "a.json", "bust.obj"));
    EXPECT_TRUE(has(folder.path() / "x" / "y" / "a.json", "../../models/bust.obj"));
}

TEST_F(SceneText, aSceneThatCannotBeWrittenIsRefusedWithTheReason) {
    Bust bust;
    bust.scene.lights.emplace_back().name = "caf\xe9";
    EXPECT_EQ(inputErrorOf([&] { sceneText(bust.scene, bust.origin, "a.json"); }),
              "a.json: a name of the scene or of its file is not UTF-8, which JSON needs; rename it");
    bust.scene.lights.front().name = "lamp";
    bust.scene.lights.front().intensity = -1.0f;
    EXPECT_EQ(inputErrorOf([&] { sceneText(bust.scene, bust.origin, "a.json"); }),
              "scene 'bust': light 0 'lamp': the intensity must be finite and not negative");
}

TEST(SceneTextNumber, everyFloatIsReadBackToTheLastBitFromFewDigits) {
    EXPECT_EQ(write::number(0.1f).dump(), "0.1");
    EXPECT_EQ(write::number(16777216.0f).dump(), "16777216.0");
    EXPECT_TRUE(write::number(kInfinity).is_null());
    tessera::test::Random random(5);
    for (int i = 0; i < 100000; ++i) {
        const float value = std::exp2(float(random.between(-120.0, 120.0)));
        const std::string text = write::number(value).dump();
        ASSERT_EQ(float(std::stod(text)), value) << text;
    }
}

TEST(SceneTextNumber, anglesThatAreNumbersOfDegreesAreWrittenAsSuch) {
    EXPECT_EQ(write::degreesOf(glm::radians(25.0f)).dump(), "25.0");
    EXPECT_EQ(write::degreesOf(glm::radians(45.0)).dump(), "45.0");
    EXPECT_EQ(write::degreesOf(glm::radians(62.5)).dump(), "62.5");
}

TEST_F(SceneText, keepsTheHookOfTheBaseAndItsNewValues) {
    const std::filesystem::path base = folder.write("hooked.json", R"({"tessera": 1,
        "include": [{"file": "models/bust.obj"}],
        "cameras": [{"name": "front", "position": [0, 1, 4], "target": [0, 1, 0]}],
        "hook": {"file": "hooks/redden.glsl", "parameters": [{"name": "a", "value": 0.25}]}})");
    const std::filesystem::path file = folder.path() / "saved.json";
    Scene scene = loadScene(base.string());
    const Hook before = *scene.hook;
    scene.hook->parameters[0].value = 0.7f;
    Scene again = saved(scene, originOf(base.string(), {}, loadScene(base.string())), file);
    EXPECT_EQ(again.hook, scene.hook);
    // A document that holds edits alone is replaced.
    again.hook->parameters[0].value = 0.25f;
    EXPECT_EQ(saved(again, originOf(file.string(), {}, loadScene(file.string())), file).hook, before);
}

} // namespace
} // namespace tessera::scenes
