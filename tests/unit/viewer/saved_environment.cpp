// An environment rotated and brightened in the window: undo, revert and save.
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "scenes/Load.h"
#include "tests/support/TempFolder.h"
#include "viewer/save/Recovery.h"
#include "viewer/save/SaveScene.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

/// Sums and products of these are exact in single precision.
constexpr scenes::EnvironmentView kChosenView{45.0f, 2.0f};

/// The scene's file holds more than edits, so a saved file names it as its base.
class SavedEnvironment : public testing::Test {
protected:
    SavedEnvironment() {
        const std::string file = folder_
                                     .write("turned.json", R"({"tessera": 1, "include": [{"file": "builtin:room"}],
                    "environment": {"map": "builtin:studio", "rotationDegrees": 10, "intensity": 0.5},
                    "options": {"environmentRotation": 25, "environmentIntensity": 3}})")
                                     .string();
        const scenes::LoadOptions load;
        scenes::Scene scene = scenes::loadScene(file, load);
        scenes::SceneOrigin origin = scenes::originOf(file, load, scene);
        for (Look& look : state_.looks) engine::applyRequestedOptions(scene, file, look);
        state_.open = std::make_unique<OpenScene>(file, load, std::move(scene), std::move(origin), nullptr,
                                                  environmentSeenBy(state_.looks[0]));
    }
    /// Edits the view of the environment as the user does.
    void view(const scenes::EnvironmentView& chosen) { viewEnvironment(state_, chosen); }
    scenes::EnvironmentView seen() const {
        return scenes::asSeen(scenes::ownViewOf(state_.open->scene().environment.value()),
                              environmentSeenBy(state_.looks[1]));
    }
    /// Returns the view of a file after a restart of the program.
    static scenes::EnvironmentView seenOf(const std::string& file) {
        const scenes::Scene scene = scenes::loadScene(file);
        Look look;
        engine::applyRequestedOptions(scene, file, look);
        return scenes::asSeen(scenes::ownViewOf(scene.environment.value()), environmentSeenBy(look));
    }
    /// A choice of another map, with the numbers of the scene's environment.
    ChosenEnvironment sky() const {
        ChosenEnvironment other;
        other.environment = state_.open->scene().environment;
        other.environment->source = "builtin:sky";
        return other;
    }
    std::string saved() {
        const std::string file = (folder_.path() / "saved.json").string();
        saveOpenScene(state_, file);
        return file;
    }

    tessera::test::TempFolder folder_;
    State state_;
};

TEST_F(SavedEnvironment, liesAndShinesAsItWasSeen) {
    EXPECT_EQ(seen(), (scenes::EnvironmentView{35.0f, 1.5f})) << "as the file requests";
    view(kChosenView);
    const scenes::EnvironmentView before = seen();
    EXPECT_EQ(before, (scenes::EnvironmentView{55.0f, 1.0f}));
    const std::string file = saved();
    EXPECT_EQ(seenOf(file), before) << "opened again";
    EXPECT_EQ(seen(), before) << "in the window, where it was not turned again";
    for (const Look& look : state_.looks) EXPECT_EQ(environmentSeenBy(look), scenes::EnvironmentView());
    EXPECT_EQ(scenes::loadScene(file).options, state_.open->scene().options);
    EXPECT_FALSE(state_.open->isEdited());
    // A second time.
    view(kChosenView);
    EXPECT_EQ(seen(), (scenes::EnvironmentView{100.0f, 2.0f}));
    saved();
    EXPECT_EQ(seenOf(file), (scenes::EnvironmentView{100.0f, 2.0f}));
}

TEST_F(SavedEnvironment, oneDragIsOneStepThatIsUndoneToTheExactNumbers) {
    constexpr scenes::EnvironmentView kFirst{25.0f, 3.0f};
    EXPECT_EQ(state_.open->environmentView(), kFirst) << "as the file requests";
    EXPECT_FALSE(state_.open->isEdited());
    view(kFirst);
    EXPECT_EQ(state_.open->history().undoable(), 0u) << "it has these numbers";
    for (const float degrees : {25.1f, 25.2f, 25.3f}) viewEnvironment(state_, {degrees, 3.0f}, Gesture::GoesOn);
    undo(state_);
    EXPECT_EQ(state_.open->environmentView().rotationDegrees, 25.3f) << "the drag goes on";
    state_.open->endGesture();
    EXPECT_EQ(*state_.open->history().undoText(), "turn the environment");
    for (const float intensity : {2.1f, 0.0f}) viewEnvironment(state_, {25.3f, intensity}, Gesture::GoesOn);
    state_.open->endGesture();
    EXPECT_EQ(*state_.open->history().undoText(), "change intensity of the environment");
    EXPECT_EQ(state_.open->history().undoable(), 2u);
    EXPECT_TRUE(state_.open->isEdited());
    // The backdrop's visibility is no edit, and no part of one.
    for (Look& look : state_.looks) look.settings.environment.backdrop = frame::Backdrop::Off;
    const auto expectSeenBy = [this](const scenes::EnvironmentView& expected) {
        EXPECT_EQ(state_.open->environmentView(), expected);
        for (const Look& look : state_.looks) {
            EXPECT_EQ(environmentSeenBy(look), expected);
            EXPECT_EQ(look.settings.environment.backdrop, frame::Backdrop::Off);
        }
    };
    undo(state_);
    expectSeenBy({25.3f, 3.0f});
    undo(state_);
    expectSeenBy(kFirst);
    EXPECT_FALSE(state_.open->isEdited());
    EXPECT_EQ(state_.open->environmentRevision(), 0u) << "its map is as it was, and is not filtered again";
    redo(state_);
    redo(state_);
    expectSeenBy({25.3f, 0.0f});
    revert(state_);
    expectSeenBy(kFirst);
    EXPECT_FALSE(state_.open->isEdited());
    EXPECT_FALSE(state_.requests.open) << "steps lead there";
}

TEST_F(SavedEnvironment, turnsFromBeforeASaveAreUndoneAndRedoneAlsoWhereItWasSavedDark) {
    const scenes::EnvironmentView first = seen();
    view(kChosenView);
    const scenes::EnvironmentView turned = seen();
    state_.open->takeEnvironment(sky());
    view({90.0f, 0.0f});
    const scenes::EnvironmentView dark = seen();
    EXPECT_EQ(dark, (scenes::EnvironmentView{100.0f, 0.0f}));
    const std::string file = saved();
    EXPECT_EQ(seenOf(file), dark);
    EXPECT_EQ(seen(), dark);
    const std::uint64_t revision = state_.open->environmentRevision();
    undo(state_);
    EXPECT_EQ(seen(), turned) << "the other map, which lies as the scene's own";
    EXPECT_GT(state_.open->environmentRevision(), revision) << "its own numbers are others";
    EXPECT_TRUE(state_.open->isEdited());
    undo(state_);
    EXPECT_EQ(state_.open->scene().environment.value().source, "builtin:studio");
    EXPECT_EQ(seen(), turned);
    undo(state_);
    EXPECT_EQ(seen(), first);
    revert(state_);
    EXPECT_EQ(seen(), dark);
    EXPECT_FALSE(state_.open->isEdited());
    EXPECT_EQ(seenOf(saved()), dark) << "and counts once";
}

TEST_F(SavedEnvironment, whatUndoingBringsBackLiesAndShinesAsItDidToo) {
    view(kChosenView);
    const scenes::EnvironmentView before = seen();
    ChosenEnvironment other = sky();
    other.name = "sky";
    other.environment->intensity = 0.25f;
    state_.open->takeEnvironment(std::move(other));
    const scenes::EnvironmentView ofOther = seen();
    EXPECT_EQ(ofOther, (scenes::EnvironmentView{55.0f, 0.5f})) << "as the scene's own lies";
    saved();
    EXPECT_EQ(seen(), ofOther);
    state_.open->undo();
    EXPECT_EQ(seen(), before);
    state_.open->redo();
    EXPECT_EQ(seen(), ofOther);
    EXPECT_FALSE(state_.open->isEdited());
}

TEST_F(SavedEnvironment, theScenesOwnMapChosenAgainLiesAndShinesAsItDidAlsoOnceItIsSaved) {
    const auto choose = [this](const std::string& source) {
        ChosenEnvironment chosen;
        chosen.environment = scenes::loadScene("glass").environment;
        chosen.environment->source = source;
        chosen.environment->rotationDegrees = 0.0f; // like loaded maps
        state_.open->takeEnvironment(std::move(chosen));
    };
    view(kChosenView);
    const scenes::EnvironmentView before = seen();
    choose("builtin:sky");
    EXPECT_EQ(seen(), (scenes::EnvironmentView{55.0f, 2.0f})) << "the map's own intensity";
    state_.open->takeEnvironment({});
    choose("builtin:studio");
    EXPECT_EQ(seen(), before);
    saved();
    choose("builtin:sky");
    choose("builtin:studio");
    EXPECT_EQ(seen(), before);
    state_.open->undo();
    EXPECT_EQ(seen(), (scenes::EnvironmentView{55.0f, 1.0f}));
}

TEST_F(SavedEnvironment, withoutOneWhatTheLooksSayStaysTheirs) {
    view(kChosenView);
    state_.open->takeEnvironment({});
    view({0.0f, 5.0f}); // without an environment
    const std::string file = saved();
    const scenes::Scene scene = scenes::loadScene(file);
    EXPECT_FALSE(scene.environment);
    Look look;
    engine::applyRequestedOptions(scene, file, look);
    EXPECT_EQ(environmentSeenBy(look), (scenes::EnvironmentView{25.0f, 3.0f})) << "as the file requests";
    EXPECT_EQ(environmentSeenBy(state_.looks[0]), kChosenView);
}

TEST_F(SavedEnvironment, editsThatAreKeptForTheNextStartHaveItAsItWasSeen) {
    Recovery recovery(folder_.path() / "recovery");
    scenes::Light light;
    light.name = "lamp";
    state_.open->replaceLights("add light 'lamp'", 0, 0, {light});
    view(kChosenView);
    recovery.keep(*state_.open);
    EXPECT_FALSE(recovery.isBehind(*state_.open));
    const auto kept = folder_.path() / "recovery" / std::to_string(getpid()) / "tessera-turned.json";
    EXPECT_EQ(seenOf(kept.string()), seen());
    view({90.0f, 2.0f});
    EXPECT_TRUE(recovery.isBehind(*state_.open)) << "it was turned since";
}

} // namespace
} // namespace tessera::viewer
