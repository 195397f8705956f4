// Opened scenes with playing clips: moving parts, edits meanwhile, and unchanged parts.
#include "base/Error.h"
#include "scenes/Clips.h"
#include "scenes/Fingerprint.h"
#include "scenes/Pose.h"
#include "scenes/Rest.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/viewer/Scenes.h"

namespace tessera::viewer {
namespace {

using namespace test;

/// riggedScene() with a camera that no node carries.
scenes::Scene riggedAndSeen() {
    scenes::Scene scene = scenes::riggedScene();
    scene.rig.cameras.clear();
    scene.cameras[0] = perspective({0, 0, 9}, {0, 0, 0});
    return scene;
}

scenes::Scene withoutClips() {
    scenes::Scene scene = riggedAndSeen();
    scene.rig = {};
    return scene;
}

TEST(OpenScene, clipsMoveMeshesAndLeaveWhatIsEditedHere) {
    const scenes::Scene scene = riggedAndSeen();
    OpenScene open("rigged.gltf", {}, scene, {});
    open.replaceLights("delete all", 0, open.scene().lights.size(), {});
    const std::uint64_t revision = open.revision(), edits = open.edits();
    EXPECT_FALSE(open.showTime(0.0)) << "it is shown already";
    EXPECT_TRUE(open.showTime(1.0));
    EXPECT_EQ(open.geometryRevision(), 1u);
    EXPECT_GT(open.revision(), revision);
    EXPECT_FALSE(open.showTime(1.0));
    EXPECT_EQ(open.edits(), edits) << "a pose is no edit";
    EXPECT_TRUE(open.scene().lights.empty());
    EXPECT_NE(open.scene().meshes[0].positionsOS, scene.meshes[0].positionsOS);
    EXPECT_EQ(open.scene().cameras[0].worldFromCamera, scene.cameras[0].worldFromCamera);
    OpenScene still("still.gltf", {}, withoutClips(), {});
    EXPECT_FALSE(still.showTime(1.0)) << "it has no clip";
}

/// The clip moves the node of the light, and of the camera, from (1, 0, 0) to (3, 0, 0) within its second, and doubles
/// the light's intensity.
scenes::Scene riggedAndMoving() {
    scenes::Scene scene = scenes::riggedScene();
    scenes::Clip& clip = scene.rig.clips[0];
    clip.samplers.push_back({scenes::Interpolation::Linear, 3, {0.0f, 1.0f}, {1, 0, 0, 3, 0, 0}});
    clip.channels.push_back({scenes::AnimatedProperty::Translation, 0, 3});
    return scene;
}

TEST(OpenScene, aClipsLensIsFollowedWhereverTheUserMovesTheCamera) {
    scenes::Scene scene = riggedAndSeen();
    scene.rig.numbers.push_back({scenes::AnimatedProperty::CameraFovY, 0});
    scenes::Clip& clip = scene.rig.clips[0];
    clip.samplers.push_back({scenes::Interpolation::Linear, 1, {0.0f, 1.0f}, {0.5f, 1.0f}});
    clip.channels.push_back({scenes::AnimatedProperty::CameraFovY, 1, 3});
    scenes::takeRest(scene);
    const double restRadians = scene.cameras[0].fovYRadians;
    OpenScene open("rigged.gltf", {}, scene, {});
    const auto shown = [&] { return open.scene().cameras[0]; };
    open.showTime(1.0);
    EXPECT_EQ(shown().fovYRadians, 1.0);
    EXPECT_EQ(shown().worldFromCamera, scene.cameras[0].worldFromCamera);
    CameraPose pose = open.rig().pose();
    pose.focusMetres *= 2.0;
    open.rig().jumpTo(pose);
    open.applyRig();
    const glm::dmat4 moved = shown().worldFromCamera;
    open.showTime(0.5);
    EXPECT_EQ(shown().fovYRadians, 0.75);
    EXPECT_EQ(shown().worldFromCamera, moved);
    open.playClip("none");
    EXPECT_EQ(shown().fovYRadians, restRadians) << "at rest again";
    open.place(changing(&Change::fovYDegrees, 90.0));
    open.playClip("0");
    open.showTime(0.5);
    EXPECT_NEAR(shown().fovYRadians, 1.5707963267948966, 1e-12) << "the user's own stays";
}

TEST(OpenScene, clipsMoveLightsAsFarAsTheyAreNotEdited) {
    OpenScene open("rigged.gltf", {}, riggedAndMoving(), {});
    const auto expectLight = [&](std::size_t index, const glm::dvec3& positionWS, float intensity) {
        const scenes::Light& light = open.scene().lights[index];
        EXPECT_LT(glm::distance(light.positionWS, positionWS), 1e-12);
        EXPECT_FLOAT_EQ(light.intensity, intensity);
    };
    const auto change = [&](auto edit) { changeLight(open, 0, edit); };
    open.showTime(1.0);
    expectLight(0, {3, 0, 0}, 2.0f);
    EXPECT_FALSE(open.isEdited()) << "a pose is no edit";
    change([](scenes::Light& light) { light.castsShadow = !light.castsShadow; });
    open.showTime(0.5);
    expectLight(0, {2, 0, 0}, 1.5f);
    change([](scenes::Light& light) { light.positionWS = {0, 9, 0}; });
    open.showTime(1.0);
    expectLight(0, {0, 9, 0}, 2.0f);
    change([](scenes::Light& light) { light.intensity = 7.0f; });
    open.showTime(0.25);
    expectLight(0, {0, 9, 0}, 7.0f);
    open.undo();
    expectLight(0, {0, 9, 0}, 1.25f);
    open.undo();
    expectLight(0, {1.5, 0, 0}, 1.25f);
    open.redo();
    open.showTime(1.0);
    expectLight(0, {0, 9, 0}, 2.0f);
    open.playClip("none");
    open.undo();
    expectLight(0, {1, 0, 0}, 1.0f);
}

TEST(OpenScene, clipsMoveTheirLightsWhileOthersComeAndGo) {
    OpenScene open("rigged.gltf", {}, riggedAndMoving(), {});
    const auto xOf = [&](std::size_t index) { return open.scene().lights[index].positionWS.x; };
    open.replaceLights("add", 0, 0, {scenes::Light()});
    open.showTime(0.5);
    EXPECT_EQ(xOf(0), 0.0);
    EXPECT_DOUBLE_EQ(xOf(1), 2.0);
    open.replaceLights("delete", 1, 1, {});
    open.showTime(1.0);
    EXPECT_EQ(open.scene().lights.size(), 1u);
    EXPECT_EQ(xOf(0), 0.0);
    open.undo();
    EXPECT_DOUBLE_EQ(xOf(1), 3.0) << "it is where it is by now";
    open.undo();
    open.showTime(0.5);
    EXPECT_DOUBLE_EQ(xOf(0), 2.0);
    open.becomes("/saved.json");
    open.showTime(1.0);
    EXPECT_DOUBLE_EQ(xOf(0), 2.0) << "the file has it there";
}

TEST(OpenScene, aCameraFollowsItsClipUnlessItIsTheUsers) {
    OpenScene open("rigged.gltf", {}, riggedAndMoving(), {});
    const auto eyeWS = [&] { return glm::dvec3(open.scene().cameras[0].worldFromCamera[3]); };
    const auto expectEye = [&](const glm::dvec3& expectedWS) { EXPECT_LT(glm::distance(eyeWS(), expectedWS), 1e-9); };
    EXPECT_TRUE(open.clipMovesCamera());
    EXPECT_TRUE(open.followsClipCamera());
    open.showTime(1.0);
    expectEye({3, 0, 0});
    EXPECT_EQ(open.cameraChange(), scenes::CameraChange()) << "a command with the same time has it there";
    turnCamera(open);
    const glm::dvec3 handWS = eyeWS();
    EXPECT_GT(glm::distance(handWS, glm::dvec3(3, 0, 0)), 1e-3);
    open.showTime(0.5);
    EXPECT_FALSE(open.followsClipCamera());
    expectEye(handWS);
    open.followClipCamera(true);
    EXPECT_TRUE(open.followsClipCamera());
    expectEye({2, 0, 0});
    open.undo();
    expectEye(handWS);
    open.redo();
    expectEye({2, 0, 0});
    open.followClipCamera(false);
    open.showTime(1.0);
    EXPECT_FALSE(open.followsClipCamera());
    expectEye({2, 0, 0});
    open.playClip("none");
    EXPECT_FALSE(open.clipMovesCamera()) << "there is nothing to follow";
    expectEye({2, 0, 0});
    open.playClip("0");
    open.followClipCamera(true);
    open.showTime(1.0);
    expectEye({3, 0, 0});
    open.playClip("none");
    expectEye({1, 0, 0});
}

TEST(OpenScene, aPlacedCameraStandsStill) {
    OpenScene open("rigged.gltf", {}, riggedAndMoving(), {});
    open.place(changing(&Change::eyeWS, glm::dvec3(0, 0, 9)));
    const scenes::Camera placed = open.scene().cameras[0];
    open.showTime(1.0);
    EXPECT_FALSE(open.followsClipCamera());
    EXPECT_EQ(open.scene().cameras[0], placed);
}

TEST(OpenScene, savingKeepsTheClipThatWasChosen) {
    scenes::LoadOptions load;
    load.clip = "bend";
    load.lights = 1;
    OpenScene open("rigged.gltf", load, riggedAndSeen(), {});
    open.playClip("none");
    EXPECT_EQ(open.scene().options.clip, "none");
    open.becomes("/saved.json");
    EXPECT_EQ(open.scene().options.clip, "none");
    EXPECT_FALSE(open.load().clip) << "the file says it";
    EXPECT_FALSE(open.load().lights) << "the file has its lights";
}

TEST(OpenScene, aClipStandsStillAfterItsEnd) {
    OpenScene open("rigged.gltf", {}, riggedAndSeen(), {});
    EXPECT_EQ(open.clipSeconds(), 1.0);
    EXPECT_TRUE(open.showTime(5.0));
    EXPECT_FALSE(open.showTime(6.0));
    EXPECT_EQ(open.geometryRevision(), 1u);
    EXPECT_TRUE(open.showTime(0.5));
    EXPECT_EQ(OpenScene("still.gltf", {}, withoutClips(), {}).clipSeconds(), 0.0) << "it has no clip";
}

TEST(OpenScene, anotherClipBeginsAndNoneLeavesTheSceneByItself) {
    scenes::Scene scene = riggedAndSeen();
    scenes::poseScene(scene, 0.0); // as at the clip's beginning
    const std::vector<glm::vec3> atRest = scene.meshes[0].positionsOS;
    OpenScene open("rigged.gltf", {}, scene, {});
    ASSERT_TRUE(open.showTime(1.0));
    ASSERT_NE(open.scene().meshes[0].positionsOS, atRest);
    const std::uint64_t geometry = open.geometryRevision(), edits = open.edits();
    open.playClip("none");
    EXPECT_EQ(open.scene().meshes[0].positionsOS, atRest);
    EXPECT_GT(open.geometryRevision(), geometry);
    EXPECT_EQ(open.edits(), edits) << "it is no edit";
    EXPECT_EQ(open.load().clip, "none") << "a command line plays it too";
    EXPECT_EQ(open.clipSeconds(), 0.0);
    EXPECT_FALSE(open.showTime(1.0));
    open.playClip("0");
    EXPECT_EQ(open.clipSeconds(), 1.0);
    EXPECT_TRUE(open.showTime(1.0));
    EXPECT_THROW(open.playClip("no such clip"), InputError);
    EXPECT_EQ(open.load().clip, "0");
    EXPECT_EQ(open.scene().options.clip, "0");
    EXPECT_TRUE(open.showTime(0.5)) << "the clip before still plays";
}

/// riggedAndSeen() with a clip "shine", which raises the material's metallic from 0.5 to 1; without the clip it is
/// 0.125.
scenes::Scene riggedAndShining() {
    scenes::Scene scene = riggedAndSeen();
    scene.rig.numbers.push_back({scenes::AnimatedProperty::Metallic, 0});
    scenes::Clip& shine = scene.rig.clips.emplace_back();
    shine.name = "shine";
    shine.samplers.push_back({scenes::Interpolation::Linear, 1, {0.0f, 1.0f}, {0.5f, 1.0f}});
    shine.channels.push_back({scenes::AnimatedProperty::Metallic, 1, 0});
    scene.materials[0].metallic = 0.125f;
    scenes::takeRest(scene);
    return scene;
}

TEST(OpenScene, anEditOfAMaterialHoldsNothingOfTheClipThatPlaysMeanwhile) {
    const scenes::Scene scene = riggedAndShining();
    OpenScene open("rigged.gltf", {}, scene, {});
    const auto material = [&] { return open.scene().materials[0]; };
    open.playClip("shine");
    open.showTime(1.0);
    scenes::Material edited = material();
    EXPECT_EQ(edited.metallic, 1.0f);
    edited.baseColor.x = 0.25f;
    open.changeMaterial(0, edited);
    EXPECT_EQ(material(), edited);
    open.showTime(0.5);
    EXPECT_EQ(material().metallic, 0.75f);
    open.playClip("none");
    EXPECT_EQ(material().metallic, 0.125f);
    EXPECT_EQ(material().baseColor.x, 0.25f);
    open.undo();
    EXPECT_EQ(material(), scene.materials[0]);
    open.playClip("shine");
    open.showTime(1.0);
    open.redo();
    EXPECT_EQ(material(), edited);
    EXPECT_EQ(scenes::restingMaterials(open.scene())[0].metallic, 0.125f) << "what is saved";
}

TEST(OpenScene, aVariantGoesOnWithEditsOfAMaterialThatAClipChanges) {
    scenes::Scene loaded = riggedAndShining();
    scenes::playClip(loaded, "shine"); // as for a file that names it
    scenes::poseScene(loaded, 0.0);
    ASSERT_EQ(loaded.materials[0].metallic, 0.5f) << "unlike at rest";
    OpenScene open("rigged.gltf", {}, loaded, {});
    scenes::Material edited = open.scene().materials[0];
    edited.baseColor.x = 0.25f;
    open.changeMaterial(0, edited);
    EXPECT_TRUE(open.canGoOnAs(loaded));
    loaded.materials[0].baseColor.y = 0.5f;
    EXPECT_FALSE(open.canGoOnAs(loaded));
}

TEST(OpenScene, aNumberThatIsEditedWhileItsClipStandsIsThereAgainAfterTheClip) {
    const scenes::Scene scene = riggedAndShining();
    OpenScene open("rigged.gltf", {}, scene, {});
    const auto metallic = [&] { return open.scene().materials[0].metallic; };
    scenes::Material edited = scene.materials[0];
    edited.metallic = 0.25f;
    open.changeMaterial(0, edited);
    open.playClip("shine");
    open.showTime(1.0);
    EXPECT_EQ(metallic(), 1.0f);
    EXPECT_EQ(scenes::restingMaterials(open.scene())[0].metallic, 0.25f) << "what is saved";
    open.undo();
    EXPECT_EQ(metallic(), 1.0f);
    open.playClip("none");
    EXPECT_EQ(metallic(), 0.125f);
    open.redo();
    EXPECT_EQ(metallic(), 0.25f);
}

TEST(OpenScene, aRefusedPoseLeavesTheOneBefore) {
    scenes::Scene scene = riggedAndSeen();
    scenes::Clip& clip = scene.rig.clips[0];
    clip.samplers.push_back({scenes::Interpolation::Step, 3, {0.0f, 0.75f}, {1, 0, 0, 1e16f, 0, 0}});
    clip.channels.push_back({scenes::AnimatedProperty::Translation, 0, 3});
    OpenScene open("rigged.gltf", {}, scene, {});
    ASSERT_TRUE(open.showTime(0.5));
    const std::uint64_t before = scenes::fingerprint(open.scene());
    EXPECT_THROW(open.showTime(0.875), InputError);
    EXPECT_EQ(scenes::fingerprint(open.scene()), before);
    EXPECT_EQ(open.geometryRevision(), 1u);
    EXPECT_FALSE(open.showTime(0.875)) << "it was said already";
    EXPECT_FALSE(open.showTime(0.5)) << "it is shown still";
    EXPECT_THROW(open.showTime(0.875), InputError);
    EXPECT_TRUE(open.showTime(0.25));
}

} // namespace
} // namespace tessera::viewer
