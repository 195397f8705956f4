#include "viewer/session/Playback.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/viewer/Scenes.h"

namespace tessera::viewer {
namespace {

State shownScene(scenes::Scene scene) {
    scene.cameras[0] = test::perspective({0, 0, 9}, {0, 0, 0});
    return test::stateOf(std::move(scene), {}, "rigged.gltf");
}

/// A window with a clip of one second.
State clipShown() {
    return shownScene(scenes::riggedScene());
}

double& timeOf(State& state) {
    return state.active().settings.timeSeconds;
}

TEST(Playback, aClipThatIsRepeatedBeginsAgainAtItsEnd) {
    State state = clipShown();
    passTime(state, 0.25);
    EXPECT_EQ(timeOf(state), 0.0) << "it does not play yet";
    togglePlaying(state);
    state.speed = 2.0f;
    passTime(state, 0.25);
    EXPECT_EQ(timeOf(state), 0.5);
    passTime(state, 0.375);
    EXPECT_EQ(timeOf(state), 0.25);
    EXPECT_TRUE(plays(state));
}

TEST(Playback, aClipThatIsNotRepeatedRestsAtItsEndAndPlaysAgainFromTheStart) {
    State state = clipShown();
    state.repeatsClip = false;
    togglePlaying(state);
    passTime(state, 0.75);
    EXPECT_TRUE(plays(state));
    passTime(state, 0.75);
    EXPECT_EQ(timeOf(state), 1.0);
    EXPECT_FALSE(plays(state));
    EXPECT_FALSE(state.isPlaying) << "the panel says so too";
    togglePlaying(state);
    EXPECT_EQ(timeOf(state), 0.0);
    EXPECT_TRUE(plays(state));
}

TEST(Playback, lightsThatMoveGoOnAfterTheEndOfAClipThatIsNotRepeated) {
    scenes::Scene scene = scenes::riggedScene();
    scene.lights.emplace_back().flicker.emplace();
    State state = shownScene(std::move(scene));
    state.repeatsClip = false;
    togglePlaying(state);
    passTime(state, 1.5);
    EXPECT_EQ(timeOf(state), 1.5);
    EXPECT_TRUE(plays(state));
}

TEST(Playback, aSceneInWhichNothingMovesStaysAtItsTime) {
    State state = clipShown();
    chooseClip(state, "none");
    EXPECT_FALSE(canMove(state));
    togglePlaying(state);
    EXPECT_FALSE(plays(state));
    passTime(state, 1.0);
    EXPECT_EQ(timeOf(state), 0.0);
    EXPECT_FALSE(canMove(State()));
}

TEST(Playback, anotherClipBeginsAtItsStart) {
    State state = clipShown();
    timeOf(state) = 0.75;
    chooseClip(state, "0");
    EXPECT_EQ(timeOf(state), 0.0);
}

TEST(Playback, aSavedSceneBeginsAtTheTimeThatIsShownWhereSomethingMoves) {
    State state = clipShown();
    scenes::SceneOptions options;
    options.requested["layout"] = "packed";
    const scenes::SceneOptions fromTheBeginning = options;
    options.requested["time"] = 0.75;
    state.open->exchangeOptions(options);
    options.requested["time"] = timeOf(state) = 0.25;
    EXPECT_EQ(optionsToSave(state), options);
    timeOf(state) = 0.0;
    EXPECT_EQ(optionsToSave(state), fromTheBeginning);
    state.open->playClip("none");
    timeOf(state) = 0.5;
    EXPECT_EQ(optionsToSave(state), state.open->scene().options) << "nothing moves";
}

} // namespace
} // namespace tessera::viewer
