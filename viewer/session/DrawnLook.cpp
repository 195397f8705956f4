#include "viewer/session/DrawnLook.h"

#include <fmt/format.h>

#include "renderer/frame/DebugViews.h"
#include "shaders/shared/heat.h"
#include "viewer/edit/Brightness.h"
#include "viewer/edit/LightList.h"

namespace tessera::viewer {

std::string viewName(const Look& look, const std::vector<scenes::Light>* lights) {
    std::string name(frame::debugViewInfo(look.settings.view).name);
    const std::optional<int> solo = look.settings.soloLight;
    const bool isNamed = lights != nullptr && solo && showsTermOfOne(look.settings.view) && *solo >= 0 &&
                         std::size_t(*solo) < lights->size(); // it may have been deleted since
    return isNamed ? name + " of " + lightLabel(*lights, std::size_t(*solo)) : name;
}

std::string viewMeaning(frame::DebugView view, bool isLit) {
    // The viewer selects the light itself, and the image's title names it.
    const char* const light = isLit ? "; the panel Lights selects another" : "; no light is on";
    switch (view) {
    case frame::DebugView::Distribution:
        return fmt::format("D: how many microfacets mirror the light towards the eye{}", light);
    case frame::DebugView::Geometry:
        return fmt::format("G: the share of microfacets that light and eye both reach, past their neighbours{}", light);
    case frame::DebugView::Fresnel:
        return fmt::format("F: the share of the light that microfacets reflect, by colour{}", light);
    default:
        return std::string(frame::debugViewInfo(view).meaning);
    }
}

bool showsTermOfOne(frame::DebugView view) {
    return view == frame::DebugView::Distribution || view == frame::DebugView::Geometry ||
           view == frame::DebugView::Fresnel;
}

bool showsCounts(const Look& look) {
    return frame::displayMapping(look.settings.view, look.settings.layout) == frame::DisplayMapping::Count;
}

float countColorsLog2(const State& state, const Facts& facts, int side, frame::DebugView view) {
    const std::optional<float> most = facts.mostCountOf(side, view);
    return state.fitsCountColors && most ? shared::heatScaleLog2(*most) : float(frame::countScaleLog2(view));
}

Look drawnLook(const State& state, int side) {
    Look look = state.looks[std::size_t(side)];
    if (!state.open || look.settings.soloLight || !showsTermOfOne(look.settings.view)) return look;
    const std::vector<scenes::Light>& lights = state.open->scene().lights;
    const auto selected = std::size_t(state.selectedLight);
    if (state.selectedLight != scenes::kNone && selected < lights.size() && lights[selected].enabled) {
        look.settings.soloLight = state.selectedLight;
    } else {
        const CameraPose& home = state.open->rig().home(); // not the current pose: moving would change the light
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
        const bool isNamed = setting.key == "technique" || setting.key == "view"; // handled below
        if (isNamed || setting.isShared || setting.value.equal(left, right)) continue;
        if (std::holds_alternative<engine::SizeKind>(setting.value.kind)) continue; // of pending images
        for (std::size_t side : {0u, 1u})
            if (setting.isUsedBy(looks[side]->technique))
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
