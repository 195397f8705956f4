// An environment that was turned and brightened in the window, after the scene was saved.
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "scenes/Load.h"
#include "tests/support/TempFolder.h"
#include "viewer/save/Recovery.h"
#include "viewer/save/SaveScene.h"

namespace tessera::viewer {
namespace {

/// Sums and products of these are exact in single precision.
constexpr scenes::EnvironmentView kChosenView{45.0f, 2.0f};

/// Of a scene whose file is more than edits, so that what is saved names it as its base.
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
        for (Look& look : state_.looks) engine::takeWishes(scene, file, look);
        state_.open = std::make_unique<OpenScene>(file, load, std::move(scene), std::move(origin));
    }
    /// As the user does.
    void view(const scenes::EnvironmentView& chosen) {
        for (Look& look : state_.looks) {
            look.settings.environment.rotationDegrees = chosen.rotationDegrees;
            look.settings.environment.intensity = chosen.intensity;
        }
    }
    scenes::EnvironmentView seen() const {
        return scenes::asSeen(state_.open->scene().environment.value(), environmentSeenBy(state_.looks[1]));
    }
    /// What another start of the program shows of a file.
    static scenes::EnvironmentView seenOf(const std::string& file) {
        const scenes::Scene scene = scenes::loadScene(file);
        Look look;
        engine::takeWishes(scene, file, look);
        return scenes::asSeen(scene.environment.value(), environmentSeenBy(look));
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
    EXPECT_EQ(seen(), (scenes::EnvironmentView{35.0f, 1.5f})) << "as the file asks for";
    view(kChosenView);
    const scenes::EnvironmentView before = seen();
    EXPECT_EQ(before, (scenes::EnvironmentView{55.0f, 1.0f}));
    const std::string file = saved();
    EXPECT_EQ(seenOf(file), before) << "opened again";
    EXPECT_EQ(seen(), before) << "in the window, where it was not turned again";
    for (const Look& look : state_.looks) EXPECT_EQ(environmentSeenBy(look), scenes::EnvironmentView());
    EXPECT_EQ(scenes::loadScene(file).options, state_.open->scene().options);
    EXPECT_FALSE(state_.open->isEdited());
    // And once more.
    view(kChosenView);
    EXPECT_EQ(seen(), (scenes::EnvironmentView{100.0f, 2.0f}));
    saved();
    EXPECT_EQ(seenOf(file), (scenes::EnvironmentView{100.0f, 2.0f}));
}

TEST_F(SavedEnvironment, whatUndoingBringsBackLiesAndShinesAsItDidToo) {
    view(kChosenView);
    const scenes::EnvironmentView before = seen();
    ChosenEnvironment other;
    other.name = "sky";
    other.environment = state_.open->scene().environment;
    other.environment->source = "builtin:sky";
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
        chosen.environment->rotationDegrees = 0.0f; // as maps are loaded
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
    state_.open->takeEnvironment({});
    view(kChosenView);
    const std::string file = saved();
    const scenes::Scene scene = scenes::loadScene(file);
    EXPECT_FALSE(scene.environment);
    Look look;
    engine::takeWishes(scene, file, look);
    EXPECT_EQ(environmentSeenBy(look), (scenes::EnvironmentView{25.0f, 3.0f})) << "as the file asks for";
    EXPECT_EQ(environmentSeenBy(state_.looks[0]), kChosenView);
}

TEST_F(SavedEnvironment, editsThatAreKeptForTheNextStartHaveItAsItWasSeen) {
    Recovery recovery(folder_.path() / "recovery");
    scenes::Light light;
    light.name = "lamp";
    state_.open->replaceLights("add light 'lamp'", 0, 0, {light});
    view(kChosenView);
    recovery.keep(*state_.open, environmentSeenBy(state_.looks[0]));
    EXPECT_FALSE(recovery.isBehind(*state_.open, kChosenView));
    EXPECT_TRUE(recovery.isBehind(*state_.open, {})) << "it was turned since";
    const auto kept = folder_.path() / "recovery" / std::to_string(getpid()) / "tessera-turned.json";
    EXPECT_EQ(seenOf(kept.string()), seen());
}

} // namespace
} // namespace tessera::viewer
