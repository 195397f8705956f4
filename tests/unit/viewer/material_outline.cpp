// Conditions of the selected material's outline.
#include <utility>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/show/MaterialOutline.h"

namespace tessera::viewer {
namespace {

using frame::DebugView;

State showingMaterialOf(scenes::Scene scene) {
    State state = test::stateOf(std::move(scene));
    state.selectedMaterial = 0;
    state.showsMaterial = true;
    return state;
}

TEST(MaterialOutline, isOfWhatAPanelShowsInViewsThatShowSurfaces) {
    State state = showingMaterialOf(scenes::loadScene("room"));
    const auto isFor = [&](DebugView view) { return MaterialOutline::sightOf(state, test::lookAt(view)).has_value(); };
    for (const DebugView view : {DebugView::Final, DebugView::Normal, DebugView::Lights, DebugView::Shadow})
        EXPECT_TRUE(isFor(view)) << frame::debugViewInfo(view).name;
    EXPECT_FALSE(isFor(DebugView::ShadowAtlas));
    EXPECT_FALSE(isFor(DebugView::MovedTooFar)) << "a frame without its marks may be refused";
    state.showsMaterial = false;
    EXPECT_FALSE(isFor(DebugView::Final));
    state.showsMaterial = true;
    state.selectedMaterial = int(state.open->scene().materials.size());
    EXPECT_FALSE(isFor(DebugView::Final));
}

TEST(MaterialOutline, isToBeFoundAnewWhereTheCameraOrAHookMayHaveMovedSomething) {
    scenes::Scene scene = scenes::loadScene("room");
    const auto sightOf = [](const State& state, double timeSeconds = 0.0) {
        Look look;
        look.settings.timeSeconds = timeSeconds;
        return MaterialOutline::sightOf(state, look);
    };
    const State still = showingMaterialOf(scene);
    EXPECT_TRUE(sightOf(still, 1.0) == sightOf(still)) << "nothing moves";
    scene.hook.emplace().parameters = {{"wind", 0.5f, 0.0f, 2.0f}};
    State hooked = showingMaterialOf(scene);
    const auto before = sightOf(hooked);
    EXPECT_FALSE(sightOf(hooked, 1.0) == before);
    hooked.open->changeHookParameter(0, 0.75f);
    EXPECT_FALSE(sightOf(hooked) == before);
    hooked.open->undo();
    EXPECT_TRUE(sightOf(hooked) == before);
    hooked.open->rig().zoom(0.5, glm::dvec2(0.0), 100.0);
    hooked.open->rig().advance(1.0, 100.0);
    hooked.open->applyRig();
    EXPECT_FALSE(sightOf(hooked) == before);
}

} // namespace
} // namespace tessera::viewer
