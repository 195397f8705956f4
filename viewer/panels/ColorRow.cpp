// The row of a colour: its linear channels, and a swatch that opens a picker of sRGB code values.
#include <algorithm>
#include <cfloat>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/edit/ShownColor.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

constexpr float kPickerEm = 16.0f;
constexpr const char* kPicker = "picker";
constexpr const char* kPickerScale = "picker scale"; ///< key in the window's storage

/// The picker's full brightness is that of the colour when it was opened. If it followed the edited colour, darkening
/// would never end.
float heldScale(const glm::vec3& color) {
    float& scale = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(kPickerScale), 1.0f);
    return scale = std::max(scale, swatchScale(color));
}

bool picker(glm::vec3& color, float scale) {
    const glm::vec3 before = codeOfColor(color, scale);
    glm::vec3 code = before;
    ImGui::SetNextItemWidth(kPickerEm * ImGui::GetFontSize());
    const bool isEdited =
        ImGui::ColorPicker3("##code", &code.x, ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoSmallPreview);
    if (isEdited) color = colorOfCode(code, before, color, scale);
    return isEdited;
}

} // namespace

void colorSwatch(const glm::vec3& linear, float sidePixels) {
    const glm::vec3 code = swatchOfColor(linear);
    ImGui::ColorButton("##swatch", {code.r, code.g, code.b, 1.0f},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {sidePixels, sidePixels});
}

bool colorRow(const char* label, glm::vec3& color, float most) {
    constexpr float kSpeed = 0.004f; // of the channels, per pixel of a drag
    row(label);
    ImGui::PushID(label);
    const float side = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - side - gap);
    bool isEdited = edit(color, 0.0f, most, [&](glm::vec3& edited) {
        return ImGui::DragFloat3("##linear", &edited.x, kSpeed * swatchScale(color), 0.0f, most, "%.3g");
    });
    tip("Linear red, green and blue; the swatch has them in sRGB, and in hexadecimal digits");
    ImGui::SameLine(0.0f, gap);
    colorSwatch(color, side);
    if (ImGui::IsItemClicked()) {
        ImGui::GetStateStorage()->SetFloat(ImGui::GetID(kPickerScale), swatchScale(color));
        ImGui::OpenPopup(kPicker);
    }
    tip(colorText(color));
    const float scale = heldScale(color);
    if (ImGui::BeginPopup(kPicker)) {
        closeOnEscape();
        isEdited |= edit(color, 0.0f, most, [scale](glm::vec3& edited) { return picker(edited, scale); });
        if (scale > 1.0f) ImGui::TextUnformatted(fmt::format("all times {:.3g}: brighter than white", scale).c_str());
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return isEdited;
}

} // namespace tessera::viewer
