// The panels, laid out without a window.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "tests/support/TempFolder.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/viewer/ChangeLight.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/InspectorBox.h"
#include "viewer/panels/Legend.h"
#include "viewer/panels/Overlays.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

class Panels : public test::PanelTest {};

/// The number behind a label at the start of a line.
double numberBehind(const std::string& text, const std::string& label) {
    const std::size_t found = text.find("\n" + label);
    if (found == std::string::npos) return std::nan("");
    return std::stod(text.substr(found + 1 + label.size()));
}

/// A look at a view.
Look lookAt(frame::DebugView view) {
    Look look;
    look.settings.view = view;
    return look;
}

/// A scene of all kinds of lights and materials, some of them beyond what the panels would set.
State unusualScene() {
    scenes::LoadOptions load;
    scenes::Scene scene = scenes::loadScene("room", load);
    scenes::Light& spot = scene.lights.emplace_back();
    spot.type = scenes::LightType::Spot;
    spot.innerConeRadians = 1.7f;
    spot.outerConeRadians = 2.1f;
    spot.color = glm::vec3(1e7f, 0.1f, 0.3f);
    spot.intensity = 1e12f;
    spot.rangeMetres = 1e-5f;
    spot.directionWS = glm::normalize(glm::dvec3(0.1, -0.7, 0.2));
    spot.flicker = scenes::LightFlicker{.amplitude = 1.0 / 3.0, .frequencyHz = 900.0, .seed = 7};
    scenes::Light& attenuated = scene.lights.emplace_back();
    attenuated.falloff = scenes::Falloff::Attenuation;
    attenuated.attenuation = glm::vec3(1e8f, 0.1f, 0.0f);
    attenuated.flicker = scenes::LightFlicker{.amplitude = 0.1, .frequencyHz = 0.01, .seed = 3};
    attenuated.animation.emplace().amplitudeMetres = {1.0, 0.0, 0.0};
    scene.lights.emplace_back().type = scenes::LightType::Directional;
    for (const scenes::LightTypeInfo& type : scenes::lightTypes())
        if (type.isArea) scene.lights.emplace_back().type = type.type;
    for (std::size_t model = 0; model < scenes::kMaterialModelCount; ++model) {
        scenes::Material& material = scene.materials.emplace_back();
        material.model = scenes::MaterialModel(model);
        material.baseColor = {2.0f, 0.1f, 0.3f, 0.7f};
        material.alpha = material.alphaY = 3.0f;
        material.exponent = 1e5f;
        material.ior = 9.0f;
        material.anisotropyStrength = 0.5f;
        material.anisotropyRotationRadians = 7.0f;
        material.alphaMode = scenes::AlphaMode::Mask;
        material.alphaCutoff = 1.5f;
    }
    State state;
    state.open = std::make_unique<OpenScene>("room", load, std::move(scene), scenes::SceneOrigin());
    return state;
}

TEST_F(Panels, theVariantsOfModelsAreAListWhereThereAreAny) {
    const auto textFor = [&](const std::vector<std::string>& variants, const std::optional<std::string>& shown) {
        scenes::LoadOptions load;
        load.import.variant = shown;
        scenes::Scene scene = scenes::loadScene("room");
        scene.variants = variants;
        scene.notes = {"a note of the importer"};
        State state;
        state.open = std::make_unique<OpenScene>("room", load, std::move(scene), scenes::SceneOrigin());
        const std::string text = textOf([&] { scenePanel(state); });
        EXPECT_NE(text.find("a note of the importer"), std::string::npos) << text;
        EXPECT_FALSE(state.requests.variant) << "nobody chose one";
        return text;
    };
    EXPECT_EQ(textFor({}, {}).find("Variant"), std::string::npos);
    const std::string plain = textFor({"beach", "street"}, {});
    EXPECT_NE(plain.find("Variant"), std::string::npos) << plain;
    EXPECT_NE(plain.find("as the file has it"), std::string::npos) << plain;
    const std::string street = textFor({"beach", "street"}, "street");
    EXPECT_NE(street.find("street"), std::string::npos) << street;
    EXPECT_EQ(street.find("as the file has it"), std::string::npos) << street;
}

TEST_F(Panels, drawingThePanelsChangesNoValue) {
    State state = unusualScene();
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
        State state;
        state.open =
            std::make_unique<OpenScene>("rigged.gltf", scenes::LoadOptions(), std::move(scene), scenes::SceneOrigin());
        const std::string text = textOf([&] { animationPanel(state); });
        EXPECT_EQ(text.find("Follow the clip's camera") != std::string::npos, moves) << text;
        EXPECT_EQ(state.open->followsClipCamera(), moves) << "drawing it changes nothing";
    }
}

TEST_F(Panels, aLightThatFlickersHasRowsOfItsAmountAndSpeed) {
    State state = unusualScene();
    const std::vector<scenes::Light> lights = state.open->scene().lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        state.selectedLight = int(i);
        const std::string text = textOf([&] { lightsPanel(state); });
        EXPECT_NE(text.find("Flickers"), std::string::npos) << text;
        for (const char* row : {"Flicker amount", "Flicker speed"})
            EXPECT_EQ(text.find(row) != std::string::npos, lights[i].flicker.has_value()) << row << " of " << i;
    }
}

TEST_F(Panels, everySettingOfAPanelHasARowWhereTheTechniqueHeedsIt) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        State state;
        state.looks[0].technique = info.technique;
        const std::array<std::string, 5> texts{textOf([&] { framePanel(state); }),
                                               textOf([&] { shadowsPanel(state, {}); }),
                                               textOf([&] { viewPanel(state); }), textOf([&] { skinPanel(state); }),
                                               textOf([&] { environmentPanel(state); })};
        for (const engine::Setting& setting : engine::settingTable()) {
            const bool isShown[] = {
                setting.panel == engine::SettingPanel::Frame, setting.panel == engine::SettingPanel::Shadows,
                setting.panel == engine::SettingPanel::View, setting.panel == engine::SettingPanel::Skin,
                setting.panel == engine::SettingPanel::Environment};
            for (const int panel : {0, 1, 2, 3, 4}) {
                const bool hasRow =
                    texts[std::size_t(panel)].find(fmt::format("\n{} ", setting.panelLabel())) != std::string::npos;
                EXPECT_EQ(hasRow, isShown[panel] && setting.isHeededBy(info.technique))
                    << setting.name << " with " << info.name << " in" << texts[std::size_t(panel)];
            }
        }
    }
}

TEST_F(Panels, noPlanIsMadeWhileThePanelsAreHidden) {
    State state;
    state.wantsPlan = true; // the graph was shown the frame before
    state.showsPanel = false;
    frame([&] { drawInterface(state, {}, pictureArea(state, {1280.0f, 2000.0f}, 1.0f), 1.0f); });
    EXPECT_FALSE(state.wantsPlan);
}

TEST_F(Panels, oneDragOfAWidgetIsOneStepThatCanBeUndone) {
    State state = unusualScene();
    OpenScene& open = *state.open;
    test::changeLight(state, 0, [](scenes::Light& light) { light.intensity = 1.0f; });
    open.becomes("/saved.json");
    const float before = open.scene().lights.at(0).intensity;
    ImVec2 corner;
    const auto next = [&](bool isDown, float x) {
        ImGui::GetIO().MouseDown[0] = isDown;
        ImGui::GetIO().MousePos = {corner.x + 20.0f + x, corner.y + 5.0f};
        frame([&] {
            ImGui::SetNextWindowPos({400.0f, 10.0f});
            ImGui::SetNextWindowSize({300.0f, 200.0f});
            ImGui::Begin("aside");
            scenes::Light light = open.scene().lights[0];
            if (ImGui::DragFloat("##value", &light.intensity, 0.125f)) open.changeLight(0, light, widgetGesture());
            corner = ImGui::GetItemRectMin();
            ImGui::End();
            drawInterface(state, {}, area(state), 1.0f);
        });
    };
    std::vector<float> ends;
    for (int drag = 0; drag < 2; ++drag) {
        const float start = 60.0f * float(drag); // in one place it would be a double click
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

TEST_F(Panels, theDialogAsksAboutUnsavedEditsUntilItIsAnswered) {
    State state = unusualScene();
    const auto isOpen = [&] {
        show([&] { questionDialog(state, 1.0f); });
        return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    };
    EXPECT_FALSE(isOpen());
    state.question = Question{Question::About::Opening, "/scenes/lamps.json"};
    EXPECT_TRUE(isOpen());
    EXPECT_EQ(questionText(*state.question, "room"),
              "room has edits that are not saved. Save them before lamps.json is opened?");
    EXPECT_FALSE(state.requests.answer);
    state.question.reset();
    EXPECT_FALSE(isOpen());
}

TEST_F(Panels, theDialogOfFilesTakesTypedTextAndWaitsForAQuestion) {
    const tessera::test::TempFolder folder;
    const std::string file = folder.write("one.glb", "").string();
    State state;
    ImGuiIO& io = ImGui::GetIO();
    constexpr int kEnter = 7; // any number
    io.KeyMap[ImGuiKey_Enter] = kEnter;
    const auto isOpen = [&] {
        show([&] {
            fileDialog(state, 1.0f);
            questionDialog(state, 1.0f);
        });
        return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    };
    EXPECT_FALSE(isOpen());
    state.files.emplace(FileDialog::Purpose::Open, folder.path());
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(io.WantTextInput) << "nobody has to click the field first";
    io.AddInputCharacter('o');
    EXPECT_TRUE(isOpen());
    EXPECT_EQ(state.files->text(), "o");
    state.question = Question{};
    EXPECT_TRUE(isOpen());
    EXPECT_FALSE(io.WantTextInput) << "keys are answers";
    state.question.reset();
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(isOpen());
    io.KeysDown[kEnter] = true;
    isOpen();
    io.KeysDown[kEnter] = false;
    EXPECT_FALSE(isOpen());
    EXPECT_FALSE(state.files);
    EXPECT_EQ(state.requests.chosen, file);
}

TEST_F(Panels, aNoticeThatAppearsDoesNotReleaseAPressedButton) {
    State state;
    bool isClicked = false;
    const auto next = [&](bool isDown) {
        ImGui::GetIO().MouseDown[0] = isDown;
        frame([&] {
            ImGui::SetNextWindowPos({400.0f, 10.0f});
            ImGui::SetNextWindowSize({300.0f, 200.0f});
            ImGui::Begin("aside");
            isClicked = ImGui::Button("do", {100.0f, 40.0f}) || isClicked;
            const ImVec2 corner = ImGui::GetItemRectMin();
            ImGui::GetIO().MousePos = {corner.x + 50.0f, corner.y + 20.0f};
            ImGui::End();
            drawInterface(state, {}, area(state), 1.0f);
        });
    };
    for (const bool isDown : {false, false, false, true}) next(isDown);
    state.notice.text = "Saved elsewhere.png";
    for (const bool isDown : {true, true, false}) next(isDown);
    EXPECT_TRUE(isClicked);
}

TEST_F(Panels, aSwatchOpensAPickerThatChangesNothingByItself) {
    const glm::vec3 before(0.402f, 3.5f, 0.3f); // brighter than a display
    glm::vec3 color = before;
    ImVec2 swatch;
    const auto draw = [&] {
        EXPECT_FALSE(colorRow("Colour", color, 1e6f));
        swatch = ImGui::GetItemRectMin();
    };
    const auto isOpen = [] {
        return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    };
    const std::string text = textOf(draw);
    for (const char* linear : {"0.402", "3.5", "0.3"}) EXPECT_NE(text.find(linear), std::string::npos) << text;
    EXPECT_FALSE(isOpen());
    ImGui::GetIO().MousePos = {swatch.x + 5.0f, swatch.y + 5.0f};
    for (const bool isDown : {false, true, false}) {
        ImGui::GetIO().MouseDown[0] = isDown;
        show(draw);
    }
    EXPECT_TRUE(isOpen());
    EXPECT_EQ(color, before);
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
            for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
                isShown = isShown || ((window->Flags & ImGuiWindowFlags_Tooltip) != 0 && window->Active);
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
    EXPECT_DOUBLE_EQ(numberBehind(text, "Endless"), 12.0) << text;
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
    EXPECT_DOUBLE_EQ(numberBehind(text, "Endless"), 12.0) << text;
    EXPECT_NE(text.find("no light to cull"), std::string::npos) << text;
    EXPECT_EQ(text.find("Needed"), std::string::npos) << text;
}

/// Shadow maps of so many lights, which are those of the scene.
engine::DrawnShadows mapsOf(std::size_t lights) {
    engine::DrawnShadows shadows;
    shadows.hasMaps = true;
    for (std::size_t i = 0; i < lights; ++i) shadows.lights.push_back({int(i), 6, 1024, 512});
    shadows.lights.front().wantedTexels = 512;
    shadows.lights.back().sideTexels = 0;
    shadows.atlasTexels = {4096, 1024};
    shadows.budgetMiB = 20.0;
    shadows.faces = 6 * (lights - 1);
    shadows.drawnFaces = 4;
    return shadows;
}

TEST_F(Panels, theShadowsPanelTellsWhatHoldsTheShadowsOfWhichLight) {
    State state = unusualScene();
    Facts facts;
    const auto text = [&] { return textOf([&] { shadowsPanel(state, facts); }); };
    EXPECT_EQ(text().find("Atlas"), std::string::npos) << "nothing is drawn yet";
    facts.shadows[0] = mapsOf(3);
    test::changeLight(state, 1, [](scenes::Light& light) { light.name = "lamp"; });
    const std::string maps = text();
    for (const char* part :
         {"4096x1024 texels", "16 of 20 MiB", "12: 4 drawn, 8 kept", "512 of 1024", "no room", "lamp"})
        EXPECT_NE(maps.find(part), std::string::npos) << part << " in" << maps;
    facts.shadows[0]->hasMaps = false;
    const std::string traced = text();
    EXPECT_NE(traced.find("traced"), std::string::npos) << traced;
    EXPECT_EQ(traced.find("Atlas"), std::string::npos) << traced;
    facts.shadows[0]->lights.clear();
    EXPECT_NE(text().find("No light in view casts shadows"), std::string::npos);
    // Lights that were deleted since the frame have no row.
    facts.shadows[0] = mapsOf(3);
    state.open->replaceLights("delete", 1, state.open->scene().lights.size() - 1, {});
    EXPECT_EQ(text().find("no room"), std::string::npos);
}

TEST_F(Panels, theShadowsPanelTakesNoValueThatTheFilterDoesNotHeed) {
    for (const frame::ShadowFilterInfo& filter : frame::shadowFilterTable()) {
        State state;
        state.looks[0].settings.shadowFilter = filter.filter;
        const Look before = state.looks[0];
        for (float y = 20.0f; y < 250.0f; y += 10.0f) { // across all sliders, near their right ends
            ImGui::GetIO().MousePos = {280.0f, y};
            for (const bool isDown : {false, true, false}) {
                ImGui::GetIO().MouseDown[0] = isDown;
                show([&] { shadowsPanel(state, {}); });
            }
            ImGui::ClosePopupsOverWindow(nullptr, false); // of a list that the click opened
        }
        for (const engine::Setting& setting : engine::settingTable()) {
            if (!std::holds_alternative<engine::NumberKind>(setting.value.kind)) continue;
            const bool isSlid = setting.panel == engine::SettingPanel::Shadows && setting.whyIdle(before).empty();
            EXPECT_EQ(!setting.value.equal(state.looks[0], before), isSlid) << setting.name << " with " << filter.name;
        }
    }
}

TEST_F(Panels, theShadowsPanelSaysWhereNoLightHasTheSizeThatItsFilterHeeds) {
    State state = unusualScene();
    Facts facts;
    facts.shadows[0] = mapsOf(3);
    const auto saysSo = [&](frame::ShadowFilter filter) {
        state.looks[0].settings.shadowFilter = filter;
        return textOf([&] { shadowsPanel(state, facts); }).find("has a size") != std::string::npos;
    };
    EXPECT_TRUE(saysSo(frame::ShadowFilter::Pcss));
    EXPECT_FALSE(saysSo(frame::ShadowFilter::Pcf));
    test::changeLight(state, 2, [](scenes::Light& light) { light.radiusMetres = 0.1f; });
    EXPECT_FALSE(saysSo(frame::ShadowFilter::Pcss));
}

TEST_F(Panels, ofManyLightsTheShadowsPanelLaysOutThoseInViewAndAClickSelectsOne) {
    State state = unusualScene();
    Lights lamps = state.open->scene().lights;
    lamps.resize(256);
    for (scenes::Light& light : lamps) light.name = "lamp";
    state.open->replaceLights("add", 0, state.open->scene().lights.size(), lamps);
    Facts facts;
    ImGui::GetStyle().ItemSpacing.y += 3.0f; // cells have a padding of their own
    const ImGuiWindow* table = nullptr;
    const auto verticesOf = [&](std::size_t lights) {
        facts.shadows[0] = mapsOf(lights);
        show([&] { shadowsPanel(state, facts); });
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            if (std::string(window->Name).find("shadowed lights") != std::string::npos) table = window;
        return table == nullptr ? 0 : table->DrawList->VtxBuffer.Size;
    };
    const int few = verticesOf(20);
    EXPECT_GT(few, 0);
    EXPECT_EQ(verticesOf(256), few);
    ASSERT_NE(table, nullptr);
    const float row = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
    EXPECT_EQ(std::fmod(table->Size.y, row), 0.0f) << "a row is cut";
    ImGui::GetIO().MousePos = {table->Pos.x + 20.0f, table->Pos.y + 3.5f * row}; // below the header
    for (const bool isDown : {false, true, false}) {
        ImGui::GetIO().MouseDown[0] = isDown;
        show([&] { shadowsPanel(state, facts); });
    }
    EXPECT_EQ(state.selectedLight, 2);
}

TEST_F(Panels, theColoursOfShadowMapsStandOnThePictureThatShowsThem) {
    State state;
    Facts facts;
    const auto isThere = [&] { return overlaySpan([&] { drawLegend(state, facts, area(state), 1.0f); }).has_value(); };
    facts.shown[0] = lookAt(frame::DebugView::Cascades);
    facts.shadows[0] = mapsOf(3);
    EXPECT_TRUE(isThere());
    facts.shown[0] = lookAt(frame::DebugView::Shadow);
    EXPECT_FALSE(isThere());
    facts.shown[0] = lookAt(frame::DebugView::ShadowAtlas);
    EXPECT_TRUE(isThere());
}

TEST_F(Panels, thePointerSaysThatTheDividerCanBeDragged) {
    State state;
    state.compare = Compare::Split;
    state.divider = 0.6f;
    const PictureArea place = area(state);
    const float dividerX = place.corner.x + 0.6f * place.size.x;
    const auto cursorAt = [&](float x) {
        ImGui::GetIO().MousePos = {x, 100.0f};
        ImGuiMouseCursor cursor = ImGuiMouseCursor_None;
        for (int i = 0; i < 2; ++i)
            frame([&] {
                drawDivider(state, place, 1.0f);
                cursor = ImGui::GetMouseCursor();
            });
        return cursor;
    };
    EXPECT_EQ(cursorAt(dividerX + 2.0f), ImGuiMouseCursor_ResizeEW);
    EXPECT_EQ(cursorAt(dividerX + 20.0f), ImGuiMouseCursor_Arrow);
    state.isDividerHeld = true;
    EXPECT_EQ(cursorAt(dividerX + 20.0f), ImGuiMouseCursor_ResizeEW) << "it is held, wherever the pointer went";
    state = {};
    EXPECT_EQ(cursorAt(dividerX), ImGuiMouseCursor_Arrow) << "there is none";
}

TEST_F(Panels, theInspectorStaysInThePictureAndHasALoupeForEachSide) {
    State state;
    const PictureArea place = area(state);
    Facts facts;
    const auto span = [&] {
        state.loupes.clear();
        return overlaySpan([&] { drawInspector(state, facts, place); });
    };
    state.pointedPlace = glm::vec2(0.5f);
    facts.inspection.emplace().sides[0].emplace();
    EXPECT_FALSE(span()) << "nothing is inspected";
    state.inspects = true;
    for (const float share : {0.0f, 0.5f, 0.999f}) {
        state.pointedPlace = glm::vec2(share);
        const auto drawn = span();
        ASSERT_TRUE(drawn);
        EXPECT_GE(drawn->first, place.corner.x - 2.0f);
        EXPECT_LE(drawn->second, place.corner.x + place.size.x + 2.0f);
        ASSERT_EQ(state.loupes.size(), 1u);
        EXPECT_TRUE(place.contains(state.loupes[0].corner));
        EXPECT_TRUE(place.contains(state.loupes[0].corner + state.loupes[0].size));
    }
    facts.inspection->sides[1].emplace();
    EXPECT_TRUE(span());
    ASSERT_EQ(state.loupes.size(), 2u);
    EXPECT_EQ(state.loupes[1].side, 1);
    EXPECT_GE(state.loupes[1].corner.x, state.loupes[0].corner.x + state.loupes[0].size);
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
        ImGui::GetIO().MousePos = {200.0f, y};
        for (const bool isDown : {false, true, false}) {
            ImGui::GetIO().MouseDown[0] = isDown;
            show([&] { comparePanel(state, facts); });
        }
        ImGui::ClosePopupsOverWindow(nullptr, false); // of the list that the click opened
    }
    EXPECT_TRUE(state.inspects);
    ASSERT_TRUE(state.pinnedPlace);
    EXPECT_EQ(pixelAt(*state.pinnedPlace, {800, 400}), glm::ivec2(600, 300));
}

TEST_F(Panels, theScaleOfCountsStandsOnTheSideThatShowsThem) {
    State state;
    state.compare = Compare::Split;
    state.divider = 0.6f;
    const PictureArea place = area(state);
    const float dividerX = place.corner.x + 0.6f * place.size.x, endX = place.corner.x + place.size.x;
    Facts facts;
    const auto span = [&] { return overlaySpan([&] { drawLegend(state, facts, place, 1.0f); }); };
    facts.shown = {lookAt(frame::DebugView::Lights), lookAt(frame::DebugView::Final)};
    ASSERT_TRUE(span());
    EXPECT_GT(span()->first, place.corner.x);
    EXPECT_LT(span()->second, dividerX);
    std::swap(facts.shown[0], facts.shown[1]);
    ASSERT_TRUE(span());
    EXPECT_GT(span()->first, dividerX);
    EXPECT_LT(span()->second, endX);
}

TEST_F(Panels, theScaleOfCountsEndsAtTheLargestThatThePictureHas) {
    State state;
    Facts facts;
    facts.shown[0] = lookAt(frame::DebugView::Lights);
    /// Colours of the bar, which is the only thing of any colour.
    const auto brightest = [&] {
        int most = 0;
        frame([&] {
            drawLegend(state, facts, area(state), 1.0f);
            for (const ImDrawVert& vertex : ImGui::GetBackgroundDrawList()->VtxBuffer) {
                const int red = int(vertex.col & 0xffu), blue = int(vertex.col >> 16 & 0xffu);
                if (red - blue > 40) most = std::max(most, red);
            }
        });
        return most;
    };
    EXPECT_GT(brightest(), 240) << "the whole scale, to pale yellow";
    facts.mostCounts[0] = {frame::DebugView::Lights, 5.0f};
    EXPECT_LT(brightest(), 200) << "of 512 lights, 5 are dark";
    facts.mostCounts[0]->view = frame::DebugView::Overdraw;
    EXPECT_GT(brightest(), 240) << "it is that of another view";
}

TEST_F(Panels, whatNamesThePictureFollowsTheShownOneAndNotTheChosenOne) {
    State state;
    state.showsPanel = false;
    state.looks[0] = lookAt(frame::DebugView::Lights); // chosen, and its shaders compile
    Facts facts;
    facts.shown[0] = lookAt(frame::DebugView::Normal);
    facts.isPreparing = true;
    const std::string status = firstWindowText(state, facts);
    EXPECT_NE(status.find(lookName(*facts.shown[0])), std::string::npos) << status;
    EXPECT_EQ(status.find(lookName(state.looks[0])), std::string::npos) << status;
    EXPECT_FALSE(overlaySpan([&] { drawLegend(state, facts, area(state), 1.0f); }));
    std::swap(state.looks[0], *facts.shown[0]);
    EXPECT_TRUE(overlaySpan([&] { drawLegend(state, facts, area(state), 1.0f); }));
}

TEST_F(Panels, theStatusLineSaysThatTheCameraFlies) {
    State state = unusualScene();
    state.showsPanel = false;
    EXPECT_EQ(firstWindowText(state, {}).find("flying"), std::string::npos);
    state.open->rig().setMode(CameraRig::Mode::Fly);
    EXPECT_NE(firstWindowText(state, {}).find("flying"), std::string::npos);
}

TEST_F(Panels, theStatusLineSaysHowFarLightHasSpread) {
    State state;
    state.showsPanel = false;
    Facts facts;
    EXPECT_EQ(firstWindowText(state, facts).find("spreading"), std::string::npos);
    facts.spreading = engine::SpreadProgress{.objects = 3, .doneObjects = 1, .tiles = 200, .doneTiles = 90};
    const std::string status = firstWindowText(state, facts);
    EXPECT_NE(status.find("spreading light: 1 of 3 objects, 45 %"), std::string::npos) << status;
}

TEST_F(Panels, theBoxOfProgressStandsInThePictureAndCoversItself) {
    State state;
    state.showsPanel = false;
    const PictureArea place = area(state);
    const auto boxOf = [&](const Progress& progress) {
        return overlaySpan([&] { drawProgress(progress, place, 1.0f, *ImGui::GetBackgroundDrawList()); });
    };
    const auto unknown = boxOf({"Preparing shaders", {}, true});
    ASSERT_TRUE(unknown);
    EXPECT_GE(unknown->first, place.corner.x);
    EXPECT_LE(unknown->second, place.corner.x + place.size.x);
    EXPECT_EQ(boxOf({"Drawing the whole picture", 0.5, false}), unknown);
    EXPECT_EQ(boxOf({"Drawing the whole picture", 7.0, true}), unknown) << "more than all";
    PictureArea narrow = place;
    narrow.size = {50.0f, 20.0f};
    EXPECT_FALSE(overlaySpan([&] { drawProgress({"x", 0.5, true}, narrow, 1.0f, *ImGui::GetBackgroundDrawList()); }));
}

TEST_F(Panels, theStatusLineSaysThatThePictureWasCancelled) {
    State state;
    state.showsPanel = false;
    Facts facts;
    EXPECT_EQ(firstWindowText(state, facts).find("cancelled"), std::string::npos);
    facts.isCancelled = true;
    EXPECT_NE(firstWindowText(state, facts).find("cancelled (Enter: draw on)"), std::string::npos);
}

TEST_F(Panels, theStatusLineTellsFramesASecondWhileSomethingMoves) {
    State state;
    state.showsPanel = false;
    Facts facts;
    facts.scale = 1.0;
    EXPECT_EQ(firstWindowText(state, facts).find("frames/s"), std::string::npos);
    facts.picturesPerSecond = 24.4;
    EXPECT_NE(firstWindowText(state, facts).find("24 frames/s"), std::string::npos);
}

TEST_F(Panels, theTimingsPanelTellsTheMedianAndTheLatest) {
    State state;
    Facts facts;
    for (const double ms : {10.0, 20.0, 90.0}) {
        FrameTimes frame;
        frame.ms = ms;
        frame.passes = {{"gbuffer", ms / 2.0, 0.1}};
        state.timings.add(frame);
    }
    const std::string text = textOf([&] { timingsPanel(state, facts); });
    EXPECT_NE(text.find("20.0 ms at scale 1"), std::string::npos) << text;
    EXPECT_NE(text.find("3 pictures, the latest 90.0 ms"), std::string::npos) << text;
    EXPECT_NE(text.find("10.0"), std::string::npos) << "of the pass" << text;
}

TEST_F(Panels, settingsAppearWithTheSceneThatDecidesThem) {
    State none;
    none.loading = "room";
    EXPECT_EQ(firstWindowText(none, {}).find("Technique"), std::string::npos);
    State state = unusualScene();
    EXPECT_NE(firstWindowText(state, {}).find("Technique"), std::string::npos);
}

TEST_F(Panels, aViewIsNamedInItsPictureAndTheLitPictureIsLeftFree) {
    State state;
    Facts facts;
    const auto names = [&] { return overlaySpan([&] { drawNames(state, facts, area(state), 1.0f); }); };
    facts.shown[0] = lookAt(frame::DebugView::Final);
    EXPECT_FALSE(names());
    facts.shown[0] = lookAt(frame::DebugView::Geometry);
    ASSERT_TRUE(names());
    EXPECT_GE(names()->first, area(state).corner.x);
    EXPECT_LE(names()->second, area(state).corner.x + area(state).size.x);
    // Beside the divider each side has its own, and neither reaches across.
    state.compare = Compare::Split;
    state.divider = 0.6f;
    const float dividerX = area(state).corner.x + 0.6f * area(state).size.x;
    facts.shown[1] = lookAt(frame::DebugView::Lights);
    std::vector<float> places;
    frame([&] {
        drawNames(state, facts, area(state), 1.0f);
        for (const ImDrawVert& vertex : ImGui::GetBackgroundDrawList()->VtxBuffer) places.push_back(vertex.pos.x);
    });
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](float x) { return x < dividerX; }));
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](float x) { return x > dividerX; }));
    // Of a difference the two pictures.
    state.compare = Compare::Difference;
    EXPECT_TRUE(names());
    facts.shown[1].reset();
    EXPECT_FALSE(names()) << "there is nothing to differ from";
}

TEST_F(Panels, aDifferenceOfNothingIsSaidOnItsBlackPicture) {
    State state;
    state.compare = Compare::Difference;
    Facts facts;
    const auto isSaid = [&] { return overlaySpan([&] { drawNames(state, facts, area(state), 1.0f); }).has_value(); };
    EXPECT_FALSE(isSaid());
    facts.figures.emplace().bitEqual = 1.0;
    EXPECT_TRUE(isSaid());
    facts.figuresAreOld = true;
    EXPECT_FALSE(isSaid());
    facts.figuresAreOld = false;
    facts.figures->bitEqual = 0.999;
    EXPECT_FALSE(isSaid());
}

TEST_F(Panels, theSceneHasASliderForEachParameterOfItsHook) {
    scenes::LoadOptions load;
    scenes::Scene scene = scenes::loadScene("room", load);
    State state;
    state.open = std::make_unique<OpenScene>("room", load, scene, scenes::SceneOrigin());
    EXPECT_THAT(textOf([&] { scenePanel(state); }), testing::Not(testing::HasSubstr("windStrength")));
    scene.hook.emplace().parameters = {{"windStrength", 0.5f, 0.0f, 2.0f}};
    state.open = std::make_unique<OpenScene>("room", load, scene, scenes::SceneOrigin());
    EXPECT_THAT(textOf([&] { scenePanel(state); }), testing::HasSubstr("windStrength"));
    EXPECT_FALSE(state.open->isEdited());
}

} // namespace
} // namespace tessera::viewer
