#include "viewer/window/Theme.h"

#include <algorithm>

#include "base/Srgb.h"
#include "tests/unit/viewer/PanelTest.h"

namespace tessera::viewer {
namespace {

/// Of a colour as the display shows it. Source: WCAG 2.2, "relative luminance".
double relativeLuminance(ImGuiCol color) {
    const ImVec4& code = ImGui::GetStyle().Colors[color];
    return 0.2126 * linearFromSrgb(code.x) + 0.7152 * linearFromSrgb(code.y) + 0.0722 * linearFromSrgb(code.z);
}

/// Source: WCAG 2.2, "contrast ratio".
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

TEST_F(Theme, numbersCanBeReadOnSliders) {
    EXPECT_GE(contrast(ImGuiCol_Text, ImGuiCol_FrameBg), kLeastOfText);
    EXPECT_GE(contrast(ImGuiCol_Text, ImGuiCol_SliderGrab), kLeastOfText);
    EXPECT_GE(contrast(ImGuiCol_Text, ImGuiCol_SliderGrabActive), kLeastOfParts) << "while it is dragged";
}

TEST_F(Theme, selectedRowsCanBeReadAndScrollBarsAreSeen) {
    for (const ImGuiCol row : {ImGuiCol_Header, ImGuiCol_HeaderHovered})
        EXPECT_GE(contrast(ImGuiCol_Text, row), kLeastOfText) << ImGui::GetStyleColorName(row);
    for (const ImGuiCol grab : {ImGuiCol_ScrollbarGrab, ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive})
        EXPECT_GE(contrast(grab, ImGuiCol_WindowBg), kLeastOfParts) << ImGui::GetStyleColorName(grab);
}

} // namespace
} // namespace tessera::viewer
