#include <algorithm>
#include <cfloat>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/edit/Bounded.h"
#include "viewer/edit/LightList.h"
#include "viewer/panels/ChooseNamed.h"
#include "viewer/panels/LightLifeRows.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/FieldLetters.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr std::size_t kMostListRows = 12;
constexpr float kFirstRangeMetres = 10.0f; ///< of a light that had none
constexpr double kMostSurfaceShare = 0.5;  ///< of the scene's size: sides and lengths that are slid to
constexpr double kMostRadiusShare = 0.1;   ///< the same of radii

/// Shift and Ctrl with a click on a name.
Choosing choosingNow() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyShift) return Choosing::Range;
    return io.KeyCtrl ? Choosing::Toggle : Choosing::Alone;
}

/// A field in which the text of a name is edited; those letters that it cannot hold come back as they are. `flags` may
/// say when it counts as entered.
bool nameField(const char* id, const char* hint, std::string& name, ImGuiInputTextFlags flags) {
    constexpr std::size_t kRoomBytes = 1024; // for what is typed in one frame
    FieldLetters letters;
    std::string buffer = letters.inField(name);
    buffer.resize(buffer.size() + kRoomBytes);
    const bool isEntered = ImGui::InputTextWithHint(id, hint, buffer.data(), buffer.size(), flags);
    name = letters.fromField(buffer.c_str());
    return isEntered;
}

/// In the place of the name. Enter and a click elsewhere take it, Esc does not.
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

void nameCell(State& state, int index, std::span<const int> list) {
    if (state.renamed && state.renamed->light == index) return renamingField(state);
    const std::string name = labelOf(lightLabel(state.open->scene().lights, std::size_t(index)));
    if (ImGui::Selectable(name.c_str(), state.isLightSelected(index), ImGuiSelectableFlags_AllowDoubleClick)) {
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            state.selectedLight = index; // the first click may have let go of it
            beginRenaming(state);
        } else {
            selectLight(state, index, choosingNow(), list);
        }
    }
    tip("Ctrl and a click selects several, Shift and a click all between; a double click or F2 renames");
}

/// Switches all lights of a group, and its name selects them.
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
    if (std::ranges::all_of(group.lights, isSelected)) flags |= ImGuiTreeNodeFlags_Selected;
    const std::string label = fmt::format("{} ({})###group", labelOf(group.group), group.lights.size());
    ImGui::TreeNodeEx(label.c_str(), flags);
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
    ImGui::SetCursorPosY(top); // the name's line is the switches', not the swatch's
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

/// Which lights the list has, and in which order.
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

void lightList(State& state) {
    const Lights& lights = state.open->scene().lights;
    // A light that was selected elsewhere comes into view.
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
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper; // tens of thousands of rows, of which few are in view
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

bool brightnessRows(scenes::Light& light) {
    ImGui::BeginDisabled(scenes::hasKeys(light, scenes::LightKeyed::Color));
    bool changed = colorRow("Colour", light.color, kMostLightColor);
    ImGui::EndDisabled();
    const std::string format = light.falloff == scenes::Falloff::Attenuation
                                   ? "%.4g"
                                   : fmt::format("%.4g {}", scenes::infoOf(light.type).unit);
    row("Intensity");
    ImGui::BeginDisabled(scenes::hasKeys(light, scenes::LightKeyed::Intensity));
    changed |= edit(light.intensity, 0.0f, kMostIntensity, [&](float& intensity) {
        return ImGui::DragFloat("##Intensity", &intensity, 0.01f * std::max(intensity, 0.01f), 0.0f, kMostIntensity,
                                format.c_str());
    });
    ImGui::EndDisabled();
    return changed;
}

bool attenuationRow(scenes::Light& light) {
    row("A, B, C");
    glm::vec3 attenuation = light.attenuation;
    const bool changed = edit(attenuation, 0.0f, kMostAttenuation, [](glm::vec3& value) {
        return ImGui::DragFloat3("##Attenuation", &value.x, 0.01f, 0.0f, kMostAttenuation, "%.4g");
    });
    tip("Divided by A + B d + C d\xc2\xb2");
    // Not all may be 0: the light would be endless at every distance.
    if (!changed || attenuation == glm::vec3(0.0f)) return false;
    light.attenuation = attenuation;
    return true;
}

bool rangeRow(scenes::Light& light) {
    bool changed = false;
    bool ends = !std::isinf(light.rangeMetres);
    row("Range");
    if (ImGui::Checkbox("##ends", &ends)) {
        light.rangeMetres = ends ? kFirstRangeMetres : scenes::kInfinity;
        changed = true;
    }
    tip("whether the light ends");
    if (!ends) return changed;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    changed |= edit(light.rangeMetres, kLeastRangeMetres, kMostRangeMetres, [](float& metres) {
        return ImGui::DragFloat("##Range", &metres, 0.01f * metres, kLeastRangeMetres, kMostRangeMetres, "%.3g m");
    });
    return changed;
}

/// Lengths are slid up to `mostMetres`.
bool lightParameterRow(const scenes::LightParameter& parameter, scenes::Light& light, double mostMetres) {
    using Kind = scenes::LightParameter::Kind;
    float& value = light.*parameter.member;
    switch (parameter.kind) {
    case Kind::Angle:
        return angleSlider(parameter.label, value, parameter.least, parameter.most);
    case Kind::Metres:
        return slider(parameter.label, value, parameter.least, std::min(parameter.most, float(mostMetres)), "%.3g m");
    case Kind::Number:
        break;
    }
    return slider(parameter.label, value, parameter.least, parameter.most);
}

/// How large what shines is, or how soft shadows are.
bool sizeRow(scenes::Light& light, double sceneSizeMetres) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const scenes::LightParameter* const size = scenes::sizeParameter(info);
    if (size == nullptr) return false;
    const bool changed = lightParameterRow(*size, light, kMostRadiusShare * sceneSizeMetres);
    tip(info.isArea ? "Of what shines, and softens its shadows" : "Softens the light's shadows");
    return changed;
}

bool cornerRows(scenes::Light& light, double sceneSizeMetres) {
    bool changed = false;
    const auto most = float(scenes::kMostRadiusMetres);
    for (std::size_t i = 0; i < light.corners.count; ++i) {
        const std::string label = fmt::format("Corner {}", i);
        row(label.c_str());
        glm::vec2 corner = light.corners.metres[i];
        constexpr const char* kMetres = "%.3g m";
        const bool moved = editShown(corner, -most, most, kMetres, [&](glm::vec2& place) {
            return ImGui::DragFloat2(("##" + label).c_str(), &place.x, float(0.001 * sceneSizeMetres), -most, most,
                                     kMetres);
        });
        if (moved) changed |= moveCorner(light, i, corner);
    }
    row("Corners");
    const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Add##corner", {width, 0.0f})) changed |= addCorner(light);
    tip("One more, in the middle of the last edge");
    ImGui::SameLine();
    if (ImGui::Button("Remove##corner", {width, 0.0f})) changed |= removeCorner(light);
    tip("Takes the last one away; three are the least");
    return changed;
}

bool parameterRows(scenes::Light& light, double sceneSizeMetres) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const std::span<const scenes::LightParameter> parameters = info.parameters;
    bool changed = false;
    for (const scenes::LightParameter& parameter : parameters)
        changed |= lightParameterRow(parameter, light, kMostSurfaceShare * sceneSizeMetres);
    if (info.hasCorners()) changed |= cornerRows(light, sceneSizeMetres);
    if (info.isArea) changed |= sizeRow(light, sceneSizeMetres);
    if (info.isFlat) {
        row("Shines");
        changed |= ImGui::Checkbox("from both sides##light", &light.isTwoSided);
        if (light.texture) {
            row("Texture");
            ImGui::TextUnformatted(light.texture->map.name.c_str());
        }
    }
    if (info.isArea) {
        row("Surface");
        changed |= ImGui::Checkbox("seen in the picture##light", &light.isSeen);
    }
    if (!changed) return false;
    for (const scenes::LightParameter& parameter : parameters)
        if (parameter.within != nullptr)
            light.*parameter.member = std::min(light.*parameter.member, light.*parameter.within);
    return true;
}

bool placeRows(scenes::Light& light, double timeSeconds, double sceneSizeMetres) {
    bool changed = false;
    const scenes::Light shown = scenes::lightAtTime(light, timeSeconds);
    if (scenes::infoOf(light.type).hasPosition()) {
        glm::dvec3 positionWS = shown.positionWS;
        if (dragVector("Position", positionWS, float(0.001 * sceneSizeMetres), kMostMetres)) {
            placeLight(light, timeSeconds, positionWS);
            changed = true;
        }
    }
    if (scenes::infoOf(light.type).hasDirection) {
        glm::dvec3 directionWS = shown.directionWS;
        if (dragVector("Direction", directionWS, 0.01f, kMostDirection) && glm::length(directionWS) > 1e-3) {
            turnLight(light, directionWS);
            changed = true;
        }
    }
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (info.isTurned()) {
        glm::dvec3 alongWS = light.alongWS;
        if (dragVector(info.hasSides() ? "Width along" : "Corners along", alongWS, 0.01f, kMostDirection))
            changed |= layLight(light, alongWS);
        tip(info.hasSides() ? "Where its width runs, across its direction"
                            : "Where the first numbers of its corners run, across its direction");
    }
    return changed;
}

/// What of several lights the rows below are about.
void selectionLine(const State& state, std::size_t selected) {
    if (selected < 2) return;
    const std::string label = labelOf(lightLabel(state.open->scene().lights, std::size_t(state.selectedLight)));
    paragraph(fmt::format("Edits apply to all {} selected lights. Shown are the values of '{}'.", selected, label));
}

bool typeRow(State& state, scenes::Light& light, std::size_t index, double sceneSizeMetres) {
    scenes::LightType type = light.type;
    if (!chooseNamed("Type", type)) return false;
    state.types.choose(index, light, type, sceneSizeMetres);
    return true;
}

bool lightRows(scenes::Light& light, double timeSeconds, double sceneSizeMetres) {
    bool changed = false;
    changed |= brightnessRows(light);
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const bool isAttenuated = light.falloff == scenes::Falloff::Attenuation;
    if (info.hasPosition()) changed |= isAttenuated ? attenuationRow(light) : rangeRow(light);
    changed |= parameterRows(light, sceneSizeMetres);
    changed |= placeRows(light, timeSeconds, sceneSizeMetres);
    row("Shadow");
    changed |= ImGui::Checkbox("casts##light", &light.castsShadow);
    if (!info.isArea) changed |= sizeRow(light, sceneSizeMetres);
    return changed;
}

/// Buttons that change which lights there are.
void listButtons(State& state) {
    const bool any = state.selectedLight != scenes::kNone;
    const float width = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
    if (ImGui::Button("Add", {width, 0.0f})) state.requests.addLight = true;
    tip("A point light halfway to the surface in the picture's middle");
    ImGui::SameLine();
    ImGui::BeginDisabled(!any);
    if (ImGui::Button("Duplicate", {width, 0.0f})) duplicateSelectedLights(state);
    tip("A copy of each selected light, in the same place");
    ImGui::SameLine();
    const std::size_t count = state.allSelectedLights().size();
    const std::string label = count > 1 ? fmt::format("Delete {}###delete", count) : "Delete###delete";
    if (ImGui::Button(label.c_str(), {width, 0.0f})) deleteSelectedLights(state);
    ImGui::EndDisabled();
    tip("The selected lights (Del); Ctrl+A selects all");
}

/// Replaces the lights by many.
void scatterRows(State& state) {
    row("Scatter");
    edit(state.scatter.count, 1, kMostScattered, [](int& count) {
        return slideNumber("##Scatter", count, 1, kMostScattered, count == 1 ? "%d light" : "%d lights", true);
    });
    row("");
    if (ImGui::Button("Replace all by these")) state.requests.scatter = true;
    tip("Ctrl+Z brings the old ones back");
}

/// Lights whose flicker is switched on one after another flicker differently.
bool flickerRows(scenes::Light& light, std::size_t index) {
    row("Flickers");
    bool flickers = light.flicker.has_value();
    bool changed = ImGui::Checkbox("##flickers", &flickers);
    if (changed) letFlicker(light, flickers, index);
    if (!light.flicker) return changed;
    row("Flicker amount");
    changed |= edit(light.flicker->amplitude, 0.0, 1.0,
                    [](double& amplitude) { return slideNumber("##FlickerAmount", amplitude, 0.0, 1.0, "%.2f"); });
    tip("The intensity stays within 1 - amount and 1 + amount times the light's own");
    row("Flicker speed");
    changed |=
        edit(light.flicker->frequencyHz, kLeastFlickerHertz, scenes::LightFlicker::kMostHertz, [](double& hertz) {
            constexpr double kMostShown = 30.0; // half of what most displays show in a second
            return slideNumber("##FlickerSpeed", hertz, kLeastFlickerHertz, kMostShown, "%.2f Hz", true);
        });
    tip("Nothing in the flicker is faster");
    return changed;
}

} // namespace

void lightsPanel(State& state) {
    if (!state.open) return;
    OpenScene& open = *state.open;
    const Lights& lights = open.scene().lights;
    const double timeSeconds = state.active().settings.timeSeconds;
    listButtons(state); // first: they stay in view however long the list is
    if (lights.empty())
        paragraph("There are no lights. Add one, or scatter many below.");
    else
        lightList(state);
    if (state.selectedLight >= int(lights.size())) state.selectedLight = scenes::kNone;
    if (state.selectedLight != scenes::kNone) {
        const scenes::Box3& bounds = open.boundsWS();
        const double size = bounds.empty() || bounds.min == bounds.max ? 1.0 : glm::length(bounds.max - bounds.min);
        const auto index = std::size_t(state.selectedLight);
        scenes::Light edited = lights[index];
        selectionLine(state, state.allSelectedLights().size());
        bool changed = typeRow(state, edited, index, size);
        changed |= lightRows(edited, timeSeconds, size);
        changed |= lightLifeRows(edited, timeSeconds, size);
        changed |= flickerRows(edited, index);
        if (changed) changeSelectedLights(state, edited, size, widgetGesture());
    }
    ImGui::Separator();
    scatterRows(state);
    row("Markers");
    ImGui::Checkbox("show (M)", &state.showsMarkers);
    tip("Drag a marker to move its light. The selected one has handles too, until its name is clicked again.");
}

} // namespace tessera::viewer
