#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <imgui.h>

#include "viewer/panels/Frame.h"

/// Panels without a window.
namespace tessera::viewer::test {

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
    /// What a panel says, as the window could copy it.
    template <typename Panel>
    std::string textOf(const Panel& panel) {
        std::string text;
        show([&] { text = logged(panel); });
        return text;
    }
    /// What the first window of the interface says.
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
    /// Left and right end of what is drawn over the picture; empty where nothing is.
    template <typename Draw>
    std::optional<std::pair<float, float>> overlaySpan(const Draw& draw) {
        std::optional<std::pair<float, float>> span;
        frame([&] {
            draw();
            for (const ImDrawVert& vertex : ImGui::GetBackgroundDrawList()->VtxBuffer) {
                if (!span) span = {vertex.pos.x, vertex.pos.x};
                span = {std::min(span->first, vertex.pos.x), std::max(span->second, vertex.pos.x)};
            }
        });
        return span;
    }
};

} // namespace tessera::viewer::test
