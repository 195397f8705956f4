#include <gtest/gtest.h>

#include "viewer/session/Keys.h"
#include "viewer/session/LightEdits.h"

namespace tessera::viewer {
namespace {

/// A window that shows a scene's lights a, b and c.
State threeLights() {
    scenes::LoadOptions load;
    scenes::Scene scene = scenes::loadScene("room", load);
    scene.lights.assign(3, scene.lights.at(0));
    for (std::size_t i = 0; i < 3; ++i) scene.lights[i].name = std::string(1, char('a' + i));
    State state;
    state.open = std::make_unique<OpenScene>("room", load, std::move(scene), scenes::SceneOrigin());
    return state;
}

TEST(LightEdits, theSelectedLightIsTheOneThatGoesAndNoneIsSelectedThen) {
    State state = threeLights();
    state.selectedLight = 1;
    state.looks[0].settings.soloLight = 2;
    deleteSelectedLight(state);
    const std::vector<scenes::Light>& lights = state.open->scene().lights;
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].name, "a");
    EXPECT_EQ(lights[1].name, "c");
    EXPECT_EQ(state.looks[0].settings.soloLight, 1);
    EXPECT_EQ(state.selectedLight, scenes::kNone);
    EXPECT_TRUE(state.open->isEdited());
}

TEST(LightEdits, withoutASelectedLightNothingIsDeletedOrCountedAsAnEdit) {
    State state = threeLights();
    for (const int selected : {scenes::kNone, 3}) {
        state.selectedLight = selected;
        deleteSelectedLight(state);
    }
    EXPECT_EQ(state.open->scene().lights.size(), 3u);
    EXPECT_FALSE(state.open->isEdited());
    State none;
    none.selectedLight = 0;
    deleteSelectedLight(none);
    replaceByScattered(none);
}

TEST(LightEdits, scatteredLightsTakeTheScenesPlaceAndLieElsewhereTheNextTime) {
    State state = threeLights();
    state.selectedLight = 2;
    state.looks[0].settings.soloLight = 2;
    state.scatter.count = 20;
    replaceByScattered(state);
    const std::vector<scenes::Light> first = state.open->scene().lights;
    EXPECT_EQ(first.size(), 20u);
    EXPECT_EQ(state.selectedLight, scenes::kNone);
    EXPECT_FALSE(state.looks[0].settings.soloLight);
    EXPECT_TRUE(state.open->isEdited());
    replaceByScattered(state);
    EXPECT_EQ(state.open->scene().lights.size(), 20u);
    EXPECT_FALSE(state.open->scene().lights == first);
}

TEST(LightEdits, theLightsThatScatteredOnesReplacedComeBack) {
    State state = threeLights();
    const std::vector<scenes::Light> own = state.open->scene().lights;
    state.scatter.count = 5;
    bringBackReplaced(state);
    EXPECT_FALSE(state.open->isEdited()) << "nothing was replaced";
    replaceByScattered(state);
    replaceByScattered(state);
    state.selectedLight = 4;
    state.looks[0].settings.soloLight = 4;
    bringBackReplaced(state);
    EXPECT_TRUE(state.open->scene().lights == own);
    EXPECT_EQ(state.selectedLight, scenes::kNone);
    EXPECT_FALSE(state.looks[0].settings.soloLight);
    // Scattered lights that were edited are worth bringing back too.
    replaceByScattered(state);
    state.open->edit().lights[0].name = "mine";
    state.open->touch();
    replaceByScattered(state);
    bringBackReplaced(state);
    EXPECT_EQ(state.open->scene().lights.at(0).name, "mine");
}

} // namespace
} // namespace tessera::viewer
