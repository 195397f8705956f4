#include "viewer/panels/Widgets.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>

#include "base/OneLine.h"
#include "base/Utf8.h"
#include "viewer/panels/Meanings.h"

namespace tessera::viewer {
namespace {

/// Fraction of a panel's width.
constexpr float kLabelShare = 0.36f;
constexpr float kTipWidthEm = 26.0f;

void text(std::string_view words) {
    ImGui::TextUnformatted(words.data(), words.data() + words.size());
}

/// The item under the pointer.
struct Hovered {
    ImVec2 corner{};
    int frame = 0; ///< the last one with the pointer on it
    bool isClicked = false;
};

/// Whether the hovered item was clicked since the pointer entered it: a tooltip would hide the result. `latest` is the
/// item of the previous call.
bool isUsed(Hovered& latest) {
    const ImVec2 corner = ImGui::GetItemRectMin();
    const int frame = ImGui::GetFrameCount();
    const bool isSame = corner.x == latest.corner.x && corner.y == latest.corner.y && frame <= latest.frame + 1;
    latest = {corner, frame, (isSame && latest.isClicked) || ImGui::IsMouseClicked(ImGuiMouseButton_Left)};
    return latest.isClicked;
}

/// Places the tooltip beside the panels instead of over their rows, if there is room.
void placeTooltip() {
    const ImGuiIO& io = ImGui::GetIO();
    const float em = ImGui::GetFontSize(), besideX = ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + 0.5f * em;
    const bool isPanel = ImGui::GetWindowPos().x == 0.0f && ImGui::GetWindowHeight() >= io.DisplaySize.y;
    if (isPanel && besideX + (kTipWidthEm + 2.0f) * em <= io.DisplaySize.x)
        ImGui::SetNextWindowPos({besideX, std::min(ImGui::GetItemRectMin().y, io.DisplaySize.y - 8.0f * em)});
}

void tooltip(std::string_view words, const SmallPicture& picture = {}) {
    placeTooltip();
    ImGui::BeginTooltip();
    if (picture.texture != 0)
        ImGui::Image(reinterpret_cast<ImTextureID>(std::uintptr_t(picture.texture)),
                     {picture.sizePoints.x, picture.sizePoints.y});
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * kTipWidthEm);
    text(words);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// Shows the tooltip of a row while the pointer is at its label, which is the latest item, or to the right of it.
void rowTip(std::string_view meaning) {
    static Hovered latest;
    if (meaning.empty() || !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) return;
    const ImVec2 corner = ImGui::GetItemRectMin();
    const float endX = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (!ImGui::IsMouseHoveringRect(corner, {endX, corner.y + ImGui::GetFrameHeight()}) || isUsed(latest)) return;
    if (!ImGui::IsAnyItemActive()) tooltip(meaning);
}

template <typename Number>
constexpr ImGuiDataType kDataType = ImGuiDataType_COUNT;
template <>
constexpr ImGuiDataType kDataType<int> = ImGuiDataType_S32;
template <>
constexpr ImGuiDataType kDataType<float> = ImGuiDataType_Float;
template <>
constexpr ImGuiDataType kDataType<double> = ImGuiDataType_Double;

/// ID of a widget whose label is beside it.
std::string idOf(const char* label) {
    return std::string("##") + label;
}

} // namespace

void row(const char* label) {
    row(label, meaningOf(label));
}

void row(const char* label, std::string_view meaning) {
    ImGui::AlignTextToFramePadding();
    text(label);
    rowTip(meaning);
    secondColumn();
}

void secondColumn() {
    ImGui::SameLine(ImGui::GetCursorStartPos().x + labelWidth());
    ImGui::SetNextItemWidth(-FLT_MIN);
}

float labelWidth() {
    return std::floor(kLabelShare * ImGui::GetWindowContentRegionMax().x); // whole pixels keep borders sharp
}

std::optional<std::size_t> choose(const char* label, std::string_view shown, std::span<const Choice> choices,
                                  std::size_t chosen, std::string_view meaning) {
    return choose(
        label, shown, choices.size(), [choices](std::size_t i) { return choices[i]; }, chosen, meaning);
}

std::optional<std::size_t> choose(const char* label, std::string_view shown, std::size_t count,
                                  const std::function<Choice(std::size_t)>& choiceAt, std::size_t chosen,
                                  std::string_view meaning) {
    std::optional<std::size_t> result;
    row(label, meaning.empty() ? meaningOf(label) : meaning);
    if (!ImGui::BeginCombo(idOf(label).c_str(), labelOf(shown).c_str(), ImGuiComboFlags_HeightLargest)) return result;
    closeOnEscape();
    ImGuiListClipper clipper;
    clipper.Begin(int(count));
    if (chosen < count) clipper.ForceDisplayRangeByIndices(int(chosen), int(chosen) + 1);
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const auto i = std::size_t(row);
            const Choice choice = choiceAt(i);
            ImGui::PushID(row); // names may be equal
            if (ImGui::Selectable(labelOf(choice.name).c_str(), i == chosen,
                                  choice.isPossible ? 0 : ImGuiSelectableFlags_Disabled))
                result = i;
            if (i == chosen) ImGui::SetItemDefaultFocus();
            tip(choice.meaning);
            ImGui::PopID();
        }
    }
    ImGui::EndCombo();
    return result;
}

Gesture widgetGesture() {
    return ImGui::IsAnyItemActive() ? Gesture::GoesOn : Gesture::Once;
}

template <typename Number>
bool slideNumber(const char* id, Number& value, Number least, Number most, const char* format, bool isLogarithmic) {
    const ImGuiSliderFlags flags = isLogarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
    // Hides Dear ImGui's grab, which would lie behind the number like a selection.
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, ImVec4());
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, ImVec4());
    const bool isChanged = ImGui::SliderScalar(id, kDataType<Number>, &value, &least, &most, format, flags);
    ImGui::PopStyleColor(2);
    if (ImGui::TempInputIsActive(ImGui::GetItemID())) return isChanged; // a number is being typed
    ImRect grab;
    const ImRect frame(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    ImGui::SliderBehavior(frame, ImGui::GetID("grab"), kDataType<Number>, &value, &least, &most, format, flags, &grab);
    const float unit = ImGui::GetStyle().GrabRounding, x = grab.GetCenter().x; // 3 pixels at standard density
    const float railY = frame.Max.y - unit, inset = 1.5f * unit;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 color = ImGui::GetColorU32(ImGui::IsItemActive() ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab);
    list.AddRectFilled({frame.Min.x + inset, railY}, {frame.Max.x - inset, railY + 0.5f * unit},
                       ImGui::GetColorU32(ImGuiCol_Border));
    list.AddRectFilled({frame.Min.x + inset, railY}, {x, railY + 0.5f * unit}, ImGui::GetColorU32(ImGuiCol_CheckMark));
    list.AddRectFilled({x - 1.5f * unit, railY - unit}, {x + 1.5f * unit, frame.Max.y - 0.33f * unit}, color,
                       0.5f * unit);
    return isChanged;
}
template bool slideNumber(const char*, int&, int, int, const char*, bool);
template bool slideNumber(const char*, float&, float, float, const char*, bool);
template bool slideNumber(const char*, double&, double, double, const char*, bool);

bool slider(const char* label, float& value, float least, float most, const char* format) {
    row(label);
    return editShown(value, least, most, format,
                     [&](float& edited) { return slideNumber(idOf(label).c_str(), edited, least, most, format); });
}

bool logarithmicSlider(const char* label, float& value, float least, float most, const char* format) {
    row(label);
    return edit(value, least, most,
                [&](float& edited) { return slideNumber(idOf(label).c_str(), edited, least, most, format, true); });
}

bool angleSlider(const char* label, float& radians, float leastDegrees, float mostDegrees) {
    constexpr const char* kDegrees = "%.1f deg";
    row(label);
    return edit(radians, glm::radians(leastDegrees), glm::radians(mostDegrees), [&](float& edited) {
        auto degrees = float(shownNumber(kDegrees, glm::degrees(edited)));
        if (!slideNumber(idOf(label).c_str(), degrees, leastDegrees, mostDegrees, kDegrees)) return false;
        edited = glm::radians(degrees);
        return true;
    });
}

bool dragNumbers(const char* id, glm::dvec3& value, int numbers, float speed, double least, double most,
                 const char* format) {
    return editShown(value, least, most, format, [&](glm::dvec3& edited) {
        return ImGui::DragScalarN(id, ImGuiDataType_Double, &edited.x, numbers, speed, nullptr, nullptr, format);
    });
}

bool dragVector(const char* label, glm::dvec3& value, float speed, double most) {
    row(label);
    return dragNumbers(idOf(label).c_str(), value, 3, speed, -most, most, "%.3f");
}

std::string labelOf(std::string_view name) {
    std::string label;
    for (const char sign : oneLine(name)) {
        if (sign == '#' && label.ends_with('#')) label += ' ';
        label += sign;
    }
    return label;
}

std::string shortened(std::string_view words, float widthPixels) {
    const std::string line = oneLine(words);
    const auto fits = [widthPixels](const std::string& text) {
        return ImGui::CalcTextSize(text.c_str()).x <= widthPixels;
    };
    if (fits(line)) return line;
    std::vector<std::size_t> begins; // starts of its letters
    for (std::size_t at = 0; at < line.size();
         at += std::max<std::size_t>(letterBytes(std::string_view(line).substr(at)), 1))
        begins.push_back(at);
    begins.push_back(line.size());
    const auto keeping = [&](std::size_t letters) {
        return line.substr(0, begins[(letters + 1) / 2]) + "..." + line.substr(begins[begins.size() - 1 - letters / 2]);
    };
    std::size_t kept = 0, tooMany = begins.size() - 1;
    while (kept + 1 < tooMany) {
        const std::size_t tried = (kept + tooMany) / 2;
        (fits(keeping(tried)) ? kept : tooMany) = tried;
    }
    return keeping(kept);
}

void closeOnEscape() {
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
}

void paragraph(std::string_view words) {
    ImGui::PushTextWrapPos(0.0f);
    text(words);
    ImGui::PopTextWrapPos();
}

void errorParagraph(std::string_view words) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.55f, 0.45f, 1.0f));
    paragraph(words);
    ImGui::PopStyleColor();
}

void tip(std::string_view words, const SmallPicture& picture) {
    static Hovered latest;
    if (words.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || isUsed(latest)) return;
    tooltip(words, picture);
}

void fact(const char* label, const std::string& value) {
    row(label);
    paragraph(value);
}

} // namespace tessera::viewer
