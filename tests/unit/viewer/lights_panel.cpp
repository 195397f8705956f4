// The rows of a light, by its type.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/edit/LightLife.h"
#include "viewer/panels/Panels.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

class LightRows : public test::PanelTest {
protected:
    std::string textOfPanel(State& state) {
        return textOf([&] { lightsPanel(state); });
    }
    /// Returns the panel's text for a scene with one light, which is selected.
    std::string textOfLight(scenes::LightType type) {
        State state = test::roomWithLight(type);
        return textOfPanel(state);
    }
};

using testing::HasSubstr;
using testing::Not;

TEST_F(LightRows, areThoseOfItsTypeAndNoOther) {
    const auto isIn = [](const std::string& text, const std::string& label) {
        return text.find("\n" + label + " ") != std::string::npos ||
               text.find("\n" + label + "\n") != std::string::npos;
    };
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        const std::string text = textOfLight(type.type);
        const auto hasRow = [&](const scenes::LightParameter& parameter) { return isIn(text, parameter.label); };
        for (const scenes::LightTypeInfo& other : scenes::lightTypes()) {
            for (const scenes::LightParameter& parameter : other.parameters)
                EXPECT_EQ(hasRow(parameter), other.type == type.type) << type.name << parameter.label << " in" << text;
            if (const scenes::LightParameter* size = scenes::sizeParameter(other)) {
                EXPECT_EQ(hasRow(*size), size == scenes::sizeParameter(type)) << type.name << " in" << text;
            }
        }
        EXPECT_EQ(isIn(text, "Shines"), type.isFlat) << text;
        EXPECT_EQ(isIn(text, "Surface"), type.isArea) << text;
        EXPECT_EQ(isIn(text, "Width along"), type.hasSides()) << text;
        EXPECT_EQ(isIn(text, "Corners along"), type.hasCorners()) << text;
        EXPECT_EQ(isIn(text, "Corner 3"), type.hasCorners()) << text;
        EXPECT_EQ(isIn(text, "Range"), type.hasPosition()) << text;
        EXPECT_NE(text.find(fmt::format(" {} }}\n", type.unit)), std::string::npos) << type.unit << " in" << text;
    }
}

TEST_F(LightRows, showNoMinusBeforeZeroAndChangeNothingByThat) {
    State state = test::roomWithLight();
    test::changeLight(state, 0, [](scenes::Light& light) { light.positionWS = {-1e-9, -0.0, -2.0}; });
    EXPECT_THAT(textOfPanel(state), testing::AllOf(Not(HasSubstr("-0.000")), HasSubstr("-2.000")));
    EXPECT_EQ(state.open->scene().lights[0].positionWS.x, -1e-9);
}

TEST_F(LightRows, ofWhatShinesStandTogetherBeforeAllElse) {
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        const std::string text = textOfLight(type.type);
        const auto at = [&](const std::string& label) {
            return std::min(text.find("\n" + label + " "), text.find("\n" + label + "\n"));
        };
        std::vector<std::string> shape;
        for (const scenes::LightParameter& parameter : type.parameters) shape.emplace_back(parameter.label);
        if (type.hasCorners()) shape.insert(shape.end(), {"Corner 0", "Corner 3", "Corners"});
        const scenes::LightParameter* const size = scenes::sizeParameter(type);
        if (size != nullptr && type.isArea) shape.emplace_back(size->label);
        for (const std::string& label : shape) {
            EXPECT_LT(at(label), at(type.isArea ? "Surface" : "Shadow")) << type.name << " " << label << text;
            if (type.hasPosition()) {
                EXPECT_LT(at(label), at("Position")) << type.name << " " << label << text;
            }
        }
        if (size != nullptr && !type.isArea) {
            EXPECT_GT(at(size->label), at("Shadow")) << "it softens shadows: " << text;
        }
    }
}

TEST_F(LightRows, areNotWiderThanThePanel) {
    const auto contentWidth = [&](scenes::LightType type) {
        State state = test::roomWithLight(type);
        show([&] { lightsPanel(state); });
        return ImGui::FindWindowByName("panel")->ContentSize.x;
    };
    // The rows of a rectangle light fill the panel's width.
    const float panelWidth = contentWidth(scenes::LightType::Rectangle);
    for (const scenes::LightTypeInfo& type : scenes::lightTypes())
        EXPECT_LE(contentWidth(type.type), panelWidth) << type.name;
}

TEST_F(LightRows, sayWhichWayALightGoesAndWhichKeysItHas) {
    State state = test::roomWithLight();
    state.looks[0].settings.timeSeconds = 1.5;
    const auto expectRows = [&](const char* what, const std::vector<const char*>& some,
                                const std::vector<const char*>& others) {
        const scenes::Light before = state.open->scene().lights[0];
        const std::string text = textOfPanel(state);
        for (const char* word : some) EXPECT_THAT(text, HasSubstr(word)) << what;
        for (const char* word : others) EXPECT_THAT(text, Not(HasSubstr(word))) << what;
        EXPECT_TRUE(state.open->scene().lights[0] == before) << "drawing it changes nothing";
    };
    const auto change = [&](const auto& edit) { test::changeLight(state, 0, edit); };
    using Way = scenes::LightAnimationKind;
    const auto choose = [&](Way way) { change([&](scenes::Light& light) { chooseWay(light, way, 0.0, 1.0); }); };
    expectRows("still", {"Keys of position", "Keys of colour", "Keys of intensity", "Add at 1.50 s"},
               {"Way", "Keys of direction", "Period", "Between"});
    change([](scenes::Light& light) { light.type = scenes::LightType::Spot; });
    expectRows("a spot", {"Keys of direction"}, {"Way"});
    choose(Way::Orbit);
    expectRows("an orbit", {"Way", "Centre", "Axis", "Period", "Phase"}, {"Keys of position", "Point 0"});
    choose(Way::Wobble);
    expectRows("a wobble", {"Amplitude", "Period"}, {"Centre", "Keys of position"});
    choose(Way::Path);
    expectRows("a path", {"Point 0", "Point 3", "Line", "closed", "ahead", "Period"}, {"Centre", "Keys of position"});
    choose(Way::Keyframes);
    expectRows("keys", {"Keys of position", "Between", "After", "1.50 s", "6.00 s"}, {"Period", "Point 0"});
    change([](scenes::Light& light) {
        chooseType(light, scenes::LightType::Directional, 1.0);
        light.animation.reset();
        addKey(light, scenes::LightKeyed::Intensity, 2.25);
    });
    expectRows("a sun", {"Keys of direction", "Keys of intensity", "2.25 s"}, {"Way", "Keys of position"});
}

TEST_F(LightRows, ofManyLightsTheListHasGroupsWhichUnfoldForALightThatIsSelectedElsewhere) {
    Lights lamps(9);
    for (std::size_t i = 0; i < lamps.size(); ++i) lamps[i].name = fmt::format("lamp {}", i);
    State state = test::stateOf(test::roomWith(lamps));
    const auto has = [&](const char* label) { return textOfPanel(state).find(label) != std::string::npos; };
    EXPECT_TRUE(has("lamp (9)"));
    EXPECT_FALSE(has("lamp 3"));
    state.selectedLight = 3;
    EXPECT_TRUE(has("lamp 3"));
    state.listing.unfolded.clear();
    state.listing.search = "mp 5";
    EXPECT_TRUE(has("lamp 5"));
    EXPECT_FALSE(has("lamp (9)"));
    selectAllLights(state);
    EXPECT_EQ(state.allSelectedLights(), std::set<int>{5}) << "those that the search finds";
    state.listing.search.clear();
    selectAllLights(state);
    EXPECT_TRUE(has("Edits apply to all 9 selected lights."));
}

TEST_F(LightRows, aClickOnANameSelectsTheLightAndAnotherLetsGoOfIt) {
    scenes::Light lamp;
    lamp.name = "lamp";
    State state = test::stateOf(test::roomWith({lamp}));
    const auto draw = [&] { show([&] { lightsPanel(state); }); };
    draw();
    const ImGuiWindow* const list = windowNamed("/lights_");
    ASSERT_NE(list, nullptr);
    const float padding = 2.0f * ImGui::GetStyle().CellPadding.y;
    const float header = ImGui::GetTextLineHeight() + padding, row = ImGui::GetFrameHeight() + padding;
    ImGui::GetIO().MouseDoubleClickTime = 0.0f; // these clicks are single ones
    for (const int expected : {0, scenes::kNone, 0}) {
        click({list->Pos.x + 100.0f, list->Pos.y + header + 0.5f * row}, draw);
        EXPECT_EQ(state.selectedLight, expected);
    }
}

} // namespace
} // namespace tessera::viewer
