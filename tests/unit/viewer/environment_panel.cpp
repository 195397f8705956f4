// The environment panel, with and without an environment.
#include "scenes/Load.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/MapChoices.h"
#include "viewer/session/SceneEdits.h"

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
        EXPECT_EQ(state.open->isEdited(), isThere);
        state.open->endGesture(); // as the whole window does
        while (state.open->history().undoable() > 0) undo(state);
        for (const char* key : {"environmentRotation", "environmentIntensity"})
            EXPECT_TRUE(engine::settingOf(key).value.equal(state.looks[0], before)) << key;
        EXPECT_FALSE(state.open->isEdited());
    }
}

TEST_F(EnvironmentPanel, showsTheProgressOfOneThatIsLoaded) {
    State state = test::stateOf(scenes::loadScene("room"));
    Facts facts;
    const auto says = [&](const std::string& words) {
        return textOf([&] { environmentPanel(state, facts); }).find(words) != std::string::npos;
    };
    EXPECT_TRUE(says("Open ... above, or drop .hdr or .exr"));
    state.loadingEnvironment = "sky";
    facts.background = {"Computing sky", 0.449, true};
    EXPECT_TRUE(says("Computing sky: 45 % (Esc)"));
    EXPECT_FALSE(says("or drop"));
    facts.background = {"Loading sky", {}, true};
    EXPECT_TRUE(says("Loading sky ..."));
}

TEST_F(EnvironmentPanel, aLoadThatEscCancelsGoesBeforeThePictureThatItWillReplace) {
    Facts facts;
    EXPECT_FALSE(facts.shownProgress());
    facts.progress = {"Drawing the whole picture", 0.5, true};
    EXPECT_EQ(facts.shownProgress(), facts.progress);
    facts.background = {"Loading sky", {}, true};
    EXPECT_EQ(facts.shownProgress(), facts.background);
    facts.background->canCancel = false; // like a scene
    EXPECT_EQ(facts.shownProgress(), facts.progress);
    facts.progress.reset();
    EXPECT_EQ(facts.shownProgress(), facts.background);
}

TEST_F(EnvironmentPanel, offersFilesThatWereUsedAndTheDialogForOthers) {
    scenes::Scene scene = scenes::loadScene("room");
    scene.environment.emplace().source = "/maps/a/sunset.hdr";
    State state = test::stateOf(std::move(scene));
    noteMap(state.maps, state.open->scene());
    ImVec2 list;
    const auto panel = [&] {
        list = {ImGui::GetCursorScreenPos().x + 200.0f, ImGui::GetCursorScreenPos().y + 8.0f};
        environmentPanel(state, {});
    };
    EXPECT_NE(textOf(panel).find("sunset.hdr"), std::string::npos);
    // A file, although its name is that of a built-in environment.
    scenes::Scene other = scenes::loadScene("room");
    other.environment.emplace().source = "/maps/b/studio";
    noteMap(state.maps, other);
    noteMap(state.maps, scenes::loadScene("glass"));
    state.open->takeEnvironment({});
    noteMap(state.maps, state.open->scene());
    EXPECT_EQ(state.maps, (std::vector<std::string>{"/maps/b/studio", "/maps/a/sunset.hdr"}));
    const auto clickEntry = [&](std::size_t entry) {
        clickPanel(list, panel);
        ASSERT_FALSE(ImGui::GetCurrentContext()->OpenPopupStack.empty()) << "the list is not open";
        const ImGuiWindow& popup = *ImGui::GetCurrentContext()->OpenPopupStack.back().Window;
        const float y = popup.WindowPadding.y + (float(entry) + 0.4f) * ImGui::GetTextLineHeightWithSpacing();
        clickPanel({popup.Pos.x + 20.0f, popup.Pos.y + y}, panel);
    };
    const std::size_t builtins = scenes::builtinEnvironments().size();
    const std::pair<std::size_t, const char*> kEntries[] = {
        {1, "studio"}, {1 + builtins, "/maps/b/studio"}, {2 + builtins, "/maps/a/sunset.hdr"}};
    for (const auto& [entry, expected] : kEntries) {
        clickEntry(entry);
        EXPECT_EQ(state.requests.environment, expected);
    }
    EXPECT_FALSE(state.requests.showOpenDialog);
    clickEntry(3 + builtins);
    EXPECT_TRUE(state.requests.showOpenDialog);
}

TEST_F(EnvironmentPanel, keepsItsRowsInPlaceWhileOneIsLoadedWhateverItIsCalled) {
    State state = test::stateOf(scenes::loadScene("room"));
    Facts facts;
    const auto bottom = [&] {
        float y = 0.0f;
        show([&] {
            environmentPanel(state, facts);
            y = ImGui::GetCursorPosY();
        });
        return y;
    };
    const float before = bottom();
    const std::string name = "kloofendal_" + std::string(80, 'x') + "_8k.hdr";
    state.loadingEnvironment = name;
    EXPECT_EQ(bottom(), before) << "nothing is shown yet";
    std::string kept;
    for (const double share : {0.0, 0.09, 0.31, 1.0}) {
        facts.background = {"Filtering " + name, share, true};
        EXPECT_EQ(bottom(), before) << share;
        const std::string text = progressText(*facts.background, 250.0f);
        EXPECT_TRUE(text.starts_with("Filtering kl")) << text;
        const std::string words = text.substr(0, text.find(": "));
        EXPECT_TRUE(words.ends_with("8k.hdr")) << text;
        if (kept.empty()) kept = words;
        EXPECT_EQ(words, kept) << "figures grow, and move nothing else";
        EXPECT_LE(ImGui::CalcTextSize(text.c_str()).x, 250.0f);
    }
    facts.background = {"Loading " + name, {}, true};
    EXPECT_EQ(bottom(), before);
}

TEST_F(EnvironmentPanel, textsAreShortenedByWholeLettersOfTheirMiddleAloneWhereTheyAreTooLong) {
    show([] {
        const std::string umlauts = "\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6\xc3\xbc";
        const float whole = ImGui::CalcTextSize(umlauts.c_str()).x; // of six letters
        EXPECT_EQ(shortened(umlauts, whole), umlauts);
        EXPECT_EQ(shortened(umlauts, whole - 0.5f), "\xc3\xa4...\xc3\xbc") << "as wide as five";
        EXPECT_EQ(shortened(umlauts, 0.0f), "...");
        EXPECT_EQ(shortened("", 0.0f), "");
    });
}

} // namespace
} // namespace tessera::viewer
