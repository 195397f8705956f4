#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "tests/unit/viewer/Scenes.h"
#include "viewer/panels/Frame.h"

/// A fixture for panels without a window.
namespace tessera::viewer::test {

/// A look that shows a debug view.
inline Look lookAt(frame::DebugView view) {
    Look look;
    look.settings.view = view;
    return look;
}

/// A scene of all kinds of lights and materials, some of them beyond the panels' bounds.
inline State unusualScene() {
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
    return stateOf(std::move(scene), load);
}

class PanelTest : public testing::Test {
protected:
    PanelTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280.0f, 2000.0f};
        io.Fonts->Build();
    }
    ~PanelTest() override { ImGui::DestroyContext(); }

    /// Runs one frame of the user interface without input.
    template <typename Draw>
    void frame(const Draw& draw) {
        ImGui::NewFrame();
        draw();
        ImGui::EndFrame();
    }
    /// Draws a panel in its own window, with all its rows.
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
    /// Returns the text of a panel, as the window copies it.
    template <typename Panel>
    std::string textOf(const Panel& panel) {
        std::string text;
        show([&] { text = logged(panel); });
        return text;
    }
    /// Clicks the left button at a place while `draw` draws.
    template <typename Draw>
    static void click(const ImVec2& place, const Draw& draw) {
        ImGui::GetIO().MousePos = place;
        for (const bool isDown : {false, true, false}) {
            ImGui::GetIO().MouseDown[0] = isDown;
            draw();
        }
    }
    template <typename Panel>
    void clickPanel(const ImVec2& place, const Panel& panel) {
        click(place, [&] { show(panel); });
    }
    /// Clicks the right ends of all sliders of a panel of this height.
    template <typename Panel>
    void pressSliders(float heightPixels, const Panel& panel) {
        for (float y = 20.0f; y < heightPixels; y += 10.0f) {
            clickPanel({280.0f, y}, panel);
            ImGui::ClosePopupsOverWindow(nullptr, false); // closes a list that the click opened
        }
    }
    static bool isPopupOpen() {
        return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    }
    static bool isTipShown() {
        return std::ranges::any_of(ImGui::GetCurrentContext()->Windows, [](const ImGuiWindow* window) {
            return (window->Flags & ImGuiWindowFlags_Tooltip) != 0 && window->Active;
        });
    }
    /// Returns the latest window whose name contains this; null without one.
    static const ImGuiWindow* windowNamed(const char* part) {
        const ImGuiWindow* found = nullptr;
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            if (std::string(window->Name).find(part) != std::string::npos) found = window;
        return found;
    }
    /// Returns the mouse cursor at a place.
    template <typename Draw>
    ImGuiMouseCursor cursorAt(const ImVec2& place, const Draw& draw) {
        ImGui::GetIO().MousePos = place;
        ImGuiMouseCursor cursor = ImGuiMouseCursor_None;
        for (int i = 0; i < 2; ++i)
            frame([&] {
                draw();
                cursor = ImGui::GetMouseCursor();
            });
        return cursor;
    }
    /// Returns the text of the interface's first window.
    std::string firstWindowText(State& state, const Facts& facts) {
        std::string text;
        for (int i = 0; i < 3; ++i)
            frame([&] { text = logged([&] { drawInterface(state, facts, area(state), 1.0f); }); });
        return text;
    }
    static PictureArea area(const State& state) { return pictureArea(state, {1280.0f, 2000.0f}, 1.0f); }
    template <typename Draw>
    static std::string logged(const Draw& draw) {
        ImGui::LogToClipboard();
        draw();
        ImGui::LogFinish(); // at the end of the first window
        return std::string("\n") + ImGui::GetClipboardText();
    }
    /// Vertices drawn over the image.
    template <typename Draw>
    std::vector<ImDrawVert> overlay(const Draw& draw) {
        std::vector<ImDrawVert> vertices;
        frame([&] {
            draw();
            const auto& drawn = ImGui::GetBackgroundDrawList()->VtxBuffer;
            vertices.assign(drawn.begin(), drawn.end());
        });
        return vertices;
    }
    /// Left and right end of the vertices drawn over the image; empty without any.
    template <typename Draw>
    std::optional<std::pair<float, float>> overlaySpan(const Draw& draw) {
        std::optional<std::pair<float, float>> span;
        for (const ImDrawVert& vertex : overlay(draw)) {
            if (!span) span = {vertex.pos.x, vertex.pos.x};
            span = {std::min(span->first, vertex.pos.x), std::max(span->second, vertex.pos.x)};
        }
        return span;
    }
};

} // namespace tessera::viewer::test
