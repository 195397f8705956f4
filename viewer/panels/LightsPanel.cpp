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
#include "viewer/panels/LightListRows.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/FieldLetters.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr float kFirstRangeMetres = 10.0f; ///< of a light that had none
constexpr double kMostSurfaceShare = 0.5;  ///< of the scene's size: slider limit of sides and lengths
constexpr double kMostRadiusShare = 0.1;   ///< the same, of radii

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
    // Not all may be 0: the light would be infinite at every distance.
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

/// Sliders of lengths end at `mostMetres`.
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

/// The size of an area light, or of the penumbras of others.
bool sizeRow(scenes::Light& light, double sceneSizeMetres) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const scenes::LightParameter* const size = scenes::sizeParameter(info);
    if (size == nullptr) return false;
    const bool changed = lightParameterRow(*size, light, kMostRadiusShare * sceneSizeMetres);
    tip(info.isArea ? "Size of the emitter, which softens shadows" : "Softens the light's shadows");
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

/// Names the light whose values the rows below show, if several are selected.
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

/// Buttons that add, duplicate and delete lights.
void listButtons(State& state) {
    const bool any = state.selectedLight != scenes::kNone;
    const std::size_t count = state.allSelectedLights().size();
    const std::string number = count > 1 ? fmt::format(" {}", count) : "";
    const float width = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
    if (ImGui::Button("Add", {width, 0.0f})) state.requests.addLight = true;
    tip("A point light halfway to the surface in the picture's middle");
    ImGui::SameLine();
    ImGui::BeginDisabled(!any);
    if (ImGui::Button(fmt::format("Duplicate{}###duplicate", number).c_str(), {width, 0.0f}))
        duplicateSelectedLights(state);
    tip("A copy of each selected light, in the same place");
    ImGui::SameLine();
    if (ImGui::Button(fmt::format("Delete{}###delete", number).c_str(), {width, 0.0f})) deleteSelectedLights(state);
    ImGui::EndDisabled();
    tip("The selected lights (Del); Ctrl+A selects all");
}

/// Replaces all lights by scattered ones.
void scatterRows(State& state) {
    row("Scatter");
    edit(state.scatter.count, 1, kMostScattered, [](int& count) {
        return slideNumber("##Scatter", count, 1, kMostScattered, count == 1 ? "%d light" : "%d lights", true);
    });
    row("");
    if (ImGui::Button("Replace all by these")) state.requests.scatter = true;
    tip("Ctrl+Z brings the old ones back");
}

/// The flicker differs between lights, by their index.
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
            constexpr double kMostShown = 30.0; // half the refresh rate of most displays
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
    listButtons(state); // first, so that they stay visible however long the list is
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
