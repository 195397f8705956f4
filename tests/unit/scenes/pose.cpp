#include "scenes/Pose.h"

#include <chrono>
#include <cmath>
#include <tuple>

#include "base/Error.h"
#include "scenes/Clips.h"
#include "scenes/Fingerprint.h"
#include "scenes/Rest.h"
#include "scenes/RigLinks.h"
#include "scenes/import/AppendScene.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {
namespace {

/// World positions of the first instance that node `node` draws.
std::vector<glm::dvec3> positionsWS(const Scene& scene, std::size_t node) {
    const glm::dmat4 worldFromNode = worldFromNodes(scene)[node];
    const Mesh& mesh = scene.meshes[std::size_t(scene.nodes[node].instances.at(0).mesh)];
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& positionOS : mesh.positionsOS)
        positions.emplace_back(worldFromNode * glm::dvec4(positionOS, 1.0));
    return positions;
}

void expectAt(const glm::dvec3& found, const glm::dvec3& wanted, double tolerance = 1e-6) {
    EXPECT_NEAR(found.x, wanted.x, tolerance);
    EXPECT_NEAR(found.y, wanted.y, tolerance);
    EXPECT_NEAR(found.z, wanted.z, tolerance);
}

constexpr std::size_t kSkinned = 3; // node

// ---- Skins and morph targets ---------------------------------------------------------------------------------------

TEST(Poses, jointsAndTargetsMoveVerticesAsTheirWeightsSay) {
    Scene scene = riggedScene();
    ASSERT_NO_THROW(checkScene(scene));
    poseScene(scene, 1.0);
    const std::vector<glm::dvec3> positions = positionsWS(scene, kSkinned);
    expectAt(positions[0], {0.0, 0.0, 0.0});
    expectAt(positions[1], {1.0, 1.0, 0.0}); // 1 beyond the knee, turned
    // Halfway between (0, 4, 1), by the hip, and (-3, -1, 1), by the knee turned about (1, 0).
    expectAt(positions[2], {-1.5, 1.5, 1.0});
    EXPECT_NO_THROW(checkScene(scene));
}

TEST(Poses, aPoseDependsOnItsTimeAlone) {
    Scene direct = riggedScene(), wandering = riggedScene();
    poseScene(direct, 0.25);
    for (const double time : {1e9, -1e9, 0.9, 0.25}) poseScene(wandering, time);
    EXPECT_EQ(fingerprint(direct), fingerprint(wandering));
    playClip(direct, "none");
    playClip(wandering, "none");
    poseScene(direct, 0.9);
    poseScene(wandering, 0.0);
    EXPECT_EQ(fingerprint(direct), fingerprint(wandering));
    expectAt(positionsWS(direct, kSkinned)[1], {2.0, 0.0, 0.0});
}

TEST(Poses, weightsNeedNotSumToOneAndWithoutAnyAVertexFollowsItsNode) {
    Scene scene = riggedScene();
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 7.0, 1.0);
    Shape& shape = scene.rig.shapes[0];
    for (float& weight : shape.weights) weight *= 0.25f;
    std::fill_n(shape.weights.begin(), 4, 0.0f);
    poseScene(scene, 1.0);
    const std::vector<glm::dvec3> positions = positionsWS(scene, kSkinned);
    expectAt(positions[0], {0.0, 0.0, 7.0});
    expectAt(positions[1], {1.0, 1.0, 0.0});
    expectAt(positions[2], {-1.5, 1.5, 1.0});
}

TEST(Poses, aSkinnedMeshIgnoresItsNodesTransform) {
    Scene scene = riggedScene(), moved = riggedScene();
    moved.nodes[0].parentFromNode = glm::dmat4(-3.0);
    moved.nodes[0].parentFromNode[3] = glm::dvec4(5.0, 6.0, 7.0, 1.0);
    for (Scene* one : {&scene, &moved}) poseScene(*one, 0.5);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(positionsWS(scene, kSkinned)[i], positionsWS(moved, kSkinned)[i]) << i;
}

TEST(Poses, normalsStandOnTheDeformedSurface) {
    for (const double mirror : {1.0, -1.0}) {
        Scene scene = riggedScene();
        scene.nodes[1].parentFromNode[0][0] = 3.0 * mirror; // sheared by the knee below
        scene.rig.shapes[0].weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
        scene.rig.shapes[0].joints = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
        scene.rig.shapes[0].rest.positionsOS[2].z = 1.0f; // oblique
        const auto normalOf = [](const std::vector<glm::dvec3>& p) {
            return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        };
        const std::vector<glm::vec3>& rest = scene.rig.shapes[0].rest.positionsOS;
        const glm::dvec3 normalOS = normalOf({rest.begin(), rest.end()});
        scene.rig.shapes[0].rest.normalsOS.assign(3, glm::vec3(normalOS));
        playClip(scene, "none");
        poseScene(scene, 0.0);
        const glm::dmat3 worldFromMesh(worldFromNodes(scene)[kSkinned]);
        // When drawn, a mirrored node flips the winding, and its normals take the inverse transpose.
        const double side = glm::determinant(worldFromMesh) < 0.0 ? -1.0 : 1.0;
        EXPECT_EQ(side, mirror);
        const glm::dvec3 normalWS =
            glm::normalize(glm::transpose(glm::inverse(worldFromMesh)) * glm::dvec3(scene.meshes[0].normalsOS[0]));
        expectAt(normalWS, side * normalOf(positionsWS(scene, kSkinned)));
    }
}

/// Tangents lie in the surface, so a stretching joint transforms them like the surface and not like normals.
TEST(Poses, tangentsLieInTheDeformedSurface) {
    Scene scene = riggedScene();
    const float half = std::sqrt(0.5f);
    scene.rig.shapes[0].rest.tangentsOS.assign(3, glm::vec4(half, half, 0.0f, -1.0f));
    scene.meshes[0].tangentsOS = scene.rig.shapes[0].rest.tangentsOS;
    scene.rig.shapes[0].targets[0].tangentsOS = {{0, 0, 0}, {0, 0, 0}, {-half, half, 0}};
    scene.rig.playing.clear();
    scene.rig.nodes[0].scale = {1.0, 2.0, 1.0}; // of the knee, which the second vertex follows
    poseScene(scene, 0.0);
    const std::vector<glm::vec4>& tangents = scene.meshes[0].tangentsOS;
    const auto expectAlong = [](const glm::vec4& tangent, const glm::dvec3& direction) {
        EXPECT_LT(glm::distance(glm::dvec3(tangent), glm::normalize(direction)), 1e-6) << tangent.x << " " << tangent.y;
        EXPECT_EQ(tangent.w, -1.0f);
    };
    expectAlong(tangents[0], {1.0, 1.0, 0.0});
    expectAlong(tangents[1], {1.0, 2.0, 0.0});
    expectAlong(tangents[2], {1.0, 1.5, 0.0}); // half of both joints
    scene.rig.weights[0] = {1.0f};
    poseScene(scene, 0.0);
    expectAlong(tangents[2], {0.0, 1.0, 0.0});
}

TEST(Poses, verticesWithoutWeightAreMirroredWithTheirNode) {
    for (const double mirror : {1.0, -1.0}) {
        Scene scene = riggedScene();
        scene.nodes[0].parentFromNode[0][0] = mirror;
        scene.rig.shapes[0].weights.assign(12, 0.0f);
        poseScene(scene, 0.0);
        EXPECT_EQ(glm::determinant(glm::dmat3(worldFromNodes(scene)[kSkinned])), mirror);
        expectAt(positionsWS(scene, kSkinned)[1], {2.0 * mirror, 0.0, 0.0});
        // One vertex of three follows the node, so the other two decide the facing.
        scene.rig.shapes[0].weights = {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
        poseScene(scene, 0.0);
        EXPECT_EQ(glm::determinant(glm::dmat3(worldFromNodes(scene)[kSkinned])), 1.0);
    }
}

TEST(Poses, singularJointsLeaveUnitNormals) {
    Scene scene = riggedScene();
    scene.nodes[1].parentFromNode = glm::dmat4(0.0);
    scene.nodes[1].parentFromNode[3].w = 1.0;
    scene.rig.shapes[0].rest.tangentsOS.assign(3, {1.0f, 0.0f, 0.0f, 1.0f});
    scene.meshes[0].tangentsOS = scene.rig.shapes[0].rest.tangentsOS;
    poseScene(scene, 0.5);
    EXPECT_NO_THROW(checkScene(scene));
    for (const glm::vec3& normalOS : scene.meshes[0].normalsOS) EXPECT_NEAR(glm::length(normalOS), 1.0f, 1e-6f);
}

TEST(Poses, aMeshFarFromTheOriginKeepsItsDigits) {
    Scene scene = riggedScene();
    scene.nodes[1].parentFromNode[3].x = 1e7;
    poseScene(scene, 1.0);
    expectAt(positionsWS(scene, kSkinned)[1] - glm::dvec3(1e7, 0.0, 0.0), {1.0, 1.0, 0.0});
}

TEST(Poses, aPoseThatIsNowhereIsRefusedByName) {
    Scene scene = riggedScene();
    scene.nodes[1].parentFromNode[3].x = 1e16;
    EXPECT_THAT(test::inputErrorOf([&] { poseScene(scene, 0.0); }), testing::HasSubstr("scene 'rigged'"));
}

TEST(Poses, aSkinOfManyJointsIsComputedOnceForAllItsMeshes) {
    constexpr std::size_t kMany = 40'000;
    Scene scene = riggedScene();
    scene.rig.skins[0].joints.resize(kMany, 1);
    scene.rig.skins[0].jointFromBind.resize(kMany, glm::dmat4(1.0));
    scene.rig.deformed.resize(kMany, scene.rig.deformed[0]);
    const auto start = std::chrono::steady_clock::now();
    poseScene(scene, 1.0);
    expectAt(positionsWS(scene, kSkinned)[1], {1.0, 1.0, 0.0});
    // About 50 ms; half a minute if every mesh evaluated all joints.
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);
}

// ---- Moving lights, cameras and numbers ----------------------------------------------------------------------------

TEST(Poses, lightsAndCamerasMoveWithTheirNodeAndNumbersWithTheClip) {
    Scene scene = riggedScene();
    poseScene(scene, 1.0);
    expectAt(scene.lights[0].positionWS, {1.0, 0.0, 0.0});
    expectAt(scene.lights[0].directionWS, {0.0, 0.0, -1.0});
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 2.0f);
    expectAt(glm::dvec3(scene.cameras[0].worldFromCamera[0]), {0.0, 1.0, 0.0});
    expectAt(glm::dvec3(scene.cameras[0].worldFromCamera[3]), {1.0, 0.0, 0.0});
}

/// Other parts are not rebuilt for each image.
TEST(Poses, theMovingPartsAreThoseThatPlayingClipsChange) {
    const auto partsOf = [](const Scene& scene) {
        const MovingParts parts = movingParts(scene);
        return std::string(parts.geometry ? "geometry " : "") + (parts.materials ? "materials" : "");
    };
    Scene scene = riggedScene();
    Clip& clip = scene.rig.clips[0];
    const std::vector<AnimationChannel> all = clip.channels; // for a joint, a weight and a light
    EXPECT_EQ(partsOf(scene), "geometry ");
    clip.channels = {all[1]};
    EXPECT_EQ(partsOf(scene), "geometry ");
    clip.channels = {all[2]};
    EXPECT_EQ(partsOf(scene), "");
    scene.rig.numbers.push_back({AnimatedProperty::Metallic, 0, glm::vec4(0.0f)});
    clip.channels = {{AnimatedProperty::Metallic, 1, 2}};
    EXPECT_EQ(partsOf(scene), "materials");

    scene.rig.deformed.clear();
    clip.channels = {all[0]};
    EXPECT_EQ(partsOf(scene), "") << "only the camera and the light hang on the joint";
    EXPECT_TRUE(movesCamera(scene, 0));
    scene.nodes[3].parent = 2;
    EXPECT_EQ(partsOf(scene), "geometry ");
    scene.rig.playing.clear();
    EXPECT_EQ(partsOf(scene), "");
    EXPECT_FALSE(movesCamera(scene, 0));
}

TEST(Poses, numbersStayWithinTheirBounds) {
    Scene scene = riggedScene();
    scene.rig.numbers.push_back({AnimatedProperty::Metallic, 0, glm::vec4(0.5f)});
    scene.rig.numbers.push_back({AnimatedProperty::LightRange, 0, glm::vec4(kInfinity)});
    scene.rig.clips[0].samplers.push_back({Interpolation::Linear, 1, {0.0f, 1.0f}, {-3.0f, 3.0f}});
    scene.rig.clips[0].channels.push_back({AnimatedProperty::Metallic, 1, 3});
    poseScene(scene, 0.0);
    EXPECT_EQ(scene.materials[0].metallic, 0.0f);
    EXPECT_EQ(scene.lights[0].rangeMetres, kInfinity);
    poseScene(scene, 1.0);
    EXPECT_EQ(scene.materials[0].metallic, 1.0f);
    EXPECT_NO_THROW(checkScene(scene));
}

TEST(Poses, numbersThatNoPlayingClipChangesAreFreeAndOthersComeBackToRest) {
    Scene scene = riggedScene();
    scene.rig.numbers.push_back({AnimatedProperty::Metallic, 0});
    Clip& other = scene.rig.clips.emplace_back();
    other.name = "shine";
    other.samplers.push_back({Interpolation::Linear, 1, {0.0f, 1.0f}, {0.5f, 1.0f}});
    other.channels.push_back({AnimatedProperty::Metallic, 1, 0});
    scene.materials[0].metallic = 0.125f;
    takeRest(scene);
    ASSERT_NO_THROW(checkScene(scene));
    scene.materials[0].metallic = 0.25f; // edited
    poseScene(scene, 1.0);
    EXPECT_EQ(scene.materials[0].metallic, 0.25f);
    EXPECT_EQ(restingMaterials(scene), scene.materials);
    EXPECT_EQ(scene.lights[0].intensity, 2.0f);
    playClip(scene, "shine");
    EXPECT_EQ(scene.lights[0].intensity, 1.0f);
    poseScene(scene, 1.0);
    EXPECT_EQ(scene.materials[0].metallic, 1.0f);
    EXPECT_EQ(restingMaterials(scene)[0].metallic, 0.125f);
    playClip(scene, "none");
    EXPECT_EQ(scene.materials[0].metallic, 0.125f);
}

TEST(Poses, aMaterialIsEditedAtRestAndKeepsGoingWithTheClip) {
    Scene scene = riggedScene();
    scene.rig.numbers.push_back({AnimatedProperty::Metallic, 0});
    scene.rig.numbers.push_back({AnimatedProperty::TextureOffset, 0, {}, TextureSlot::BaseColor});
    Clip& clip = scene.rig.clips[0];
    clip.samplers.push_back({Interpolation::Linear, 1, {0.0f, 1.0f}, {0.5f, 1.0f}});
    clip.samplers.push_back({Interpolation::Linear, 2, {0.0f, 1.0f}, {0.0f, 0.0f, 2.0f, 4.0f}});
    clip.channels.push_back({AnimatedProperty::Metallic, 1, 3});
    clip.channels.push_back({AnimatedProperty::TextureOffset, 2, 4});
    scene.materials[0].metallic = 0.125f;
    takeRest(scene);
    const Material before = scene.materials[0];
    poseScene(scene, 1.0);
    EXPECT_EQ(restingMaterial(scene, 0), before);
    Material edited = scene.materials[0];
    edited.baseColor.x = 0.25f;
    const Material resting = editedAtRest(scene, 0, edited);
    EXPECT_EQ(resting.baseColor.x, 0.25f);
    EXPECT_EQ(resting.metallic, 0.125f) << "the edit left it alone";
    EXPECT_EQ(resting.texture(TextureSlot::BaseColor).transform, before.texture(TextureSlot::BaseColor).transform);
    edited.metallic = 0.75f;
    EXPECT_EQ(editedAtRest(scene, 0, edited).metallic, 0.75f);
    replaceMaterial(scene, 0, editedAtRest(scene, 0, edited), 0.5);
    EXPECT_EQ(scene.materials[0].metallic, 0.75f) << "halfway between 0.5 and 1, of the clip";
    EXPECT_EQ(scene.materials[0].texture(TextureSlot::BaseColor).transform.offset, glm::vec2(1.0f, 2.0f));
    playClip(scene, "none");
    Material wanted = before;
    wanted.baseColor.x = 0.25f;
    wanted.metallic = 0.75f;
    EXPECT_EQ(scene.materials[0], wanted);
}

TEST(Poses, anIncludedRigMovesBelowItsRoot) {
    Scene whole = riggedScene();
    glm::dmat4 worldFromPart(1.0);
    worldFromPart[0][0] = -2.0; // mirrored, and wider
    worldFromPart[3] = glm::dvec4(0.0, 100.0, 0.0, 1.0);
    const std::size_t nodesBefore = whole.nodes.size() + 1;
    appendScene(whole, riggedScene(), "part", worldFromPart);
    ASSERT_NO_THROW(checkScene(whole));
    ASSERT_EQ(whole.rig.playing.size(), 2u);
    poseScene(whole, 1.0);
    const std::vector<glm::dvec3> own = positionsWS(whole, kSkinned);
    const std::vector<glm::dvec3> part = positionsWS(whole, nodesBefore + kSkinned);
    for (std::size_t i = 0; i < own.size(); ++i)
        expectAt(part[i], glm::dvec3(worldFromPart * glm::dvec4(own[i], 1.0)), 1e-5);
    expectAt(whole.lights[1].positionWS, {-2.0, 100.0, 0.0});
    EXPECT_FLOAT_EQ(whole.lights[1].intensity, 2.0f);
    EXPECT_NO_THROW(checkScene(whole));
}

/// riggedScene() whose clip also narrows the field of view.
Scene zoomingScene() {
    Scene scene = riggedScene();
    scene.rig.numbers.push_back({AnimatedProperty::CameraFovY, 0});
    scene.rig.clips[0].samplers.push_back({Interpolation::Linear, 1, {0.0f, 1.0f}, {0.75f, 0.25f}});
    scene.rig.clips[0].channels.push_back({AnimatedProperty::CameraFovY, 1, 3});
    takeRest(scene);
    return scene;
}

TEST(Poses, aLensOfAnIncludedPartIsThatOfItsOwnCamera) {
    Scene whole = zoomingScene();
    whole.rig.playing.clear();
    const double restRadians = whole.cameras[0].fovYRadians;
    appendScene(whole, zoomingScene(), "part", glm::dmat4(1.0));
    ASSERT_EQ(whole.cameras.size(), 2u);
    poseScene(whole, 1.0);
    EXPECT_NO_THROW(checkScene(whole));
    EXPECT_EQ(whole.cameras[0].fovYRadians, restRadians);
    EXPECT_EQ(whole.cameras[1].fovYRadians, 0.25);
    dropCameras(whole);
    EXPECT_NO_THROW(poseScene(whole, 0.5));
    EXPECT_NO_THROW(checkScene(whole));
}

TEST(Poses, splinesThatGoPastTheirKeysLeaveALensThatCanBe) {
    Scene scene = zoomingScene();
    scene.rig.clips[0].samplers[3].values = {-3.0f, 9.0f};
    for (const double timeSeconds : {0.0, 1.0}) {
        poseScene(scene, timeSeconds);
        EXPECT_NO_THROW(checkScene(scene)) << timeSeconds;
    }
}

TEST(Poses, aFactorMultipliesAndIsOneNumber) {
    Scene scene = riggedScene();
    scene.rig.clips[0].channels[2].factor = 1; // rises from 0 to 1; the intensity from 1 to 2
    EXPECT_NO_THROW(checkScene(scene));
    poseScene(scene, 0.5);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 0.75f);
    scene.rig.clips[0].channels[2].factor = 0; // rotations
    EXPECT_THROW(checkScene(scene), InputError);
    scene.rig.clips[0].channels[2].factor = 9;
    EXPECT_THROW(checkScene(scene), InputError);
}

TEST(Poses, numbersThatBelongToNothingAreRefused) {
    for (const RestNumber& number :
         {RestNumber{AnimatedProperty::EmissiveStrength, 0}, RestNumber{AnimatedProperty::Rotation, 0},
          RestNumber{AnimatedProperty::TextureOffset, 0},
          RestNumber{AnimatedProperty::Metallic, 0, glm::dvec4(0.0), TextureSlot::Normal},
          RestNumber{AnimatedProperty::CameraFovY, 5}}) {
        Scene scene = riggedScene();
        scene.rig.numbers.push_back(number);
        EXPECT_THROW(checkScene(scene), InputError) << infoOf(number.property).path;
    }
}

TEST(Poses, lightsThatAreLeftOutAreLeftAlone) {
    Scene scene = riggedScene();
    keepLights(scene, 0);
    dropCameras(scene);
    EXPECT_NO_THROW(poseScene(scene, 1.0));
    EXPECT_NO_THROW(checkScene(scene));
}

TEST(Pose, theLinksOfLightsThatStayOutlastThoseThatAreDeleted) {
    Rig rig;
    for (const int light : {0, 1, 3, 4}) rig.lights.push_back({light, 10 + light});
    rig.numbers.resize(3);
    rig.numbers[0].element = 4;
    rig.numbers[1].element = 1;
    rig.numbers[2].element = kNone; // removed before
    const std::vector<std::size_t> deleted{1, 2};
    const LightLinks links = linksAfterDeleting(rig, deleted);
    ASSERT_EQ(links.carried.size(), 3u);
    for (const auto& [carried, light, node] : {std::tuple(links.carried[0], 0, 10), std::tuple(links.carried[1], 1, 13),
                                               std::tuple(links.carried[2], 2, 14)}) {
        EXPECT_EQ(carried.element, light);
        EXPECT_EQ(carried.node, node);
    }
    EXPECT_EQ(links.numbers, (std::vector<int>{2, kNone, kNone}));
    // Deleting neighbours is the same as replacing them by none.
    EXPECT_EQ(linksAfterReplacing(rig, 1, 2, 0).numbers, links.numbers);
}

} // namespace
} // namespace tessera::scenes
