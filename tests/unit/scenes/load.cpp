#include "scenes/Load.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/Defaults.h"
#include "scenes/InUse.h"
#include "scenes/Limits.h"
#include "scenes/builtin/bust/Bust.h"
#include "tests/support/AssetsFolder.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes {
namespace {

using namespace test;

class LoadScene : public testing::Test {
protected:
    std::string in(const char* name) const { return (folder.path() / name).string(); }
    const TempFolder folder;
};

std::string complaint(const std::string& nameOrPath, const LoadOptions& options = {}) {
    return inputErrorOf([&] { loadScene(nameOrPath, options); });
}

TEST_F(LoadScene, unknownNamesBringTheNearest) {
    EXPECT_EQ(complaint("latice"), "no built-in scene or file is called 'latice'; did you mean 'lattice'?");
    EXPECT_EQ(complaint("quetzalcoatl"),
              "no built-in scene or file is called 'quetzalcoatl'; valid are hall, spheres, models, lattice, room, "
              "shadow_truth, head, head_skin, head_marble, diffusion_truth, lamps, studio, glass");
}

TEST_F(LoadScene, missingAndForeignFilesAreNamed) {
    EXPECT_EQ(complaint("nowhere/scene.gltf"), "nowhere/scene.gltf: no such file; check the path");
    EXPECT_EQ(complaint("nowhere.obj"), "nowhere.obj: no such file; check the path");
    const std::string fbx = folder.file("scene.fbx", "x");
    EXPECT_EQ(complaint(fbx),
              fbx + ": not a scene file; give a .gltf, .glb, .obj or .json file (Blender, for one, exports glTF)");
    EXPECT_EQ(complaint("https://a.org/b.glb"), "https://a.org/b.glb: is a URL; download the file and give its path");
    const std::string directory = folder.path().string();
    EXPECT_EQ(complaint(directory), directory + ": is a folder; give a .gltf, .glb, .obj or .json file");
    folder.write("box.GLTF", "{}");
    EXPECT_EQ(complaint(directory), directory + ": is a folder; give the scene in it, '" + in("box.GLTF") + "'");
    folder.write("other.obj", "");
    EXPECT_EQ(complaint(directory), directory + ": is a folder; give a .gltf, .glb, .obj or .json file");
}

TEST_F(LoadScene, numberOfLightsIsFrom0ToTheMost) {
    LoadOptions options = loading(&LoadOptions::lights, -1);
    EXPECT_EQ(complaint("lattice", options), "cannot use -1 lights; give a number from 0 to 262144");
    options.lights = 262145;
    EXPECT_EQ(complaint("lattice", options), "cannot use 262145 lights; give a number from 0 to 262144");
    options.lights = 0;
    const Scene dark = loadScene("lattice", options);
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_FALSE(dark.environment) << "a request for no lights adds no default either";
}

TEST_F(LoadScene, aBuiltinScenesOwnLightsCountAmongThoseThatCanBeDrawn) {
    const Scene hall = loadScene("hall", loading(&LoadOptions::lights, kMostLights));
    EXPECT_EQ(hall.lights.size(), std::size_t(kMostLights));
    EXPECT_EQ(hall.lights.back().type, LightType::Directional) << "the sky stays";
}

TEST_F(LoadScene, aFileOfMoreLightsThanCanBeDrawnIsRefusedUnlessItsFirstAreRequested) {
    std::string text = R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0, 0], "intensity": 1})";
    for (int i = 1; i <= kMostLights; ++i) text += R"(,{"type": "point", "position": [0, 0, 0], "intensity": 1})";
    const std::string file = folder.file("many.json", text + "]}");
    EXPECT_EQ(complaint(file), file +
                                   ": has 262145 lights, and 262144 at most can be drawn; keep fewer of them, or load "
                                   "only the first");
    EXPECT_EQ(loadScene(file, loading(&LoadOptions::lights, kMostLights)).lights.size(), std::size_t(kMostLights));
}

TEST_F(LoadScene, aRequestedStopTakesEffectBeforeAFileIsRead) {
    std::stop_source source;
    source.request_stop();
    LoadOptions options = loading(&LoadOptions::stop, source.get_token());
    EXPECT_THROW(loadScene("nowhere.obj", options), LoadStopped);
    EXPECT_THROW(loadScene("room", options), LoadStopped);
}

TEST_F(LoadScene, aBuiltinSceneIsFoundByItsExactName) {
    ASSERT_NE(builtinScene("room"), nullptr);
    EXPECT_EQ(builtinScene("room")->name, "room");
    EXPECT_EQ(builtinScene("Room"), nullptr);
    EXPECT_EQ(builtinScene("./room"), nullptr);
}

TEST_F(LoadScene, warningsNameFilesAsSeenFromTheScenesFolderAndStandOnce) {
    folder.write("models/a.mtl", "newmtl a\nmap_Kd pictures/gone.png\n");
    folder.write("models/m.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    const auto contains = [](const Scene& scene, const std::string& warning) {
        return std::ranges::count(scene.warnings, warning);
    };
    const std::string lost = "a.mtl: material 'a', map_Kd: {0}pictures/gone.png: there is no such file; check the name "
                             "and the folder; its colours are a checkerboard, and what else it holds is left out";
    const std::string undefined = "no material library defines 'b'; a default material of that name is used";
    const auto lostIn = [&](const std::string& place) { return std::string(lost).replace(lost.find("{0}"), 3, place); };
    const Scene model = loadScene(in("models/m.obj"));
    EXPECT_EQ(contains(model, lostIn("")), 1);
    EXPECT_EQ(contains(model, undefined), 1);
    const Scene scene = loadScene(
        folder.file("s.json", R"({"tessera": 1, "include": [{"file": "models/m.obj"}, {"file": "models/m.obj"}]})"));
    EXPECT_EQ(contains(scene, "models/" + lostIn("models/")), 1);
    EXPECT_EQ(contains(scene, "models/m.obj: " + undefined), 1);

    EXPECT_THROW(loadScene(in("s.json"), loading(&LoadOptions::import, strictly())), InputError);
}

TEST_F(LoadScene, aVariantThatNoModelHasIsRefusedWithThoseThatThereAre) {
    folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "extensions": {"KHR_materials_variants": {"variants":
        [{"name": "beach"}, {"name": "street"}]}}})");
    folder.write("b.gltf", R"({"asset": {"version": "2.0"}, "extensions": {"KHR_materials_variants": {"variants":
        [{"name": "night"}]}}})");
    const std::string file =
        folder.file("s.json", R"({"tessera": 1, "include": [{"file": "a.gltf"}, {"file": "b.gltf"}]})");
    LoadOptions options;
    for (const char* name : {"beach", "street", "night"}) {
        options.import.variant = name;
        EXPECT_NO_THROW(loadScene(file, options)) << name;
    }
    options.import.variant = "xyz";
    EXPECT_EQ(complaint(file, options),
              file + ": no variant of the scene's models is called 'xyz'; valid are beach, street, night");
    EXPECT_EQ(complaint("room", options), "room: no model of the scene has variants, so none is called 'xyz'");
}

TEST_F(LoadScene, filesWithoutViewOrLightGetTheDefaults) {
    const std::string file = folder.file("triangle.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Scene scene = loadScene(file);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "default");
    EXPECT_TRUE(scene.lights.empty());
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->source, "builtin:studio");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(suppliedText(scene),
              "no light and no camera in it: lit by the environment 'studio', blurred behind it (--environment, "
              "--backdrop or --no-default-light change that), seen whole by the supplied camera 'default'");

    EXPECT_FALSE(loadScene(file, loading(&LoadOptions::defaultLight, false)).environment);
}

TEST_F(LoadScene, withTheDefaultCameraAFileIsSeenAndLitAsOneWithoutCamerasIs) {
    folder.write("triangle.obj", "v 0 0 0\nv 9 0 1\nv 0 1 3\nf 1 2 3\n");
    constexpr const char* kBegin = R"({"tessera": 1, "include": [{"file": "triangle.obj"}])";
    const std::string bare = folder.file("bare.json", std::string(kBegin) + "}");
    const std::string seen = folder.file("seen.json", std::string(kBegin) + R"(, "options": {"camera": "side"},
        "cameras": [{"name": "away", "position": [0, 0, 99], "target": [0, 0, 100]},
                    {"name": "side", "position": [99, 0, 0], "target": [0, 0, 0]}]})");
    LoadOptions options = loading(&LoadOptions::aspect, 0.5);
    const Scene expected = loadScene(bare, options), own = loadScene(seen, options);
    EXPECT_EQ(own.cameras.size(), 2u);
    options.defaultCamera = true;
    const Scene scene = loadScene(seen, options);
    EXPECT_EQ(scene.cameras, expected.cameras);
    EXPECT_FALSE(scene.options.camera);
    ASSERT_TRUE(own.environment && expected.environment && scene.environment);
    EXPECT_EQ(scene.environment->rotationDegrees, expected.environment->rotationDegrees);
    EXPECT_NE(own.environment->rotationDegrees, expected.environment->rotationDegrees) << "around the camera 'side'";
    options.environment = "studio";
    EXPECT_EQ(loadScene(seen, options).environment->rotationDegrees, expected.environment->rotationDegrees)
        << "and so one that is chosen";
    EXPECT_EQ(loadScene(bare, options).cameras, expected.cameras);
}

TEST_F(LoadScene, aBackgroundThatIsRequestedTakesThePlaceOfTheScenesOwn) {
    const std::string file = folder.file("blue.json", R"({"tessera": 1, "base": {"file": "builtin:room"},
            "environment": {"background": [0, 0, 1]}})");
    EXPECT_EQ(loadScene(file).background, glm::vec3(0.0f, 0.0f, 1.0f));
    LoadOptions options = loading(&LoadOptions::background, glm::dvec3(0.1, 0.25, 3.0));
    EXPECT_EQ(loadScene(file, options).background, glm::vec3(0.1f, 0.25f, 3.0f));
    EXPECT_EQ(loadScene("room", options).background, glm::vec3(0.1f, 0.25f, 3.0f));
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), 1e39}) {
        options.background = glm::dvec3(0.0, bad, 0.0);
        EXPECT_EQ(complaint("room", options),
                  fmt::format("cannot use the background 0,{},0; give three finite numbers, each 0 or more", bad));
    }
}

TEST_F(LoadScene, filesKeepTheirFirstLights) {
    folder.write("lamps.json",
                 R"({"tessera": 1, "lights": [{"type": "point", "name": "a", "position": [0, 0, 0]},
                                  {"type": "point", "name": "b", "position": [0, 0, 0]}]})");
    const Scene scene = loadScene(in("lamps.json"), loading(&LoadOptions::lights, 1));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "a");
}

/// The third-party scan is found only in the folder of TESSERA_ASSETS; here a triangle replaces it.
TEST_F(LoadScene, headUsesTheScanExactlyWhenAssetsHoldIt) {
    writeScan(folder);
    const tessera::test::AssetsFolder assets(folder.path().c_str());
    const auto meshCalledBust = [](const Scene& scene) {
        return std::ranges::find(scene.meshes, "bust", &Mesh::name) != scene.meshes.end();
    };
    const Scene scan = loadScene("head");
    EXPECT_FALSE(meshCalledBust(scan));
    EXPECT_EQ(scan.images.size(), 3u);
    const Scene bust = loadScene("head", loading(&LoadOptions::useAssets, false));
    EXPECT_TRUE(meshCalledBust(bust));
    // Both stand on the plinth and have the same height; single precision of half a metre.
    EXPECT_EQ(scan.cameras.size(), bust.cameras.size());
    EXPECT_NEAR(worldBounds(scan).max.y, worldBounds(bust).max.y, 1e-6);
}

TEST_F(LoadScene, aScannedHeadOfMarbleHasTheColourOfStoneAndNotOfSkin) {
    writeScan(folder);
    const tessera::test::AssetsFolder assets(folder.path().c_str());
    const auto headOf = [](const char* name) {
        const Scene scene = loadScene(name);
        return *std::ranges::find(scene.materials, "head", &Material::name);
    };
    const Material skin = headOf("head_skin"), marble = headOf("head_marble");
    for (const TextureSlot slot : {TextureSlot::BaseColor, TextureSlot::SpecularColor}) {
        EXPECT_NE(skin.texture(slot).image, kNone);
        EXPECT_EQ(marble.texture(slot).image, kNone);
    }
    EXPECT_NE(marble.texture(TextureSlot::Normal).image, kNone);
    EXPECT_EQ(glm::vec3(skin.baseColor), glm::vec3(1.0f)) << "times the texture";
    EXPECT_EQ(glm::vec3(marble.baseColor), glm::vec3(builtin::kPolishedMarble));
}

TEST_F(LoadScene, materialsThatAreAllBlackUnderAnyLightAreNamedInOneLine) {
    folder.write("black.obj", "mtllib black.mtl\nusemtl black\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto loaded = [&](const std::string& more) {
        folder.write("black.mtl", "newmtl black\nKd 0 0 0\n" + more + "\nnewmtl unused\n");
        return loadScene(in("black.obj"));
    };
    for (const char* black : {"illum 0", "illum 1"}) // unlit, matte
        EXPECT_EQ(fmt::format("{}", fmt::join(loaded(black).warnings, "; ")),
                  "all surfaces are black: their base colour is 0, and they neither reflect nor emit light; give their "
                  "materials a base colour");
    for (const char* visible : {"illum 2", "illum 1\nPm 1", "illum 1\nKe 0 0 1", "illum 1\nd 0.5"})
        EXPECT_TRUE(loaded(visible).warnings.empty()) << visible;
    const Scene scene = loaded("illum 1");
    for (const auto& change :
         std::initializer_list<void (*)(Material&)>{[](Material& material) { material.baseColor.z = 0.1f; },
                                                    [](Material& material) { material.clearcoat = 1; },
                                                    [](Material& material) { material.sheenColor.x = 1; }}) {
        Scene changed = scene;
        EXPECT_TRUE(isAllBlack(changed));
        change(changed.materials[0]);
        EXPECT_FALSE(isAllBlack(changed));
    }
}

} // namespace
} // namespace tessera::scenes
