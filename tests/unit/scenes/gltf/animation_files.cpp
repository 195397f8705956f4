// Clips of models that are loaded, included by scene files and saved.

#include "scenes/Load.h"
#include "scenes/write/SceneText.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/gltf/AnimationBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

TEST(GltfAnimation, aLoadedSceneStandsAtTimeZeroOfTheClipThatIsRequested) {
    Builder builder = movingTriangle();
    addClip(builder, {0}, builder.add("VEC3", {0, 4, 0}), {{"node", 0}, {"path", "translation"}}, "STEP", "up");
    const std::string file = builder.folder.file("clips.gltf", builder.json.dump());
    const auto placeWith = [&](std::optional<std::string> clip) {
        return glm::dvec3(loadScene(file, loading(&LoadOptions::clip, std::move(clip))).nodes[0].parentFromNode[3]);
    };
    expectPlace(placeWith({}), {0.0, 0.0, 0.0});
    expectPlace(placeWith("up"), {0.0, 4.0, 0.0});
    expectPlace(placeWith("1"), {0.0, 4.0, 0.0});
    expectPlace(placeWith("none"), {0.0, 0.0, 0.0});
    EXPECT_THROW(placeWith("2"), InputError);
}

TEST(GltfAnimation, clipsOfModelsThatASceneFileIncludesPlayTogetherAndFindTheirMaterials) {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "name": "first"}, {"mesh": 1, "name": "second"}],
                      "scenes": [{"nodes": [0, 1]}], "materials": [{"name": "a"}, {"name": "b"}],
                      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                                 {"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}]})");
    addPointer(builder, "/materials/1/pbrMetallicRoughness/metallicFactor", {0.25f, 0.75f});
    builder.folder.write("model.gltf", builder.json.dump());
    const std::string file = builder.folder.file("scene.json", R"({"tessera": 1,
        "include": [{"file": "model.gltf"}, {"file": "model.gltf", "name": "other"}],
        "materials": [{"name": "paint", "model": "lambert"}],
        "overrides": [{"node": "first", "material": "paint"}]})");
    Scene scene = loadScene(file);
    ASSERT_EQ(scene.rig.playing.size(), 2u);
    poseScene(scene, 1.0);
    int changed = 0;
    for (const Material& material : scene.materials) {
        EXPECT_FLOAT_EQ(material.metallic, material.name == "b" ? 0.75f : 1.0f) << material.name;
        changed += material.name == "b";
    }
    EXPECT_EQ(changed, 2);
}

TEST(GltfAnimation, whatASceneFileSaysOfAMaterialHoldsWhereNoClipPlays) {
    Builder builder;
    builder.material();
    addPointer(builder, "/materials/0/pbrMetallicRoughness/metallicFactor", {0.25f, 0.75f});
    builder.folder.write("model.gltf", builder.json.dump());
    const std::string file = builder.folder.file("scene.json", R"({"tessera": 1, "base": {"file": "model.gltf"},
        "materials": [{"replaces": 0, "name": "gold", "model": "metallic_roughness", "metallic": 0.5}]})");
    EXPECT_EQ(loadScene(file).materials.at(0).metallic, 0.25f);
    EXPECT_EQ(loadScene(file, loading(&LoadOptions::clip, "none")).materials.at(0).metallic, 0.5f);
}

TEST(GltfAnimation, savingAPosedSceneWritesNoMaterialUnlessItWasEdited) {
    Builder builder;
    builder.material();
    addPointer(builder, "/materials/0/pbrMetallicRoughness/metallicFactor", {0.25f, 0.75f});
    const std::string file = builder.folder.file("model.gltf", builder.json.dump());
    const std::filesystem::path copy = std::filesystem::path(file).parent_path() / "saved.json";
    Scene scene = loadScene(file);
    const SceneOrigin origin = originOf(file, {}, scene);
    poseScene(scene, 1.0);
    EXPECT_EQ(scene.materials[0].metallic, 0.75f);
    EXPECT_FALSE(Json::parse(sceneText(scene, origin, copy)).contains("materials"));
    scene.materials[0].perceptualRoughness = 0.125f;
    const Json materials = Json::parse(sceneText(scene, origin, copy)).at("materials");
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].value("metallic", 1.0f), 1.0f) << "at rest";
}

TEST(GltfAnimation, aSceneFileThatReplacesLightsAndCamerasLeavesTheOldOnesToNoClip) {
    Builder builder = movingTriangle();
    builder.merge(R"({"nodes": [{"mesh": 0, "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
                      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
    builder.folder.write("model.gltf", builder.json.dump());
    const std::string file = builder.folder.file("scene.json", R"({"tessera": 1, "base": {"file": "model.gltf"},
        "lights": [{"type": "point", "position": [0, 3, 0]}],
        "cameras": [{"name": "own", "position": [0, 0, 9], "target": [0, 0, 0]}]})");
    Scene scene = loadScene(file);
    poseScene(scene, 1.0);
    expectPlace(scene.lights.at(0).positionWS, {0.0, 3.0, 0.0});
    expectPlace(glm::dvec3(scene.cameras.at(0).worldFromCamera[3]), {0.0, 0.0, 9.0});
    expectPlace(glm::dvec3(scene.nodes.at(0).parentFromNode[3]), {2.0, 0.0, 0.0});
}

} // namespace
} // namespace tessera::scenes::gltf::test
