#include "viewer/session/Edits.h"

#include <span>

#include <fmt/format.h>

namespace tessera::viewer {
namespace {

using scenes::Light;
using scenes::Material;

/// The first row that holds describes the change.
template <typename Element>
struct ChangeVerb {
    const char* verb;
    bool (*holds)(const Element& before, const Element& after);
};

/// Whether the light stays in place: moving a light also moves its path (placeLight()).
bool isInPlace(const Light& before, const Light& after) {
    return before.positionWS == after.positionWS;
}

constexpr ChangeVerb<Light> kLightVerbs[] = {
    {"rename", [](const Light& a, const Light& b) { return a.name != b.name; }},
    {"change type of", [](const Light& a, const Light& b) { return a.type != b.type; }},
    {"switch on", [](const Light& a, const Light& b) { return !a.enabled && b.enabled; }},
    {"switch off", [](const Light& a, const Light& b) { return a.enabled && !b.enabled; }},
    {"stop",
     [](const Light& a, const Light& b) {
         return (a.animation && !b.animation) || (!a.keyframes.empty() && b.keyframes.empty());
     }},
    {"change keyframes of",
     [](const Light& a, const Light& b) {
         const bool areKeyed = a.animation && b.animation && a.animation->kind == b.animation->kind;
         if (a.directionWS != b.directionWS) return false; // turned by hand, which removes direction keys
         return a.keyframes != b.keyframes || (areKeyed && isInPlace(a, b) && a.animation->keys != b.animation->keys);
     }},
    {"change path of",
     [](const Light& a, const Light& b) {
         if (!a.animation || !b.animation || a.animation == b.animation) return false;
         return isInPlace(a, b) || a.animation->kind != b.animation->kind;
     }},
    {"colour", [](const Light& a, const Light& b) { return a.color != b.color; }},
    {"change intensity of", [](const Light& a, const Light& b) { return a.intensity != b.intensity; }},
    {"resize",
     [](const Light& a, const Light& b) {
         return a.radiusMetres != b.radiusMetres || a.angularRadiusRadians != b.angularRadiusRadians ||
                a.widthMetres != b.widthMetres || a.heightMetres != b.heightMetres ||
                a.lengthMetres != b.lengthMetres || !(a.corners == b.corners);
     }},
    {"animate", [](const Light& a, const Light& b) { return !a.animation && b.animation; }},
    {"change flicker of", [](const Light& a, const Light& b) { return a.flicker != b.flicker; }},
    {"move",
     [](const Light& a, const Light& b) { return a.positionWS != b.positionWS || !(a.animation == b.animation); }},
    {"turn", [](const Light& a, const Light& b) { return a.directionWS != b.directionWS || a.alongWS != b.alongWS; }},
};

constexpr ChangeVerb<Material> kMaterialVerbs[] = {
    {"change model of", [](const Material& a, const Material& b) { return a.model != b.model; }},
    {"colour", [](const Material& a, const Material& b) { return glm::vec3(a.baseColor) != glm::vec3(b.baseColor); }},
    {"change opacity of",
     [](const Material& a, const Material& b) {
         return a.baseColor.w != b.baseColor.w || a.alphaMode != b.alphaMode || a.alphaCutoff != b.alphaCutoff;
     }},
    {"change emission of", [](const Material& a, const Material& b) { return a.emissive != b.emissive; }},
    {"change subsurface scattering of",
     [](const Material& a, const Material& b) { return !(a.subsurface == b.subsurface); }},
};

template <typename Element>
const char* verbOf(std::span<const ChangeVerb<Element>> verbs, const Element& before, const Element& after) {
    for (const ChangeVerb<Element>& row : verbs)
        if (row.holds(before, after)) return row.verb;
    return "change";
}

} // namespace

bool areOfOneElement(const Edit& first, const Edit& second) {
    if (const auto* a = std::get_if<LightsEdit>(&first)) {
        const auto* b = std::get_if<LightsEdit>(&second);
        const auto changesAll = [](const LightsEdit& edit) {
            return edit.count > 0 && edit.count == edit.others.size();
        };
        return b != nullptr && changesAll(*a) && changesAll(*b) && a->first == b->first && a->count == b->count;
    }
    if (const auto* a = std::get_if<HookEdit>(&first)) {
        const auto* b = std::get_if<HookEdit>(&second);
        return b != nullptr && a->parameter == b->parameter;
    }
    if (std::holds_alternative<EnvironmentViewEdit>(first)) return std::holds_alternative<EnvironmentViewEdit>(second);
    if (std::holds_alternative<CameraEdit>(first)) return std::holds_alternative<CameraEdit>(second);
    const auto* a = std::get_if<MaterialEdit>(&first);
    const auto* b = std::get_if<MaterialEdit>(&second);
    return a != nullptr && b != nullptr && a->index == b->index;
}

std::string changeText(const Light& before, const Light& after, const std::string& label) {
    return fmt::format("{} light '{}'", verbOf<Light>(kLightVerbs, before, after), label);
}

std::string changeText(const Light& before, const Light& after, std::size_t count) {
    return fmt::format("{} {} lights", verbOf<Light>(kLightVerbs, before, after), count);
}

std::string changeText(const Material& before, const Material& after, const std::string& label) {
    return fmt::format("{} material '{}'", verbOf<Material>(kMaterialVerbs, before, after), label);
}

std::string changeText(const scenes::EnvironmentView& before, const scenes::EnvironmentView& after) {
    return before.intensity != after.intensity ? "change intensity of the environment" : "turn the environment";
}

} // namespace tessera::viewer
