#include "viewer/session/DrawnLook.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/AreaLight.h"
#include "viewer/edit/LightList.h"

namespace tessera::viewer {
namespace {

/// About the illuminance in lux of what faces the light; of lights that fall off by A, B and C in their own unit.
double illuminanceAt(const scenes::Light& light, const glm::dvec3& positionWS) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const glm::dvec3 weights(0.2126, 0.7152, 0.0722); // Rec. ITU-R BT.709, of luminance
    const double strength = glm::dot(weights, glm::dvec3(light.color)) * double(light.intensity);
    if (!info.hasPosition()) return strength;
    const glm::dvec3 awayWS = positionWS - light.positionWS;
    const double metres = glm::length(awayWS);
    if (metres > double(light.rangeMetres)) return 0.0;
    const bool isInCone = light.type != scenes::LightType::Spot || metres == 0.0 ||
                          glm::dot(awayWS / metres, light.directionWS) >= std::cos(double(light.outerConeRadians));
    if (!isInCone) return 0.0;
    if (light.falloff == scenes::Falloff::Attenuation) {
        const glm::dvec3 by(light.attenuation);
        return strength / (by.x + by.y * metres + by.z * metres * metres);
    }
    const double area = info.isArea ? scenes::largestSeenArea(light) : 1.0; // of radiance, else candela
    constexpr double kNearestMetres = 0.01;
    const double nearest = std::max(metres, kNearestMetres);
    return strength * area / (nearest * nearest);
}

std::string viewName(const Look& look, const std::vector<scenes::Light>* lights) {
    std::string name(frame::debugViewInfo(look.settings.view).name);
    const std::optional<int> solo = look.settings.soloLight;
    const bool isNamed = lights != nullptr && solo && showsTermOfOne(look.settings.view) && *solo >= 0 &&
                         std::size_t(*solo) < lights->size(); // it may have been deleted since
    return isNamed ? name + " of " + lightLabel(*lights, std::size_t(*solo)) : name;
}

} // namespace

bool showsTermOfOne(frame::DebugView view) {
    return view == frame::DebugView::Distribution || view == frame::DebugView::Geometry ||
           view == frame::DebugView::Fresnel;
}

std::optional<int> brightestAt(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS,
                               double timeSeconds) {
    std::optional<int> brightest;
    double most = 0.0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!lights[i].enabled) continue;
        const double here = illuminanceAt(scenes::lightAtTime(lights[i], timeSeconds), positionWS);
        if (!(here > most)) continue;
        most = here;
        brightest = int(i);
    }
    return brightest;
}

Look drawnLook(const State& state, int side) {
    Look look = state.looks[std::size_t(side)];
    if (!state.open || look.settings.soloLight || !showsTermOfOne(look.settings.view)) return look;
    const std::vector<scenes::Light>& lights = state.open->scene().lights;
    const auto selected = std::size_t(state.selectedLight);
    if (state.selectedLight != scenes::kNone && selected < lights.size() && lights[selected].enabled) {
        look.settings.soloLight = state.selectedLight;
    } else {
        const CameraPose& home = state.open->rig().home(); // not where it is now: the light would change on the way
        look.settings.soloLight = brightestAt(lights, home.eyeWS + home.focusMetres * home.heading.forwardWS(), 0.0);
    }
    return look;
}

std::string lookName(const Look& look, const std::vector<scenes::Light>* lights) {
    return fmt::format("{} / {}", infoOf(look.technique).name, viewName(look, lights));
}

std::array<std::string, 2> sideNames(const Look& left, const Look& right, const std::vector<scenes::Light>* lights) {
    const std::array<const Look*, 2> looks{&left, &right};
    std::array<std::string, 2> names, others;
    for (const engine::Setting& setting : engine::settingTable()) {
        const bool isNamed = setting.key == "technique" || setting.key == "view"; // below
        if (isNamed || setting.isShared || setting.value.equal(left, right)) continue;
        if (std::holds_alternative<engine::SizeKind>(setting.value.kind)) continue; // of pictures that are on their way
        for (std::size_t side : {0u, 1u})
            if (setting.isHeededBy(looks[side]->technique))
                others[side] += fmt::format(", {} {}", setting.name, setting.text(*looks[side]));
    }
    const bool differs = left.technique != right.technique || !others[0].empty() || !others[1].empty();
    const bool namesView = !differs || left.settings.view != right.settings.view;
    for (std::size_t side : {0u, 1u})
        names[side] = (namesView ? lookName(*looks[side], lights) : std::string(infoOf(looks[side]->technique).name)) +
                      others[side];
    return names;
}

} // namespace tessera::viewer
