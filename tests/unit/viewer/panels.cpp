// The panels, laid out without a window.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "viewer/panels/Frame.h"

namespace tessera::viewer {
namespace {

class Panels : public testing::Test {
protected:
    Panels() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280.0f, 2000.0f};
        io.Fonts->Build();
    }
    ~Panels() override { ImGui::DestroyContext(); }

    /// One frame of the user interface in which nobody touches anything.
    template <typename Draw>
    void frame(const Draw& draw) {
        ImGui::NewFrame();
        draw();
        ImGui::EndFrame();
    }
    /// A panel in a window of its own, with all its rows.
    template <typename Panel>
    void show(const Panel& panel) {
        for (int i = 0; i < 3; ++i) { // a window is measured before it is laid out
            frame([&] {
                ImGui::SetNextWindowSize({300.0f, 2000.0f});
                ImGui::Begin("panel");
                panel();
                ImGui::End();
            });
        }
    }
};

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
    scenes::Light& attenuated = scene.lights.emplace_back();
    attenuated.falloff = scenes::Falloff::Attenuation;
    attenuated.attenuation = glm::vec3(1e8f, 0.1f, 0.0f);
    attenuated.animation.emplace().amplitudeMetres = {1.0, 0.0, 0.0};
    scene.lights.emplace_back().type = scenes::LightType::Directional;
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

TEST_F(Panels, everySettingOfAPanelHasARowWhereTheTechniqueHeedsIt) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        State state;
        state.looks[0].technique = info.technique;
        std::array<std::string, 2> texts; // of the panels, as the window could copy them
        show([&] {
            const auto panelText = [](const auto& panel) {
                ImGui::LogToClipboard();
                panel();
                ImGui::LogFinish();
                return std::string("\n") + ImGui::GetClipboardText();
            };
            texts = {panelText([&] { framePanel(state); }), panelText([&] { viewPanel(state); })};
        });
        for (const engine::Setting& setting : engine::settingTable()) {
            const bool isShown[] = {setting.panel == engine::SettingPanel::Frame,
                                    setting.panel == engine::SettingPanel::View};
            for (const int panel : {0, 1}) {
                const bool hasRow =
                    texts[std::size_t(panel)].find(fmt::format("\n{}", setting.panelLabel())) != std::string::npos;
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

} // namespace
} // namespace tessera::viewer
