// The panel of the environment, with and without one.
#include "scenes/Load.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Panels.h"

namespace tessera::viewer {
namespace {

class EnvironmentPanel : public test::PanelTest {};

TEST_F(EnvironmentPanel, takesNoValueWhereThereIsNoEnvironment) {
    for (const bool isThere : {false, true}) {
        scenes::Scene scene = scenes::loadScene("room");
        scene.environment.reset();
        if (isThere) scene.environment.emplace().source = "builtin:studio";
        State state = test::stateOf(std::move(scene));
        const Look before = state.looks[0];
        pressSliders(320.0f, [&] { environmentPanel(state, {}); });
        for (const char* key : {"environmentRotation", "environmentIntensity"})
            EXPECT_NE(engine::settingOf(key).value.equal(state.looks[0], before), isThere) << key;
    }
}

TEST_F(EnvironmentPanel, tellsHowFarOneIsThatIsLoaded) {
    State state = test::stateOf(scenes::loadScene("room"));
    Facts facts;
    const auto says = [&](const std::string& words) {
        return textOf([&] { environmentPanel(state, facts); }).find(words) != std::string::npos;
    };
    EXPECT_TRUE(says("drop an .hdr or .exr file"));
    state.loadingEnvironment = "sky";
    facts.background = {"Computing sky", 0.449, true};
    EXPECT_TRUE(says("Computing sky: 45 %"));
    EXPECT_FALSE(says("drop an .hdr or .exr file"));
    facts.background = {"Loading sky", {}, true};
    EXPECT_TRUE(says("Loading sky ..."));
}

} // namespace
} // namespace tessera::viewer
