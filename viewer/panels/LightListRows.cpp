#include "viewer/panels/LightListRows.h"

#include <algorithm>
#include <cfloat>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/edit/LightList.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr std::size_t kMostListRows = 12;

/// Selection mode by Shift and Ctrl, for a click on a name.
Choosing choosingNow() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyShift) return Choosing::Range;
    return io.KeyCtrl ? Choosing::Toggle : Choosing::Alone;
}

/// A field for editing a name; letters that it cannot hold are preserved. `flags` may specify when it counts as
/// entered.
bool nameField(const char* id, const char* hint, std::string& name, ImGuiInputTextFlags flags) {
    constexpr std::size_t kRoomBytes = 1024; // for text typed in one frame
    FieldLetters letters;
    std::string buffer = letters.inField(name);
    buffer.resize(buffer.size() + kRoomBytes);
    const bool isEntered = ImGui::InputTextWithHint(id, hint, buffer.data(), buffer.size(), flags);
    name = letters.fromField(buffer.c_str());
    return isEntered;
}

/// Replaces the name. Enter, or a click elsewhere, applies the text, Esc does not.
void renamingField(State& state) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (!state.renamed->isBegun) ImGui::SetKeyboardFocusHere();
    const bool isEntered = nameField("##name", "", state.renamed->name,
                                     ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    const bool isActive = ImGui::IsItemActive();
    const bool isLeft = std::exchange(state.renamed->isBegun, state.renamed->isBegun || isActive) && !isActive;
    if (!isEntered && !isLeft) return;
    if (!isEntered && ImGui::IsKeyPressed(ImGuiKey_Escape, false))
        state.renamed.reset();
    else
        endRenaming(state);
}

/// Rows under the pointer are grey, selected ones blue.
void pushHoverColor(bool isSelected) {
    const ImGuiCol color = isSelected ? ImGuiCol_HeaderHovered : ImGuiCol_TabHovered;
    ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImGui::GetStyleColorVec4(color));
}

void nameCell(State& state, int index, std::span<const int> list) {
    if (state.renamed && state.renamed->light == index) return renamingField(state);
    const std::string name = labelOf(lightLabel(state.open->scene().lights, std::size_t(index)));
    const bool isSelected = state.isLightSelected(index);
    pushHoverColor(isSelected);
    const bool isClicked = ImGui::Selectable(name.c_str(), isSelected, ImGuiSelectableFlags_AllowDoubleClick);
    ImGui::PopStyleColor();
    if (isClicked) {
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            state.selectedLight = index; // the first click may have deselected it
            beginRenaming(state);
        } else {
            selectLight(state, index, choosingNow(), list);
        }
    }
    tip("Ctrl and a click selects several, Shift and a click all between; a double click or F2 renames");
}

/// The row of a group: switches all of its lights, and its name selects them.
void groupRow(State& state, const ListedLight& group) {
    const Lights& lights = state.open->scene().lights;
    ImGui::PushID(group.group.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool areOn = std::ranges::all_of(group.lights, [&](int light) { return lights[std::size_t(light)].enabled; });
    if (ImGui::Checkbox("##on", &areOn)) switchLights(state, group.lights, areOn);
    tip("all of them on or off");
    ImGui::TableNextColumn();
    const bool isOpen = state.listing.unfolded.contains(group.group) || !state.listing.search.empty();
    ImGui::SetNextItemOpen(isOpen);
    const auto isSelected = [&](int light) { return state.isLightSelected(light); };
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth |
                               ImGuiTreeNodeFlags_FramePadding | ImGuiTreeNodeFlags_NoTreePushOnOpen;
    const bool areSelected = std::ranges::all_of(group.lights, isSelected);
    if (areSelected) flags |= ImGuiTreeNodeFlags_Selected;
    const std::string label = fmt::format("{} ({})###group", labelOf(group.group), group.lights.size());
    pushHoverColor(areSelected);
    ImGui::TreeNodeEx(label.c_str(), flags);
    ImGui::PopStyleColor();
    if (ImGui::IsItemToggledOpen()) {
        if (isOpen)
            state.listing.unfolded.erase(group.group);
        else
            state.listing.unfolded.insert(group.group);
    } else if (ImGui::IsItemClicked()) {
        selectLights(state, group.lights, choosingNow() != Choosing::Alone);
    }
    tip("A click selects all of them; the arrow shows them");
    ImGui::TableNextColumn();
    ImGui::PopID();
}

void tableRow(State& state, int index, bool isInGroup, bool isScrolledTo, std::span<const int> list) {
    const Lights& lights = state.open->scene().lights;
    const scenes::Light& light = lights[std::size_t(index)];
    ImGui::PushID(index);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool isOn = light.enabled;
    if (ImGui::Checkbox("##on", &isOn)) {
        const std::set<int> selected = state.allSelectedLights();
        if (selected.contains(index))
            switchLights(state, std::vector<int>(selected.begin(), selected.end()), isOn);
        else
            switchLights(state, {&index, 1}, isOn);
    }
    tip("on or off");
    ImGui::TableNextColumn();
    if (isInGroup) ImGui::Indent();
    const float side = ImGui::GetFontSize();
    const float top = ImGui::GetCursorPosY();
    ImGui::SetCursorPosY(top + 0.5f * (ImGui::GetFrameHeight() - side));
    colorSwatch(light.color, side);
    ImGui::SameLine();
    ImGui::SetCursorPosY(top); // the name is aligned with the checkboxes, not the swatch
    ImGui::AlignTextToFramePadding();
    nameCell(state, index, list);
    if (isScrolledTo && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
    if (isInGroup) ImGui::Unindent();
    ImGui::TableNextColumn();
    std::optional<int>& solo = state.active().settings.soloLight;
    bool isSolo = solo == index;
    if (ImGui::Checkbox("##solo", &isSolo)) solo = toggledSolo(solo, std::size_t(index));
    tip("only this light shines");
    ImGui::PopID();
}

/// The search and the order of the list.
void listingRow(LightListing& listing) {
    ImGui::SetNextItemWidth(0.55f * ImGui::GetContentRegionAvail().x);
    nameField("##search", "search", listing.search, 0);
    tip("Lights with this in their name or kind");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (!ImGui::BeginCombo("##order", nameOf(listing.order))) return;
    closeOnEscape();
    for (std::size_t i = 0; i < std::size_t(LightOrder::Count); ++i)
        if (ImGui::Selectable(nameOf(LightOrder(i)), listing.order == LightOrder(i))) listing.order = LightOrder(i);
    ImGui::EndCombo();
}

} // namespace

void lightList(State& state) {
    const Lights& lights = state.open->scene().lights;
    // A light that was selected elsewhere scrolls into view.
    int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), scenes::kNone);
    const int count = int(lights.size()), selected = state.selectedLight;
    const bool isRenamed = state.renamed && !state.renamed->isBegun;
    const bool isMoved = (std::exchange(shown, selected) != selected || isRenamed) && selected >= 0 && selected < count;
    if (state.allSelectedLights().size() == 1 && isMoved)
        state.listing.unfolded.insert(groupOf(lights, std::size_t(selected), state.listing.order));
    if (lights.size() > kFewLights) listingRow(state.listing);
    const std::uint64_t edits = state.open->edits();
    if (!state.listed || state.listed->edits != edits || state.listed->listing != state.listing)
        state.listed = {edits, state.listing, listedLights(lights, state.listing)};
    const std::vector<ListedLight>& rows = state.listed->rows;
    if (state.renamed && std::ranges::find(rows, state.renamed->light, &ListedLight::light) == rows.end())
        state.renamed.reset(); // the search hides it
    if (rows.empty()) return ImGui::TextDisabled("No light has that in its name");
    const std::vector<int> list = lightsIn(rows);
    const float padding = 2.0f * ImGui::GetStyle().CellPadding.y;
    const float height = ImGui::GetTextLineHeight() + padding +
                         float(std::min(rows.size(), kMostListRows)) * (ImGui::GetFrameHeight() + padding);
    const ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    if (!ImGui::BeginTable("lights", 3, flags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("on", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("solo", ImGuiTableColumnFlags_WidthFixed);
    pushHoverColor(false);
    ImGui::TableHeadersRow();
    ImGui::PopStyleColor();
    ImGuiListClipper clipper; // tens of thousands of rows, few of them visible
    clipper.Begin(int(rows.size()));
    const int row = int(std::ranges::find(rows, selected, &ListedLight::light) - rows.begin());
    if (isMoved && row < int(rows.size())) clipper.ForceDisplayRangeByIndices(row, row + 1);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const ListedLight& listed = rows[std::size_t(i)];
            if (listed.light == scenes::kNone)
                groupRow(state, listed);
            else
                tableRow(state, listed.light, !listed.group.empty(), isMoved && listed.light == selected, list);
        }
    ImGui::EndTable();
}

} // namespace tessera::viewer
