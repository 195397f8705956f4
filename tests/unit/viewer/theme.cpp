#include "viewer/window/Theme.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/Srgb.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

/// Relative luminance of a displayed colour. Source: WCAG 2.2, "relative luminance".
double relativeLuminance(ImGuiCol color) {
    const ImVec4& code = ImGui::GetStyle().Colors[color];
    return 0.2126 * linearFromSrgb(code.x) + 0.7152 * linearFromSrgb(code.y) + 0.0722 * linearFromSrgb(code.z);
}

/// Contrast ratio of two colours. Source: WCAG 2.2, "contrast ratio".
double contrast(ImGuiCol a, ImGuiCol b) {
    const auto [darker, brighter] = std::minmax({relativeLuminance(a), relativeLuminance(b)});
    return (brighter + 0.05) / (darker + 0.05);
}

class Theme : public test::PanelTest {
protected:
    Theme() { applyTheme(1.0f); }
    // Source: WCAG 2.2, success criteria 1.4.11 (parts of controls) and 1.4.3 (text).
    static constexpr double kLeastOfParts = 3.0, kLeastOfText = 4.5;
};

TEST_F(Theme, theGrabOfASliderStandsOutFromItsTrack) {
    EXPECT_GE(contrast(ImGuiCol_SliderGrab, ImGuiCol_FrameBg), kLeastOfParts);
    EXPECT_GE(contrast(ImGuiCol_SliderGrab, ImGuiCol_FrameBgHovered), kLeastOfParts);
    EXPECT_GE(contrast(ImGuiCol_SliderGrabActive, ImGuiCol_FrameBgActive), kLeastOfParts);
}

TEST_F(Theme, fieldsStandOutFromPanelsByTheirBorders) {
    EXPECT_GE(ImGui::GetStyle().FrameBorderSize, 1.0f);
    for (const ImGuiCol ground : {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_FrameBg})
        EXPECT_GE(contrast(ImGuiCol_Border, ground), kLeastOfParts) << ImGui::GetStyleColorName(ground);
}

TEST_F(Theme, theGrabOfASliderLeavesItsNumberAlone) {
    EXPECT_GE(contrast(ImGuiCol_Text, ImGuiCol_FrameBg), kLeastOfText);
    // The number is at the middle of the frame, and the value in the middle of its range.
    float top = FLT_MAX, bottom = 0.0f, numberTop = 0.0f;
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_SliderGrab);
    show([&] {
        float value = 0.0f;
        slider("Exposure", value, -8.0f, 8.0f, "%+.1f EV");
        const ImVec2 middle((ImGui::GetItemRectMin().x + ImGui::GetItemRectMax().x) / 2.0f, 0.0f);
        numberTop = ImGui::GetItemRectMin().y + ImGui::GetStyle().FramePadding.y;
        for (const ImDrawVert& vertex : ImGui::GetWindowDrawList()->VtxBuffer) {
            if (vertex.col != color || std::abs(vertex.pos.x - middle.x) > 8.0f) continue;
            top = std::min(top, vertex.pos.y);
            bottom = std::max(bottom, vertex.pos.y);
        }
    });
    constexpr float kDigitShare = 0.8f; // of a line of DejaVu Sans, above hanging commas
    EXPECT_GE(top, numberTop + kDigitShare * ImGui::GetFontSize());
    EXPECT_GE(bottom - top, 3.5f) << "there is no grab";
}

TEST_F(Theme, aDialogDarkensTheWindow) {
    const ImVec4& veil = ImGui::GetStyle().Colors[ImGuiCol_ModalWindowDimBg];
    EXPECT_LE(std::max({veil.x, veil.y, veil.z}), 0.05f);
    EXPECT_GE(veil.w, 0.4f);
}

TEST_F(Theme, selectedRowsCanBeReadAndScrollBarsAreSeen) {
    for (const ImGuiCol row : {ImGuiCol_Header, ImGuiCol_HeaderHovered})
        EXPECT_GE(contrast(ImGuiCol_Text, row), kLeastOfText) << ImGui::GetStyleColorName(row);
    for (const ImGuiCol grab : {ImGuiCol_ScrollbarGrab, ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive})
        EXPECT_GE(contrast(grab, ImGuiCol_WindowBg), kLeastOfParts) << ImGui::GetStyleColorName(grab);
}

} // namespace
} // namespace tessera::viewer
