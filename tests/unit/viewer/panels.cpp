// The panels, laid out without a window.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/Inspection.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

class Panels : public test::PanelTest {
protected:
    /// Moves the pointer to a place of a window beside the panels, with the button down or up, and draws the window and
    /// the interface.
    template <typename Aside>
    void nextAside(State& state, bool isDown, const ImVec2& place, const Aside& aside) {
        ImGui::GetIO().MouseDown[0] = isDown;
        ImGui::GetIO().MousePos = place;
        frame([&] {
            ImGui::SetNextWindowPos({400.0f, 10.0f});
            ImGui::SetNextWindowSize({300.0f, 200.0f});
            ImGui::Begin("aside");
            aside();
            ImGui::End();
            drawInterface(state, {}, area(state), 1.0f);
        });
    }
};

using testing::HasSubstr;
using testing::Not;

/// Returns the number after a label at the start of a line.
double numberBehind(const std::string& text, const std::string& label) {
    const std::size_t found = text.find("\n" + label);
    if (found == std::string::npos) return std::nan("");
    return std::stod(text.substr(found + 1 + label.size()));
}

TEST_F(Panels, theVariantsOfModelsAreAListWhereThereAreAny) {
    const auto textFor = [&](const std::vector<std::string>& variants, const std::optional<std::string>& shown) {
        scenes::LoadOptions load;
        load.import.variant = shown;
        scenes::Scene scene = scenes::loadScene("room");
        scene.variants = variants;
        scene.notes = {"a note of the importer"};
        State state = test::stateOf(std::move(scene), load);
        const std::string text = textOf([&] { scenePanel(state, {}); });
        EXPECT_THAT(text, HasSubstr("a note of the importer"));
        EXPECT_FALSE(state.requests.variant) << "none is chosen";
        return text;
    };
    EXPECT_THAT(textFor({}, {}), Not(HasSubstr("Variant")));
    EXPECT_THAT(textFor({"beach", "street"}, {}),
                testing::AllOf(HasSubstr("Variant"), HasSubstr("as the file has it")));
    EXPECT_THAT(textFor({"beach", "street"}, "street"),
                testing::AllOf(HasSubstr("street"), Not(HasSubstr("as the file has it"))));
}

TEST_F(Panels, drawingThePanelsChangesNoValue) {
    State state = test::unusualScene();
    const std::vector<scenes::Light> lights = state.open->scene().lights;
    const std::vector<scenes::Material> materials = state.open->scene().materials;
    state.looks[0].settings.timeSeconds = 1e12;
    state.looks[0].settings.exposureEV = 200.0f;
    const Look look = state.looks[0];
    for (std::size_t i = 0; i < lights.size(); ++i) {
        state.selectedLight = int(i);
        show([&] { lightsPanel(state); });
    }
    for (std::size_t i = 0; i < materials.size(); ++i) {
        state.selectedMaterial = int(i);
        show([&] { materialsPanel(state); });
    }
    show([&] { viewPanel(state); });
    show([&] { framePanel(state); });
    EXPECT_TRUE(state.open->scene().lights == lights);
    EXPECT_TRUE(state.open->scene().materials == materials);
    EXPECT_FALSE(state.open->isEdited());
    EXPECT_EQ(state.looks[0], look);
}

TEST_F(Panels, theClipsCameraIsOfferedOnlyWhereAClipMovesIt) {
    for (const bool moves : {false, true}) {
        scenes::Scene scene = scenes::riggedScene();
        if (!moves) scene.rig.cameras.clear();
        State state = test::stateOf(std::move(scene));
        const std::string text = textOf([&] { animationPanel(state); });
        EXPECT_EQ(text.find("Follow the clip's camera") != std::string::npos, moves) << text;
        EXPECT_EQ(state.open->followsClipCamera(), moves) << "drawing it changes nothing";
    }
}

TEST_F(Panels, aLightThatFlickersHasRowsOfItsAmountAndSpeed) {
    State state = test::unusualScene();
    const std::vector<scenes::Light> lights = state.open->scene().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        state.selectedLight = int(i);
        const std::string text = textOf([&] { lightsPanel(state); });
        EXPECT_THAT(text, HasSubstr("Flickers"));
        for (const char* row : {"Flicker amount", "Flicker speed"})
            EXPECT_EQ(text.find(row) != std::string::npos, lights[i].flicker.has_value()) << row << " of " << i;
    }
}

TEST_F(Panels, everySettingOfAPanelHasARowWhereTheTechniqueUsesIt) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        State state;
        state.looks[0].technique = info.technique;
        using enum engine::SettingPanel;
        const std::pair<engine::SettingPanel, std::string> texts[] = {
            {Frame, textOf([&] { framePanel(state); })},
            {Shadows, textOf([&] { shadowsPanel(state, {}); })},
            {View, textOf([&] { viewPanel(state); })},
            {Skin, textOf([&] { skinPanel(state); })},
            {Environment, textOf([&] { environmentPanel(state, {}); })}};
        for (const engine::Setting& setting : engine::settingTable())
            for (const auto& [panel, text] : texts)
                EXPECT_EQ(text.find(fmt::format("\n{} ", setting.panelLabel())) != std::string::npos,
                          setting.panel == panel && setting.isUsedBy(info.technique))
                    << setting.name << " with " << info.name << " in" << text;
    }
}

TEST_F(Panels, aMaterialIsShownWhereItsPanelIsOpenAndOneIsSelected) {
    State state = test::unusualScene();
    const auto isShown = [&] {
        for (int i = 0; i < 3; ++i) frame([&] { drawInterface(state, {}, area(state), 1.0f); });
        return state.showsMaterial;
    };
    state.selectedMaterial = 0;
    EXPECT_FALSE(isShown()) << "the panel is folded at first";
    state.sections["Materials"] = true;
    EXPECT_TRUE(isShown());
    state.showsPanel = false;
    EXPECT_FALSE(isShown());
    state.showsPanel = true;
    state.selectedMaterial = scenes::kNone;
    EXPECT_FALSE(isShown());
}

TEST_F(Panels, noPlanIsMadeWhileThePanelsAreHidden) {
    State state;
    state.wantsPlan = true; // the graph was visible in the previous frame
    state.showsPanel = false;
    frame([&] { drawInterface(state, {}, pictureArea(state, {1280.0f, 2000.0f}, 1.0f), 1.0f); });
    EXPECT_FALSE(state.wantsPlan);
}

TEST_F(Panels, oneDragOfAWidgetIsOneStepThatCanBeUndone) {
    State state = test::unusualScene();
    OpenScene& open = *state.open;
    test::setIntensity(open, 1.0f);
    open.becomes("/saved.json");
    const float before = open.scene().lights.at(0).intensity;
    ImVec2 corner;
    const auto next = [&](bool isDown, float x) {
        nextAside(state, isDown, {corner.x + 20.0f + x, corner.y + 5.0f}, [&] {
            scenes::Light light = open.scene().lights[0];
            if (ImGui::DragFloat("##value", &light.intensity, 0.125f)) open.changeLight(0, light, widgetGesture());
            corner = ImGui::GetItemRectMin();
        });
    };
    std::vector<float> ends;
    for (int drag = 0; drag < 2; ++drag) {
        const float start = 60.0f * float(drag); // in the same place it would be a double click
        for (int i = 0; i < 3; ++i) next(false, start);
        for (int i = 0; i < 5; ++i) next(true, start + 10.0f * float(i));
        for (int i = 0; i < 2; ++i) next(false, start + 40.0f);
        ends.push_back(open.scene().lights[0].intensity);
    }
    ASSERT_NE(ends[0], before) << "nothing was dragged";
    ASSERT_NE(ends[1], ends[0]);
    EXPECT_EQ(open.history().stepsToSaved(), -2);
    undo(state);
    EXPECT_EQ(open.scene().lights[0].intensity, ends[0]);
    undo(state);
    EXPECT_EQ(open.scene().lights[0].intensity, before);
    EXPECT_FALSE(open.isEdited());
}

TEST_F(Panels, aNameIsALabelOfOneLineWithAllItsSigns) {
    EXPECT_EQ(labelOf("plain name.glb"), "plain name.glb");
    EXPECT_EQ(labelOf("a##b###c"), "a# #b# # #c");
    EXPECT_EQ(labelOf("two\nlines"), "two; lines");
    scenes::Scene scene = scenes::loadScene("room");
    scene.lights[0].name = "lamp##hidden";
    State state = test::stateOf(std::move(scene));
    EXPECT_THAT(textOf([&] { lightsPanel(state); }), HasSubstr("hidden"));
}

TEST_F(Panels, aNoticeThatAppearsDoesNotReleaseAPressedButton) {
    State state;
    bool isClicked = false;
    ImVec2 corner;
    const auto next = [&](bool isDown) {
        nextAside(state, isDown, {corner.x + 50.0f, corner.y + 20.0f}, [&] {
            isClicked = ImGui::Button("do", {100.0f, 40.0f}) || isClicked;
            corner = ImGui::GetItemRectMin();
        });
    };
    for (const bool isDown : {false, false, false, true}) next(isDown);
    state.notice.text = "Saved elsewhere.png";
    for (const bool isDown : {true, true, false}) next(isDown);
    EXPECT_TRUE(isClicked);
}

TEST_F(Panels, aClickTakesANoteAwayButNoError) {
    State state = test::unusualScene();
    const PictureArea picture = area(state);
    ImGui::GetIO().MousePos = {picture.corner.x + 30.0f, picture.corner.y + picture.size.y - 24.0f};
    for (const bool isError : {false, true}) {
        state.notice = {"2 pictures missing", isError};
        for (const bool isDown : {false, false, true, false}) {
            ImGui::GetIO().MouseDown[0] = isDown;
            frame([&] { drawInterface(state, {}, picture, 1.0f); });
        }
        EXPECT_EQ(state.notice.text.empty(), !isError);
    }
}

TEST_F(Panels, aPanelThatIsOpenedLowInTheColumnIsScrolledTo) {
    ImGui::GetIO().DisplaySize = {1280.0f, 300.0f};
    State state = test::unusualScene();
    state.foldsPanels = true;
    const auto next = [&] {
        frame([&] { drawInterface(state, {}, pictureArea(state, {1280.0f, 300.0f}, 1.0f), 1.0f); });
        return ImGui::FindWindowByName("Panels")->Scroll.y;
    };
    for (int i = 0; i < 3; ++i) EXPECT_EQ(next(), 0.0f);
    for (const auto& [title, isOpen] : state.sections) EXPECT_FALSE(isOpen) << title;
    const auto clickBar = [&](const char* title, int bar) {
        constexpr float kFirst = 17.0f, kStep = 24.0f; // of title bars, one below the other
        click({150.0f, kFirst + kStep * float(bar)}, next);
        next();
        EXPECT_TRUE(state.sections[title]) << title;
        return next();
    };
    EXPECT_EQ(clickBar("Scene", 0), 0.0f) << "all of it is in view";
    state.foldsPanels = true;
    next();
    EXPECT_GT(clickBar("Technique", 8), 0.0f);
}

TEST_F(Panels, aSwatchOpensAPickerThatChangesNothingByItself) {
    const glm::vec3 before(0.402f, 3.5f, 0.3f); // brighter than a display
    glm::vec3 color = before;
    ImVec2 swatch;
    const auto draw = [&] {
        EXPECT_FALSE(colorRow("Colour", color, 1e6f));
        swatch = ImGui::GetItemRectMin();
    };
    const std::string text = textOf(draw);
    for (const char* linear : {"0.402", "3.5", "0.3"}) EXPECT_THAT(text, HasSubstr(linear));
    EXPECT_FALSE(isPopupOpen());
    clickPanel({swatch.x + 5.0f, swatch.y + 5.0f}, draw);
    EXPECT_TRUE(isPopupOpen());
    EXPECT_EQ(color, before);
    ImGui::GetIO().MousePos = {-1.0f, -1.0f};
    const std::string opened = textOf(draw); // up to the end of the picker
    EXPECT_EQ(std::count(opened.begin(), opened.end(), '#'), 1) << "hexadecimal digits, once" << opened;
    EXPECT_THAT(opened, HasSubstr("all times 3.5"));
}

TEST_F(Panels, aTipGoesWithTheClick) {
    ImVec2 place{-1.0f, -1.0f};
    const auto next = [&](bool isDown) {
        ImGui::GetIO().MouseDown[0] = isDown;
        ImGui::GetIO().MousePos = place;
        bool isShown = false;
        frame([&] {
            ImGui::Begin("aside");
            ImGui::Button("do");
            const ImVec2 corner = ImGui::GetItemRectMin();
            tip("what it does");
            ImGui::End();
            place = {corner.x + 3.0f, corner.y + 3.0f};
            isShown = isTipShown();
        });
        return isShown;
    };
    next(false);
    next(false);
    EXPECT_TRUE(next(false));
    EXPECT_FALSE(next(true));
    EXPECT_FALSE(next(false)) << "it comes back over what the click brought";
    place = {-1.0f, -1.0f};
    next(false);
    next(false);
    EXPECT_TRUE(next(false)) << "it never comes back";
}

TEST_F(Panels, theFiguresOfLightCullingDivideToTheTightness) {
    State state;
    Facts facts;
    validation::LightOracleFigures& figures = facts.lights.emplace();
    figures.covered = 1000;
    figures.everywhere = 12000;
    figures.evaluated = 3700;
    figures.needed = 1100;
    const std::string text = textOf([&] { cullingPanel(state, facts); });
    EXPECT_DOUBLE_EQ(numberBehind(text, "All lights"), 15.7) << text;
    EXPECT_DOUBLE_EQ(numberBehind(text, "Without range"), 12.0) << text;
    EXPECT_NEAR(numberBehind(text, "Visited") / numberBehind(text, "Needed"), numberBehind(text, "Tightness"), 0.005)
        << text;
}

TEST_F(Panels, lightCullingSaysWhereThereIsNoLightToCull) {
    State state;
    Facts facts;
    validation::LightOracleFigures& figures = facts.lights.emplace();
    figures.covered = 1000;
    figures.everywhere = 12000;
    const std::string text = textOf([&] { cullingPanel(state, facts); });
    EXPECT_DOUBLE_EQ(numberBehind(text, "Without range"), 12.0) << text;
    EXPECT_THAT(text, testing::AllOf(HasSubstr("no light to cull"), Not(HasSubstr("Needed"))));
}

TEST_F(Panels, subsurfaceScatteringSaysWhereNoMaterialHasAny) {
    for (const auto method : {scenes::SubsurfaceMethod::None, scenes::SubsurfaceMethod::Wrap}) {
        scenes::Scene scene = scenes::loadScene("room");
        scene.materials[0].subsurface.method = method;
        State state = test::stateOf(std::move(scene));
        const std::string text = textOf([&] { skinPanel(state); });
        EXPECT_EQ(text.find("No material has") != std::string::npos, method == scenes::SubsurfaceMethod::None) << text;
    }
}

TEST_F(Panels, aClickOnTheGreatestErrorInspectsItsPixel) {
    State state;
    state.compare = Compare::Split;
    Facts facts;
    facts.sizePixels = {800, 400};
    validation::ErrorFigures& figures = facts.figures.emplace();
    figures.worstX = 600;
    figures.worstY = 300;
    for (float y = 20.0f; y < 400.0f; y += 6.0f) { // across all rows
        clickPanel({200.0f, y}, [&] { comparePanel(state, facts); });
        ImGui::ClosePopupsOverWindow(nullptr, false); // closes the list that the click opened
    }
    EXPECT_TRUE(state.inspects);
    ASSERT_TRUE(state.pinnedPlace);
    EXPECT_EQ(pixelAt(*state.pinnedPlace, {800, 400}), glm::ivec2(600, 300));
}

TEST(StatusLine, reportsLongTimesOfPicturesInSeconds) {
    EXPECT_EQ(pictureTimeText(0.4), "0 ms");
    EXPECT_EQ(pictureTimeText(54.4), "54 ms");
    EXPECT_EQ(pictureTimeText(9999.4), "9999 ms");
    EXPECT_EQ(pictureTimeText(9999.6), "10 s");
    EXPECT_EQ(pictureTimeText(175557.2), "176 s");
}

TEST_F(Panels, theTimingsPanelReportsTheMedianAndTheLatest) {
    State state;
    Facts facts;
    for (const double ms : {10.0, 20.0, 90.0}) {
        FrameTimes frame;
        frame.ms = ms;
        frame.passes = {{"gbuffer", ms / 2.0, 0.1}};
        state.timings.add(frame);
    }
    const std::string text = textOf([&] { timingsPanel(state, facts); });
    for (const char* part : {"20.0 ms at scale 1", "3 pictures, the latest 90.0 ms", "10.0"}) // the latest of the pass
        EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(Panels, settingsAppearWithTheSceneThatDecidesThem) {
    State none;
    none.loading = "room";
    EXPECT_THAT(firstWindowText(none, {}), Not(HasSubstr("Technique")));
    State state = test::unusualScene();
    EXPECT_THAT(firstWindowText(state, {}), HasSubstr("Technique"));
}

TEST_F(Panels, theSceneHasASliderForEachParameterOfItsHook) {
    scenes::Scene scene = scenes::loadScene("room");
    State state = test::stateOf(scene);
    EXPECT_THAT(textOf([&] { scenePanel(state, {}); }), Not(HasSubstr("windStrength")));
    scene.hook.emplace().parameters = {{"windStrength", 0.5f, 0.0f, 2.0f}};
    state = test::stateOf(scene);
    EXPECT_THAT(textOf([&] { scenePanel(state, {}); }), HasSubstr("windStrength"));
    EXPECT_FALSE(state.open->isEdited());
}

} // namespace
} // namespace tessera::viewer
