#include <fmt/format.h>
#include <imgui.h>

#include "renderer/graph/Plan.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {

void cullingPanel(State& state, const Facts& facts) {
    Look& look = state.active();
    const bool isShown = look.settings.view == frame::DebugView::Lights;
    if (ImGui::Button(isShown ? "Show the picture" : "Show the lights a pixel visits"))
        look.settings.view = isShown ? frame::DebugView::Final : frame::DebugView::Lights;
    if (ImGui::Button("Measure tightness")) state.requests.measureLights = true;
    tip("Counts, with every light tried at every pixel, at a quarter of the size");
    if (!facts.lights) return;
    const validation::LightOracleFigures& figures = *facts.lights;
    const std::optional<double> tightness = figures.tightness();
    fact("Measured", facts.lightsOf);
    fact("Visited", fmt::format("{:.2f} a pixel", figures.perPixel(figures.evaluated + figures.everywhere)));
    fact("at most", fmt::format("{}, p99 {}", figures.evaluatedMax, figures.evaluatedP99));
    fact("Needed", fmt::format("{:.2f} a pixel, {:.2f} lit", figures.perPixel(figures.needed),
                               figures.perPixel(figures.neededLit)));
    fact("Tightness", tightness ? fmt::format("{:.3f}", *tightness) : "no light ends");
    tip("Visited / needed of the lights that end somewhere: 1 is perfect");
    fact("Lists", fmt::format("{} entries, {}", figures.entries, graph::readableBytes(figures.listBytes)));
    fact("Missed", fmt::format("{}", figures.falseNegatives));
    tip("Lights that a pixel needed and did not visit: must be 0");
}

} // namespace tessera::viewer
