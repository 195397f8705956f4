// The panel Shadows, and its overlay on the image.
#include <cmath>
#include <string>
#include <variant>

#include <gmock/gmock.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Legend.h"
#include "viewer/panels/Panels.h"

namespace tessera::viewer {
namespace {

class ShadowsPanel : public test::PanelTest {};

using testing::HasSubstr;
using testing::Not;

/// Shadow maps of the scene's first lights, as many as `lights`.
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

TEST_F(ShadowsPanel, theShadowsPanelReportsWhatHoldsTheShadowsOfWhichLight) {
    State state = test::unusualScene();
    Facts facts;
    const auto text = [&] { return textOf([&] { shadowsPanel(state, facts); }); };
    EXPECT_THAT(text(), Not(HasSubstr("Atlas"))) << "nothing is drawn yet";
    facts.shadows[0] = mapsOf(3);
    test::changeLight(state, 1, [](scenes::Light& light) { light.name = "lamp"; });
    for (const char* part :
         {"4096x1024 texels", "16 of 20 MiB", "12: 4 drawn, 8 kept", "512 of 1024", "no room", "lamp"})
        EXPECT_THAT(text(), HasSubstr(part));
    facts.shadows[0]->hasMaps = false;
    EXPECT_THAT(text(), testing::AllOf(HasSubstr("traced"), Not(HasSubstr("Atlas"))));
    facts.shadows[0]->lights.clear();
    EXPECT_THAT(text(), HasSubstr("No light in view casts shadows"));
    // Lights deleted since the frame have no row.
    facts.shadows[0] = mapsOf(3);
    state.open->replaceLights("delete", 1, state.open->scene().lights.size() - 1, {});
    EXPECT_THAT(text(), Not(HasSubstr("no room")));
}

TEST_F(ShadowsPanel, theShadowsPanelTakesNoValueThatTheFilterDoesNotUse) {
    for (const frame::ShadowFilterInfo& filter : frame::shadowFilterTable()) {
        State state;
        state.looks[0].settings.shadowFilter = filter.filter;
        const Look before = state.looks[0];
        pressSliders(300.0f, [&] { shadowsPanel(state, {}); });
        for (const engine::Setting& setting : engine::settingTable()) {
            if (!std::holds_alternative<engine::NumberKind>(setting.value.kind)) continue;
            const bool isSlid = setting.panel == engine::SettingPanel::Shadows && setting.whyIdle(before).empty();
            EXPECT_EQ(!setting.value.equal(state.looks[0], before), isSlid) << setting.name << " with " << filter.name;
        }
    }
}

TEST_F(ShadowsPanel, theShadowsPanelSaysWhereNoLightHasTheSizeThatItsFilterUses) {
    State state = test::unusualScene();
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

TEST_F(ShadowsPanel, ofManyLightsTheShadowsPanelLaysOutThoseInViewAndAClickSelectsOne) {
    State state = test::unusualScene();
    Lights lamps = state.open->scene().lights;
    lamps.resize(256);
    for (scenes::Light& light : lamps) light.name = "lamp";
    state.open->replaceLights("add", 0, state.open->scene().lights.size(), lamps);
    Facts facts;
    ImGui::GetStyle().ItemSpacing.y += 3.0f; // cells have a different padding
    const ImGuiWindow* table = nullptr;
    const auto verticesOf = [&](std::size_t lights) {
        facts.shadows[0] = mapsOf(lights);
        show([&] { shadowsPanel(state, facts); });
        table = windowNamed("shadowed lights");
        return table == nullptr ? 0 : table->DrawList->VtxBuffer.Size;
    };
    const int few = verticesOf(20);
    EXPECT_GT(few, 0);
    EXPECT_EQ(verticesOf(256), few);
    ASSERT_NE(table, nullptr);
    const float row = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
    EXPECT_EQ(std::fmod(table->Size.y, row), 0.0f) << "a row is cut";
    const ImVec2 third(table->Pos.x + 20.0f, table->Pos.y + 3.5f * row); // below the header
    clickPanel(third, [&] { shadowsPanel(state, facts); });
    EXPECT_EQ(state.selectedLight, 2);
}

TEST_F(ShadowsPanel, theColoursOfShadowMapsStandOnThePictureThatShowsThem) {
    State state;
    Facts facts;
    const auto isThere = [&] { return overlaySpan([&] { drawLegend(state, facts, area(state), 1.0f); }).has_value(); };
    facts.shadows[0] = mapsOf(3);
    for (const auto view : {frame::DebugView::Cascades, frame::DebugView::Shadow, frame::DebugView::ShadowAtlas}) {
        facts.shown[0] = test::lookAt(view);
        EXPECT_EQ(isThere(), view != frame::DebugView::Shadow) << int(view);
    }
}

} // namespace
} // namespace tessera::viewer
