#include <gtest/gtest.h>

#include "tests/unit/viewer/Scenes.h"
#include "viewer/session/Keys.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

/// A window with a scene of the lights a, b and c.
State threeLights() {
    scenes::Scene scene = scenes::loadScene("room");
    scene.lights.assign(3, scene.lights.at(0));
    for (std::size_t i = 0; i < 3; ++i) scene.lights[i].name = std::string(1, char('a' + i));
    return test::stateOf(std::move(scene));
}

const Lights& lightsOf(const State& state) {
    return state.open->scene().lights;
}

/// Returns the edit that undo would revert.
std::string lastEdit(const State& state) {
    return *state.open->history().undoText();
}

TEST(SceneEdits, theSelectedLightIsTheOneThatGoesAndTheNextIsSelectedThen) {
    State state = threeLights();
    state.selectedLight = 1;
    state.looks[0].settings.soloLight = 2;
    deleteSelectedLights(state);
    ASSERT_EQ(lightsOf(state).size(), 2u);
    EXPECT_EQ(lightsOf(state)[0].name, "a");
    EXPECT_EQ(lightsOf(state)[1].name, "c");
    EXPECT_EQ(state.looks[0].settings.soloLight, 1);
    EXPECT_EQ(state.selectedLight, 1) << "c";
    deleteSelectedLights(state);
    EXPECT_EQ(state.selectedLight, 0) << "the last";
    deleteSelectedLights(state);
    EXPECT_EQ(state.selectedLight, scenes::kNone);
    EXPECT_TRUE(lightsOf(state).empty());
    EXPECT_FALSE(state.looks[0].settings.soloLight);
    EXPECT_TRUE(state.open->isEdited());
}

TEST(SceneEdits, afterADeletedLightTheNextOfTheSortedListIsSelected) {
    State state = threeLights();
    scenes::Light light = lightsOf(state)[2];
    light.intensity = 100.0f * lightsOf(state)[0].intensity;
    state.selectedLight = 2;
    changeSelectedLights(state, light, 1.0, Gesture::Once);
    state.listing.order = LightOrder::Intensity; // c, a, b
    deleteSelectedLights(state);
    EXPECT_EQ(lightsOf(state)[std::size_t(state.selectedLight)].name, "a");
}

TEST(SceneEdits, severalLightsAreDeletedAndComeBackInOneStep) {
    State state = threeLights();
    const std::vector<scenes::Light> own = lightsOf(state);
    selectLight(state, 0, Choosing::Alone);
    selectLight(state, 2, Choosing::Toggle);
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{0, 2}));
    state.looks[0].settings.soloLight = 1;
    deleteSelectedLights(state);
    ASSERT_EQ(lightsOf(state).size(), 1u);
    EXPECT_EQ(lightsOf(state)[0].name, "b");
    EXPECT_EQ(state.looks[0].settings.soloLight, 0);
    EXPECT_EQ(state.selectedLight, 0);
    EXPECT_EQ(lastEdit(state), "delete 2 lights");
    undo(state);
    EXPECT_TRUE(lightsOf(state) == own);
    EXPECT_FALSE(state.open->isEdited());
}

TEST(SceneEdits, whatIsEditedOfTheSelectedLightBecomesThatOfAllInOneStep) {
    State state = threeLights();
    test::changeLight(state, 2, [](scenes::Light& light) {
        light.positionWS = {1.0, 2.0, 3.0};
        light.intensity = 7.0f;
        light.castsShadow = true;
    });
    const Lights before = lightsOf(state);
    selectLight(state, 0, Choosing::Alone);
    selectLight(state, 2, Choosing::Toggle);
    state.selectedLight = 0;
    scenes::Light changed = before[0];
    for (const float intensity : {3.0f, 5.0f}) { // one drag
        changed.intensity = intensity;
        changeSelectedLights(state, changed, 10.0, Gesture::GoesOn);
    }
    state.open->endGesture();
    const Lights& lights = lightsOf(state);
    EXPECT_EQ(lights[0].intensity, 5.0f);
    EXPECT_EQ(lights[2].intensity, 5.0f);
    EXPECT_TRUE(lights[2].castsShadow) << "that was not edited";
    EXPECT_EQ(lights[2].name, "c");
    EXPECT_TRUE(lights[1] == before[1]);
    EXPECT_EQ(lastEdit(state), "change intensity of 2 lights");
    undo(state);
    EXPECT_TRUE(lights == before);
    changed = before[0];
    changed.positionWS += glm::dvec3(0.0, 1.0, 0.0);
    changeSelectedLights(state, changed, 10.0);
    EXPECT_EQ(lights[2].positionWS, glm::dvec3(1.0, 3.0, 3.0)) << "they move alike";
    changed.type = scenes::LightType::Disk;
    changeSelectedLights(state, changed, 10.0);
    EXPECT_EQ(lights[2].type, scenes::LightType::Disk);
    EXPECT_GT(lights[2].radiusMetres, 0.0f) << "an area light has a size";
    undo(state);
    undo(state);
    EXPECT_TRUE(lights == before);
}

TEST(SceneEdits, aNarrowerConeOfASpotStaysOneForTheLightsBesides) {
    State state = threeLights();
    test::changeLight(state, 0, [](scenes::Light& light) {
        light.type = scenes::LightType::Spot;
        light.outerConeRadians = 0.8f;
        light.innerConeRadians = 0.6f;
    });
    test::changeLight(state, 2, [](scenes::Light& light) {
        light.outerConeRadians = 0.8f;
        light.innerConeRadians = 0.7f;
    });
    selectLight(state, 2, Choosing::Alone);
    selectLight(state, 0, Choosing::Toggle);
    scenes::Light changed = lightsOf(state)[0];
    changed.outerConeRadians = 0.65f;
    changeSelectedLights(state, changed, 10.0);
    const Lights& lights = lightsOf(state);
    EXPECT_EQ(lights[0].innerConeRadians, 0.6f);
    EXPECT_EQ(lights[2].outerConeRadians, 0.65f);
    EXPECT_EQ(lights[2].innerConeRadians, 0.65f);
}

TEST(SceneEdits, severalLightsAreDuplicatedInOneStepAndTheCopiesSelected) {
    State state = threeLights();
    selectLight(state, 1, Choosing::Alone);
    selectLight(state, 2, Choosing::Toggle);
    duplicateSelectedLights(state);
    const Lights& lights = lightsOf(state);
    ASSERT_EQ(lights.size(), 5u);
    EXPECT_EQ(lights[3].name, "b 2");
    EXPECT_EQ(lights[4].name, "c 2");
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{3, 4}));
    EXPECT_EQ(lastEdit(state), "duplicate 2 lights");
    undo(state);
    EXPECT_EQ(lights.size(), 3u);
}

TEST(SceneEdits, aLightIsRenamedUnlessTheNameIsEmptyAndNoTwoHaveOneName) {
    State state = threeLights();
    selectLight(state, 1, Choosing::Alone);
    const auto rename = [&](const std::string& name) {
        beginRenaming(state);
        ASSERT_TRUE(state.renamed.has_value());
        state.renamed->name = name;
        endRenaming(state);
    };
    rename("");
    EXPECT_FALSE(state.open->isEdited());
    rename("b");
    EXPECT_FALSE(state.open->isEdited());
    rename("lamp");
    EXPECT_EQ(lightsOf(state)[1].name, "lamp");
    EXPECT_EQ(lastEdit(state), "rename light 'b'");
    rename("a");
    EXPECT_EQ(lightsOf(state)[1].name, "a 2");
}

TEST(SceneEdits, aRangeGoesByTheOrderOfTheList) {
    State state = threeLights();
    const std::vector<int> list{1, 0, 2};
    selectLight(state, 1, Choosing::Alone, list);
    selectLight(state, 0, Choosing::Range, list);
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{0, 1}));
    selectLights(state, std::vector<int>{2}, true);
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{0, 1, 2}));
    selectLights(state, std::vector<int>{1, 2}, false);
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{1, 2}));
}

TEST(SceneEdits, whatIsKnownOfALightsTypeGoesWithIt) {
    State state = threeLights();
    const auto choose = [&](std::size_t index, scenes::LightType type) {
        scenes::Light light = lightsOf(state)[index];
        state.types.choose(index, light, type, 10.0);
        state.open->changeLight(index, light);
    };
    test::changeLight(state, 2, [](scenes::Light& light) { light.falloff = scenes::Falloff::Attenuation; });
    const scenes::Light before = lightsOf(state)[2];
    choose(2, scenes::LightType::Sphere);
    state.selectedLight = 0;
    deleteSelectedLights(state);
    choose(1, scenes::LightType::Point);
    EXPECT_TRUE(lightsOf(state)[1] == before);
    choose(1, scenes::LightType::Sphere);
    while (lightsOf(state).size() < 3) undo(state);
    choose(2, scenes::LightType::Point);
    EXPECT_TRUE(lightsOf(state)[2] == before);
}

TEST(SceneEdits, aChoiceGoesAloneBesidesOrAsARange) {
    State state = threeLights();
    selectLight(state, 2, Choosing::Alone);
    selectLight(state, 0, Choosing::Range);
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{0, 1, 2}));
    EXPECT_EQ(state.selectedLight, 0);
    selectLight(state, 0, Choosing::Toggle);
    EXPECT_EQ(state.allSelectedLights(), (std::set<int>{1, 2}));
    EXPECT_EQ(state.selectedLight, 2);
    selectLight(state, 1, Choosing::Alone);
    EXPECT_EQ(state.allSelectedLights(), std::set<int>{1}) << "the others are let go of first";
    selectLight(state, 1, Choosing::Alone);
    EXPECT_EQ(state.allSelectedLights(), std::set<int>());
    selectAllLights(state);
    EXPECT_EQ(state.allSelectedLights().size(), 3u);
    state.selectedLight = 1; // as a click on a marker does
    EXPECT_EQ(state.allSelectedLights().size(), 3u) << "it was one of them";
    addLight(state, 0.2);
    EXPECT_EQ(state.allSelectedLights(), std::set<int>{3});
}

TEST(SceneEdits, withoutASelectedLightNothingIsDeletedOrCountedAsAnEdit) {
    State state = threeLights();
    for (const int selected : {scenes::kNone, 3}) {
        state.selectedLight = selected;
        deleteSelectedLights(state);
    }
    EXPECT_EQ(lightsOf(state).size(), 3u);
    EXPECT_FALSE(state.open->isEdited());
    State none;
    none.selectedLight = 0;
    deleteSelectedLights(none);
    replaceByScattered(none);
}

TEST(SceneEdits, scatteredLightsTakeTheScenesPlaceAndLieElsewhereTheNextTime) {
    State state = threeLights();
    state.selectedLight = 2;
    state.looks[0].settings.soloLight = 2;
    state.scatter.count = 20;
    replaceByScattered(state);
    const std::vector<scenes::Light> first = lightsOf(state);
    EXPECT_EQ(first.size(), 20u);
    EXPECT_EQ(state.selectedLight, scenes::kNone);
    EXPECT_FALSE(state.looks[0].settings.soloLight);
    EXPECT_TRUE(state.open->isEdited());
    replaceByScattered(state);
    EXPECT_EQ(lightsOf(state).size(), 20u);
    EXPECT_FALSE(lightsOf(state) == first);
}

TEST(SceneEdits, undoingAScatteringBringsTheLightsBackAndRedoingTakesThemAway) {
    State state = threeLights();
    const std::vector<scenes::Light> own = lightsOf(state);
    state.scatter.count = 5;
    undo(state);
    redo(state);
    EXPECT_EQ(state.open->edits(), 0u) << "there is nothing to undo";
    replaceByScattered(state);
    const std::vector<scenes::Light> scattered = lightsOf(state);
    EXPECT_EQ(lastEdit(state), "scatter 5 lights");
    state.selectedLight = 4;
    state.looks[0].settings.soloLight = 4;
    undo(state);
    EXPECT_TRUE(lightsOf(state) == own);
    EXPECT_EQ(state.selectedLight, scenes::kNone);
    EXPECT_FALSE(state.looks[0].settings.soloLight);
    redo(state);
    EXPECT_TRUE(lightsOf(state) == scattered);
}

TEST(SceneEdits, aDeletedLightComesBackInItsPlaceSelectedAndSoloGoesWithItsLight) {
    State state = threeLights();
    const std::vector<scenes::Light> own = lightsOf(state);
    state.selectedLight = 1;
    state.looks[0].settings.soloLight = 2;
    deleteSelectedLights(state);
    EXPECT_EQ(lastEdit(state), "delete light 'b'");
    undo(state);
    EXPECT_TRUE(lightsOf(state) == own);
    EXPECT_FALSE(state.open->isEdited());
    EXPECT_EQ(state.selectedLight, 1);
    EXPECT_EQ(state.looks[0].settings.soloLight, 2);
    redo(state);
    EXPECT_EQ(lightsOf(state).size(), 2u);
    EXPECT_EQ(state.looks[0].settings.soloLight, 1);
}

TEST(SceneEdits, nothingIsUndoneWhileSomethingIsDragged) {
    State state = threeLights();
    scenes::Light moved = lightsOf(state)[0];
    moved.positionWS.x += 1.0;
    state.open->changeLight(0, moved, Gesture::GoesOn);
    undo(state);
    EXPECT_TRUE(lightsOf(state)[0] == moved) << "a widget is held";
    state.open->endGesture();
    state.isDragging = true;
    undo(state);
    EXPECT_TRUE(lightsOf(state)[0] == moved);
    state.isDragging = false;
    undo(state);
    EXPECT_FALSE(state.open->isEdited());
}

TEST(SceneEdits, addingAndDuplicatingAreUndoneAndNamed) {
    State state = threeLights();
    addLight(state, 0.2);
    EXPECT_EQ(state.selectedLight, 3);
    EXPECT_EQ(lastEdit(state), "add light 'light'");
    state.selectedLight = 0;
    duplicateSelectedLights(state);
    EXPECT_EQ(state.selectedLight, 4);
    EXPECT_EQ(lastEdit(state), "duplicate light 'a 2'");
    undo(state);
    EXPECT_EQ(state.selectedLight, scenes::kNone) << "it was the one that went";
    undo(state);
    EXPECT_EQ(lightsOf(state).size(), 3u);
    EXPECT_FALSE(state.open->isEdited());
}

TEST(SceneEdits, revertGoesBackOrForthToTheSavedSceneAndElseRequestsTheFile) {
    State state = threeLights();
    const auto change = [&state](float intensity) { test::setIntensity(*state.open, intensity); };
    change(0.25f);
    state.open->becomes("/saved.json");
    change(0.5f);
    change(0.75f);
    revert(state);
    EXPECT_EQ(lightsOf(state)[0].intensity, 0.25f);
    EXPECT_FALSE(state.open->isEdited());
    undo(state);
    EXPECT_TRUE(state.open->isEdited());
    revert(state);
    EXPECT_EQ(lightsOf(state)[0].intensity, 0.25f);
    EXPECT_FALSE(state.requests.open);
    redo(state);
    redo(state);
    EXPECT_EQ(lightsOf(state)[0].intensity, 0.75f) << "what was reverted can be redone";
    for (int i = 0; i < 3; ++i) undo(state);
    change(0.875f); // replaces the saved edit
    revert(state);
    EXPECT_EQ(state.requests.open, "/saved.json");
}

TEST(SceneEdits, undoingAJumpPutsTheCameraBackAndKeepsWhatCanBeRedone) {
    State state = threeLights();
    OpenScene& open = *state.open;
    const scenes::Camera first = open.scene().cameras.at(0);
    state.selectedLight = 0;
    deleteSelectedLights(state);
    undo(state);
    open.jumpHome();
    EXPECT_EQ(open.history().undoable(), 0u) << "it is there already";
    open.jumpToAll(1.5);
    test::settle(open);
    const scenes::Camera all = open.scene().cameras[0];
    EXPECT_NE(all, first);
    EXPECT_FALSE(open.isEdited()) << "a movement is no edit of the scene";
    EXPECT_EQ(open.history().redoable(), 1u);
    open.rig().setMode(CameraRig::Mode::Fly);
    open.rig().wheel(2.0, {}, 400.0);
    const double speed = open.rig().flyMetresPerSecond();
    undo(state);
    EXPECT_EQ(open.scene().cameras[0], first);
    EXPECT_EQ(open.rig().mode(), CameraRig::Mode::Fly) << "how one moves is no matter of where one is";
    EXPECT_EQ(open.rig().flyMetresPerSecond(), speed);
    redo(state);
    EXPECT_EQ(open.scene().cameras[0], all);
    redo(state);
    EXPECT_EQ(open.scene().lights.size(), 2u);
}

} // namespace
} // namespace tessera::viewer
