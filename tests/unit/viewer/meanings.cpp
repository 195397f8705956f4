// Explanations of the panels' rows.
#include <filesystem>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "engine/Settings.h"
#include "scenes/Light.h"
#include "scenes/Material.h"
#include "tests/unit/docs/Tables.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Meanings.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

TEST(Meanings, everyRowThatThePanelsNameHasOne) {
    const std::regex rowOf(
        R"re(\b(slider|logarithmicSlider|angleSlider|row|chooseNamed|choose|colorRow|dragVector|fact)\("([^"]+)")re");
    std::set<std::string> labels;
    for (const auto& file : std::filesystem::directory_iterator(tessera::test::kRepository / "viewer/panels")) {
        const std::string text = tessera::test::textOf(file.path());
        for (std::sregex_iterator found(text.begin(), text.end(), rowOf); found != std::sregex_iterator(); ++found)
            labels.insert((*found)[2]);
    }
    EXPECT_GT(labels.size(), 60u);
    for (const std::string& label : labels) EXPECT_FALSE(meaningOf(label).empty()) << label;
}

TEST(Meanings, everyParameterOfLightsAndMaterialsHasOne) {
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        for (const scenes::LightParameter& parameter : type.parameters)
            EXPECT_FALSE(meaningOf(parameter.label).empty()) << parameter.label;
        if (const scenes::LightParameter* size = scenes::sizeParameter(type)) {
            EXPECT_FALSE(meaningOf(size->label).empty()) << size->label;
        }
    }
    for (std::size_t model = 0; model < scenes::kMaterialModelCount; ++model)
        for (const scenes::MaterialParameter& parameter : infoOf(scenes::MaterialModel(model)).parameters)
            EXPECT_FALSE(meaningOf(parameter.label).empty()) << parameter.label;
    for (const engine::Setting& setting : engine::settingTable()) EXPECT_FALSE(setting.help.empty()) << setting.name;
}

class Tips : public test::PanelTest {};

TEST_F(Tips, comeUpAtARowsLabelAndAtItsWidgetAndNowhereElse) {
    float value = 0.5f;
    ImVec2 corner;
    const auto isShownAt = [&](float x, float y) {
        ImGui::GetIO().MousePos = {x, y};
        bool isShown = false;
        for (int i = 0; i < 3; ++i)
            frame([&] {
                ImGui::SetNextWindowPos({0.0f, 0.0f});
                ImGui::SetNextWindowSize({300.0f, 200.0f});
                ImGui::Begin("panel");
                corner = ImGui::GetCursorScreenPos();
                slider("Metallic", value, 0.0f, 1.0f);
                ImGui::End();
                isShown = isTipShown();
            });
        return isShown;
    };
    EXPECT_FALSE(isShownAt(150.0f, 150.0f));
    EXPECT_TRUE(isShownAt(corner.x + 5.0f, corner.y + 8.0f)) << "at the label";
    EXPECT_TRUE(isShownAt(corner.x + 200.0f, corner.y + 8.0f)) << "at the slider";
    EXPECT_FALSE(isShownAt(600.0f, corner.y + 8.0f));
    // A click hides it until the pointer has left.
    isShownAt(corner.x + 200.0f, corner.y + 8.0f);
    ImGui::GetIO().MouseDown[0] = true;
    EXPECT_FALSE(isShownAt(corner.x + 200.0f, corner.y + 8.0f)) << "it is dragged";
    ImGui::GetIO().MouseDown[0] = false;
    EXPECT_FALSE(isShownAt(corner.x + 200.0f, corner.y + 8.0f)) << "what it changed is looked at";
    isShownAt(600.0f, corner.y + 8.0f);
    EXPECT_TRUE(isShownAt(corner.x + 200.0f, corner.y + 8.0f));
}

} // namespace
} // namespace tessera::viewer
