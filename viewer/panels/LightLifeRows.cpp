#include "viewer/panels/LightLifeRows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "scenes/Direction.h"
#include "viewer/edit/Bounded.h"
#include "viewer/edit/LightLife.h"
#include "viewer/edit/LightList.h"
#include "viewer/panels/ChooseNamed.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

constexpr double kFirstWayShare = 0.05; ///< of the scene's size: extent of the path of a light that begins to move
constexpr float kStepShare = 0.001f;    ///< of the scene's size: per pixel of a drag of a position
constexpr float kSecondsPerPixel = 0.02f;
constexpr const char* kValue = "##value";

/// Width of a row that is left beside buttons at its end.
float widthBeside(int buttons) {
    const float button = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    return ImGui::GetContentRegionAvail().x - float(buttons) * button;
}

/// A square button at the end of a row.
bool endButton(const char* label, const char* meaning) {
    const float side = ImGui::GetFrameHeight();
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
    const bool isPressed = ImGui::Button(label, {side, side});
    tip(meaning);
    return isPressed;
}

// ---- Keyframes -----------------------------------------------------------------------------------------------------

bool keyValue(const scenes::LightKeyedInfo& member, glm::dvec3& value, double sceneSizeMetres) {
    switch (member.member) {
    case scenes::LightKeyed::Position:
        return dragNumbers(kValue, value, 3, kStepShare * float(sceneSizeMetres), -kMostMetres, kMostMetres, "%.3f");
    case scenes::LightKeyed::Direction:
        return dragNumbers(kValue, value, 3, 0.01f, -kMostDirection, kMostDirection, "%.3f");
    case scenes::LightKeyed::Color:
        return dragNumbers(kValue, value, 3, 0.004f, 0.0, double(kMostLightColor), "%.3g");
    case scenes::LightKeyed::Intensity:
        return dragNumbers(kValue, value, 1, 0.01f * std::max(float(value.x), 0.01f), 0.0, double(kMostIntensity),
                           "%.4g");
    case scenes::LightKeyed::Count:
        break;
    }
    return false;
}

/// The time of a key, its value and a button that removes it, which sets `removed`.
bool keyRow(scenes::Light& light, const scenes::LightKeyedInfo& member, std::size_t key, double sceneSizeMetres,
            std::optional<std::size_t>& removed) {
    bool changed = false;
    ImGui::PushID(int(key));
    double seconds = keysOf(light, member.member)->timesSeconds[key];
    ImGui::SetNextItemWidth(labelWidth() - ImGui::GetStyle().ItemInnerSpacing.x);
    constexpr const char* kSeconds = "%.2f s";
    if (editShown(seconds, -kMostSeconds, kMostSeconds, kSeconds, [](double& edited) {
            return ImGui::DragScalar("##time", ImGuiDataType_Double, &edited, kSecondsPerPixel, nullptr, nullptr,
                                     kSeconds);
        })) {
        moveKey(light, member.member, key, seconds);
        changed = true;
    }
    tip("A drag moves the key in time, as far as the keys beside it");
    secondColumn();
    ImGui::SetNextItemWidth(widthBeside(1));
    glm::dvec3 value = keysOf(light, member.member)->values[key];
    if (keyValue(member, value, sceneSizeMetres)) {
        setKey(light, member.member, key, value);
        changed = true;
    }
    if (endButton("x", "Takes the key away")) removed = key;
    ImGui::PopID();
    return changed;
}

bool keyRows(scenes::Light& light, const scenes::LightKeyedInfo& member, double timeSeconds, double sceneSizeMetres) {
    bool changed = false;
    ImGui::PushID(member.name.data());
    row(fmt::format("Keys of {}", member.label).c_str());
    if (ImGui::Button(fmt::format("Add at {}###add", numberText("%.2f s", timeSeconds)).c_str())) {
        addKey(light, member.member, timeSeconds);
        changed = true;
    }
    tip("A key of the light's present values; the panel Animation chooses the time");
    if (const scenes::LightKeys* keys = keysOf(light, member.member)) {
        std::optional<std::size_t> removed;
        ImGuiListClipper clipper; // files may have many
        clipper.Begin(int(keys->timesSeconds.size()));
        while (clipper.Step())
            for (int key = clipper.DisplayStart; key < clipper.DisplayEnd; ++key)
                changed |= keyRow(light, member, std::size_t(key), sceneSizeMetres, removed);
        scenes::Interpolation interpolation = keys->interpolation;
        if (chooseNamed("Between", interpolation)) {
            setInterpolation(light, member.member, interpolation);
            changed = true;
        }
        scenes::KeyRepeat repeat = keys->repeat;
        if (chooseNamed("After", repeat)) {
            setRepeat(light, member.member, repeat);
            changed = true;
        }
        if (removed) {
            removeKey(light, member.member, *removed);
            changed = true;
        }
    }
    ImGui::PopID();
    return changed;
}

// ---- Paths ---------------------------------------------------------------------------------------------------------

bool pointRows(scenes::Light& light, double sceneSizeMetres) {
    bool changed = false;
    std::optional<std::size_t> added, removed;
    const std::size_t count = light.animation->pointsWS.size();
    ImGuiListClipper clipper;
    clipper.Begin(int(count));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const auto point = std::size_t(i);
            ImGui::PushID(i);
            row(fmt::format("Point {}", i).c_str());
            ImGui::SetNextItemWidth(widthBeside(2));
            glm::dvec3 placeWS = light.animation->pointsWS[point];
            if (dragNumbers(kValue, placeWS, 3, kStepShare * float(sceneSizeMetres), -kMostMetres, kMostMetres, "%.2f"))
                changed |= movePathPoint(light, point, placeWS);
            if (endButton("+", "Adds a point behind this one")) added = point;
            ImGui::BeginDisabled(count <= 2);
            if (endButton("x", "Takes the point away")) removed = point;
            ImGui::EndDisabled();
            ImGui::PopID();
        }
    if (added) addPathPoint(light, *added);
    if (removed) changed |= removePathPoint(light, *removed);
    return changed || added.has_value();
}

bool pathRows(scenes::Light& light, double sceneSizeMetres) {
    bool changed = pointRows(light, sceneSizeMetres);
    scenes::LightAnimation& path = *light.animation;
    changed |= chooseNamed("Line", path.line);
    row("Path");
    bool isClosed = !path.isOpen;
    if (ImGui::Checkbox("closed##path", &isClosed)) {
        path.isOpen = !isClosed;
        changed = true;
    }
    tip("Around; an open one is run along there and back");
    if (!scenes::infoOf(light.type).hasDirection) return changed;
    row("Looks");
    ImGui::BeginDisabled(scenes::hasKeys(light, scenes::LightKeyed::Direction));
    changed |= ImGui::Checkbox("ahead##path", &path.looksAhead);
    ImGui::EndDisabled();
    return changed;
}

bool periodRows(scenes::LightAnimation& way) {
    row("Period");
    bool changed = edit(way.periodSeconds, kLeastPeriodSeconds, kMostSeconds, [](double& seconds) {
        return ImGui::DragScalar("##Period", ImGuiDataType_Double, &seconds, kSecondsPerPixel, nullptr, nullptr,
                                 "%.2f s");
    });
    row("Phase");
    changed |= edit(way.phase, 0.0, 1.0, [](double& share) { return slideNumber("##Phase", share, 0.0, 1.0, "%.3f"); });
    tip("Where it is at 0 s, as a share of the period");
    return changed;
}

bool wayRows(scenes::Light& light, double timeSeconds, double sceneSizeMetres) {
    scenes::LightAnimationKind kind = light.animation->kind;
    bool changed = chooseNamed("Way", kind);
    if (changed) chooseWay(light, kind, timeSeconds, kFirstWayShare * sceneSizeMetres);
    scenes::LightAnimation& way = *light.animation;
    const float step = kStepShare * float(sceneSizeMetres);
    switch (way.kind) {
    case scenes::LightAnimationKind::Orbit: {
        changed |= dragVector("Centre", way.centerWS, step, kMostMetres);
        glm::dvec3 axisWS = way.axisWS;
        if (dragVector("Axis", axisWS, 0.01f, kMostDirection)) {
            way.axisWS = scenes::directionOf(axisWS).value_or(way.axisWS);
            changed = true;
        }
        break;
    }
    case scenes::LightAnimationKind::Wobble:
        changed |= dragVector("Amplitude", way.amplitudeMetres, step, kMostMetres);
        break;
    case scenes::LightAnimationKind::Path:
        changed |= pathRows(light, sceneSizeMetres);
        break;
    case scenes::LightAnimationKind::Keyframes:
        return changed; // shown below, with the keys of other members
    }
    return periodRows(*light.animation) || changed;
}

} // namespace

bool lightLifeRows(scenes::Light& light, double timeSeconds, double sceneSizeMetres) {
    const scenes::LightTypeInfo& type = scenes::infoOf(light.type);
    bool changed = false;
    bool moves = light.animation || !light.keyframes.empty();
    if (moves || type.hasPosition()) {
        row("Moves");
        if (ImGui::Checkbox("by itself", &moves)) {
            constexpr double kPeriodSeconds = 6.0;
            if (moves)
                orbitLight(light, kFirstWayShare * sceneSizeMetres, kPeriodSeconds, timeSeconds);
            else
                stopLight(light, timeSeconds);
            changed = true;
        }
        tip("Off: it stays as it is now, without keys");
    }
    if (light.animation && type.hasPosition()) changed |= wayRows(light, timeSeconds, sceneSizeMetres);
    for (const scenes::LightKeyedInfo& member : scenes::keyedMembers()) {
        const bool isPosition = member.member == scenes::LightKeyed::Position;
        if (isPosition && keysOf(light, member.member) == nullptr && light.animation) continue; // another path type
        if (member.isOf(type)) changed |= keyRows(light, member, timeSeconds, sceneSizeMetres);
    }
    return changed;
}

} // namespace tessera::viewer
