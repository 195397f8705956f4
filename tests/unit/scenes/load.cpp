#include "scenes/Load.h"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "scenes/Defaults.h"
#include "scenes/Limits.h"
#include "scenes/builtin/bust/Bust.h"
#include "tests/support/AssetsFolder.h"
#include "tests/unit/scenes/PictureBytes.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {
namespace {

std::string complaint(const std::string& nameOrPath, const LoadOptions& options = {}) {
    try {
        loadScene(nameOrPath, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(LoadScene, unknownNamesBringTheNearest) {
    EXPECT_EQ(complaint("latice"), "no built-in scene or file is called 'latice'; did you mean 'lattice'?");
    EXPECT_EQ(complaint("quetzalcoatl"),
              "no built-in scene or file is called 'quetzalcoatl'; valid are hall, spheres, models, lattice, room, "
              "shadow_truth, head, head_skin, head_marble, diffusion_truth, lamps, studio, glass");
}

TEST(LoadScene, missingAndForeignFilesAreNamed) {
    EXPECT_EQ(complaint("nowhere/scene.gltf"), "nowhere/scene.gltf: no such file; check the path");
    EXPECT_EQ(complaint("nowhere.obj"), "nowhere.obj: no such file; check the path");
    const test::TempFolder folder;
    folder.write("scene.fbx", "x");
    const std::string fbx = (folder.path() / "scene.fbx").string();
    EXPECT_EQ(complaint(fbx), fbx + ": not a scene file; give a .gltf, .glb, .obj or .json file");
    const std::string directory = folder.path().string();
    EXPECT_EQ(complaint(directory), directory + ": is a folder; give a .gltf, .glb, .obj or .json file");
    folder.write("box.GLTF", "{}");
    EXPECT_EQ(complaint(directory),
              directory + ": is a folder; give the scene in it, '" + (folder.path() / "box.GLTF").string() + "'");
    folder.write("other.obj", "");
    EXPECT_EQ(complaint(directory), directory + ": is a folder; give a .gltf, .glb, .obj or .json file");
}

TEST(LoadScene, numberOfLightsIsFrom0ToTheMost) {
    LoadOptions options;
    options.lights = -1;
    EXPECT_EQ(complaint("lattice", options), "cannot use -1 lights; give a number from 0 to 262144");
    options.lights = 262145;
    EXPECT_EQ(complaint("lattice", options), "cannot use 262145 lights; give a number from 0 to 262144");
    options.lights = 0;
    const Scene dark = loadScene("lattice", options);
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_FALSE(dark.environment) << "who asks for no lights gets no default either";
}

TEST(LoadScene, aBuiltinScenesOwnLightsCountAmongThoseThatCanBeDrawn) {
    LoadOptions options;
    options.lights = kMostLights;
    const Scene hall = loadScene("hall", options);
    EXPECT_EQ(hall.lights.size(), std::size_t(kMostLights));
    EXPECT_EQ(hall.lights.back().type, LightType::Directional) << "the sky stays";
}

TEST(LoadScene, aFileOfMoreLightsThanCanBeDrawnIsRefusedUnlessItsFirstAreAskedFor) {
    const test::TempFolder folder;
    std::string text = R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0, 0], "intensity": 1})";
    for (int i = 1; i <= kMostLights; ++i) text += R"(,{"type": "point", "position": [0, 0, 0], "intensity": 1})";
    folder.write("many.json", text + "]}");
    const std::string file = (folder.path() / "many.json").string();
    EXPECT_EQ(complaint(file), file +
                                   ": has 262145 lights, and 262144 at most can be drawn; keep fewer of them, or load "
                                   "only the first");
    LoadOptions options;
    options.lights = kMostLights;
    EXPECT_EQ(loadScene(file, options).lights.size(), std::size_t(kMostLights));
}

TEST(LoadScene, aRequestedStopTakesEffectBeforeAFileIsRead) {
    std::stop_source source;
    source.request_stop();
    LoadOptions options;
    options.stop = source.get_token();
    EXPECT_THROW(loadScene("nowhere.obj", options), LoadStopped);
    EXPECT_THROW(loadScene("room", options), LoadStopped);
}

TEST(LoadScene, aBuiltinSceneIsFoundByItsExactName) {
    ASSERT_NE(builtinScene("room"), nullptr);
    EXPECT_EQ(builtinScene("room")->name, "room");
    EXPECT_EQ(builtinScene("Room"), nullptr);
    EXPECT_EQ(builtinScene("./room"), nullptr);
}

TEST(LoadScene, warningsNameFilesAsSeenFromTheScenesFolderAndStandOnce) {
    const test::TempFolder folder;
    folder.write("models/a.mtl", "newmtl a\nmap_Kd pictures/gone.png\n");
    folder.write("models/m.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    const auto contains = [](const Scene& scene, const std::string& warning) {
        return std::ranges::count(scene.warnings, warning);
    };
    const std::string lost = "a.mtl: material 'a', map_Kd: {0}pictures/gone.png: there is no such file; check the name "
                             "and the folder; its colours are a checkerboard, and what else it holds is left out";
    const std::string undefined = "no material library defines 'b'; a default material of that name is used";
    const auto in = [&](const std::string& place) { return std::string(lost).replace(lost.find("{0}"), 3, place); };
    const Scene model = loadScene((folder.path() / "models/m.obj").string());
    EXPECT_EQ(contains(model, in("")), 1);
    EXPECT_EQ(contains(model, undefined), 1);
    const Scene scene = loadScene(
        folder.write("s.json", R"({"tessera": 1, "include": [{"file": "models/m.obj"}, {"file": "models/m.obj"}]})")
            .string());
    EXPECT_EQ(contains(scene, "models/" + in("models/")), 1);
    EXPECT_EQ(contains(scene, "models/m.obj: " + undefined), 1);

    LoadOptions strict;
    strict.import.isStrict = true;
    EXPECT_THROW(loadScene((folder.path() / "s.json").string(), strict), InputError);
}

TEST(LoadScene, aVariantThatNoModelHasIsRefusedWithThoseThatThereAre) {
    const test::TempFolder folder;
    folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "extensions": {"KHR_materials_variants": {"variants":
        [{"name": "beach"}, {"name": "street"}]}}})");
    folder.write("b.gltf", R"({"asset": {"version": "2.0"}, "extensions": {"KHR_materials_variants": {"variants":
        [{"name": "night"}]}}})");
    const std::string file =
        folder.write("s.json", R"({"tessera": 1, "include": [{"file": "a.gltf"}, {"file": "b.gltf"}]})").string();
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

TEST(LoadScene, filesWithoutViewOrLightGetTheDefaults) {
    const test::TempFolder folder;
    folder.write("triangle.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string file = (folder.path() / "triangle.OBJ").string();
    const Scene scene = loadScene(file);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "default");
    EXPECT_TRUE(scene.lights.empty());
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->source, "builtin:studio");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(suppliedText(scene),
              "no light and no camera in it: lit by the built-in environment 'studio', turned to the "
              "camera, before a blurred backdrop (--environment chooses another, --backdrop what "
              "is seen of it, --no-default-light leaves it dark), seen whole by the supplied "
              "camera 'default'");

    LoadOptions options;
    options.defaultLight = false;
    EXPECT_FALSE(loadScene(file, options).environment);
}

TEST(LoadScene, withTheDefaultCameraAFileIsSeenAndLitAsOneWithoutCamerasIs) {
    const test::TempFolder folder;
    folder.write("triangle.obj", "v 0 0 0\nv 9 0 1\nv 0 1 3\nf 1 2 3\n");
    constexpr const char* kBegin = R"({"tessera": 1, "include": [{"file": "triangle.obj"}])";
    const std::string bare = folder.write("bare.json", std::string(kBegin) + "}").string();
    const std::string seen = folder
                                 .write("seen.json", std::string(kBegin) + R"(, "options": {"camera": "side"},
        "cameras": [{"name": "away", "position": [0, 0, 99], "target": [0, 0, 100]},
                    {"name": "side", "position": [99, 0, 0], "target": [0, 0, 0]}]})")
                                 .string();
    LoadOptions options;
    options.aspect = 0.5;
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

TEST(LoadScene, aBackgroundThatIsAskedForTakesThePlaceOfTheScenesOwn) {
    const test::TempFolder folder;
    const std::string file = folder
                                 .write("blue.json", R"({"tessera": 1, "base": {"file": "builtin:room"},
            "environment": {"background": [0, 0, 1]}})")
                                 .string();
    EXPECT_EQ(loadScene(file).background, glm::vec3(0.0f, 0.0f, 1.0f));
    LoadOptions options;
    options.background = glm::dvec3(0.1, 0.25, 3.0);
    EXPECT_EQ(loadScene(file, options).background, glm::vec3(0.1f, 0.25f, 3.0f));
    EXPECT_EQ(loadScene("room", options).background, glm::vec3(0.1f, 0.25f, 3.0f));
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), 1e39}) {
        options.background = glm::dvec3(0.0, bad, 0.0);
        EXPECT_EQ(complaint("room", options),
                  fmt::format("cannot use the background 0,{},0; give three finite numbers, each 0 or more", bad));
    }
}

TEST(LoadScene, filesKeepTheirFirstLights) {
    const test::TempFolder folder;
    folder.write("lamps.json",
                 R"({"tessera": 1, "lights": [{"type": "point", "name": "a", "position": [0, 0, 0]},
                                  {"type": "point", "name": "b", "position": [0, 0, 0]}]})");
    LoadOptions options;
    options.lights = 1;
    const Scene scene = loadScene((folder.path() / "lamps.json").string(), options);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "a");
}

/// The scan is third-party and found only where TESSERA_ASSETS says; a triangle stands in for it.
TEST(LoadScene, headUsesTheScanExactlyWhenAssetsHoldIt) {
    const test::TempFolder folder;
    test::writeScan(folder);
    const tessera::test::AssetsFolder assets(folder.path().c_str());
    const auto meshCalledBust = [](const Scene& scene) {
        for (const Mesh& mesh : scene.meshes) {
            if (mesh.name == "bust") return true;
        }
        return false;
    };
    const Scene scan = loadScene("head");
    EXPECT_FALSE(meshCalledBust(scan));
    EXPECT_EQ(scan.images.size(), 3u);
    LoadOptions options;
    options.useAssets = false;
    const Scene bust = loadScene("head", options);
    EXPECT_TRUE(meshCalledBust(bust));
    // Both stand on the plinth and reach equally high; single precision of half a metre.
    EXPECT_EQ(scan.cameras.size(), bust.cameras.size());
    EXPECT_NEAR(worldBounds(scan).max.y, worldBounds(bust).max.y, 1e-6);
}

TEST(LoadScene, aScannedHeadOfMarbleHasTheColourOfStoneAndNotOfSkin) {
    const test::TempFolder folder;
    test::writeScan(folder);
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

} // namespace
} // namespace tessera::scenes
