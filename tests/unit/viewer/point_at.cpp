#include "viewer/session/PointAt.h"

#include "tests/support/TestScenes.h"
#include "tests/unit/viewer/Scenes.h"

namespace tessera::viewer {
namespace {

using namespace test;

/// Two cards of 2 m that face +Z, each with its own material, at x = -4 and x = 4. The camera is 10 m before them.
class PointAt : public testing::Test {
protected:
    PointAt() {
        scenes::Scene scene;
        scene.materials.resize(3);
        scene.meshes = {tessera::test::quad()};
        for (const int side : {0, 1}) {
            scenes::Node& node = scene.nodes.emplace_back();
            node.parentFromNode[3] = glm::dvec4(side == 0 ? -4.0 : 4.0, 0.0, 0.0, 1.0);
            node.instances = {{0, side}};
        }
        scene.materials[0].name = "left";
        scene.materials[1].name = "right";
        scene.lights.resize(2);
        scene.lights[0].positionWS = {0.0, 3.0, 0.0};
        scene.lights[1].type = scenes::LightType::Directional;
        scene.cameras = {perspective({0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 60.0)};
        state_ = stateOf(std::move(scene));
    }
    /// The point at the image's centre at the pivot's depth, once the camera is static.
    glm::dvec3 pivotWS() {
        state_.open->rig().advance(kLongSeconds, kHeightPixels);
        const CameraPose& pose = state_.open->rig().pose();
        return pose.eyeWS + pose.focusMetres * pose.heading.forwardWS();
    }
    void expectPivot(const glm::dvec3& placeWS) { EXPECT_LT(glm::distance(pivotWS(), placeWS), 1e-6); }
    /// Expects the latest selection to be framed, with its centre at this place.
    void expectFramed(const glm::dvec3& placeWS) {
        state_.noteSelection();
        frameSelection(state_);
        expectPivot(placeWS);
    }
    /// A place in the image on the card of a side.
    static glm::vec2 placeOf(int side) { return {side == 0 ? 0.16f : 0.84f, 0.5f}; }

    State state_;
};

constexpr glm::ivec2 kPointedPixels{400, 400};

TEST_F(PointAt, aPlaceSelectsTheMaterialThatItShows) {
    EXPECT_EQ(selectMaterialAt(state_, placeOf(1), kPointedPixels), "right");
    EXPECT_EQ(state_.selectedMaterial, 1);
    EXPECT_EQ(selectMaterialAt(state_, {0.5f, 0.1f}, kPointedPixels), "nothing");
    EXPECT_EQ(state_.selectedMaterial, scenes::kNone);
}

TEST_F(PointAt, theSurfaceAtAPlaceComesIntoTheMiddleAtItsDepth) {
    EXPECT_FALSE(turnAboutPlace(state_, {0.5f, 0.1f}, kPointedPixels));
    expectPivot({0, 0, 0});
    EXPECT_TRUE(turnAboutPlace(state_, placeOf(0), kPointedPixels));
    const glm::dvec3 pivot = pivotWS();
    EXPECT_NEAR(pivot.x, -4.0, 0.3);
    EXPECT_NEAR(pivot.z, 0.0, 1e-6);
    EXPECT_NEAR(state_.open->rig().pose().eyeWS.z, 10.0, 1e-6) << "it came nearer";
    ASSERT_NE(state_.open->undo(), nullptr);
    expectPivot({0, 0, 0});
}

TEST_F(PointAt, theSelectionIsBroughtIntoViewTheLatestFirst) {
    frameSelection(state_);
    expectPivot({0, 0, 0});
    state_.selectedMaterial = 1;
    expectFramed({4, 0, 0});
    EXPECT_LT(state_.open->rig().pose().focusMetres, 5.0) << "the card does not fill the picture";
    state_.selectedLight = 0;
    expectFramed({0, 3, 0});
    state_.selectedMaterial = 0;
    expectFramed({-4, 0, 0});
}

TEST_F(PointAt, whatHasNoPlaceLeavesAllInView) {
    state_.selectedLight = 1; // directional
    expectFramed({0, 0, 0});
    state_.selectedLight = scenes::kNone;
    state_.selectedMaterial = 2; // used by nothing
    expectFramed({0, 0, 0});
    state_.selectedLight = state_.selectedMaterial = 7; // deleted
    expectFramed({0, 0, 0});
}

} // namespace
} // namespace tessera::viewer
