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
    tip("Heat colours: how many lights the technique tries at each pixel");
    if (ImGui::Button("Measure tightness")) state.requests.measureLights = true;
    tip("Counts, with every light tried at every pixel, at a quarter of the size");
    if (!facts.lights) return;
    const validation::LightOracleFigures& figures = *facts.lights;
    Look now = look;
    now.settings.sizePixels = facts.lightsLook->settings.sizePixels;
    now.settings.view = facts.lightsLook->settings.view;
    fact("Measured", now == *facts.lightsLook ? facts.lightsOf : "before settings changed: " + facts.lightsOf);
    const auto perPixel = [&](std::uint64_t pairs) { return fmt::format("{:.4g} a pixel", figures.perPixel(pairs)); };
    fact("All lights", perPixel(figures.evaluated + figures.everywhere));
    tip("Lights that a pixel visits");
    fact("Most", fmt::format("{}, p99 {}", figures.evaluatedMax, figures.evaluatedP99));
    fact("Without range", perPixel(figures.everywhere));
    tip("Lights that reach everywhere: every pixel needs them, so that none can be culled");
    if (figures.evaluated + figures.needed == 0) {
        fact("Tightness", "no light to cull");
        tip("Visited / needed of the lights that end somewhere: no pixel visits or needs one");
    } else {
        const std::optional<double> tightness = figures.tightness();
        fact("Visited", perPixel(figures.evaluated));
        tip("Of the lights that end somewhere");
        fact("Needed", perPixel(figures.needed));
        tip("Of the lights that end somewhere: those that reach the surface");
        fact("Lit in front", perPixel(figures.neededLit));
        tip("Those that also shine on the surface's front");
        fact("Tightness", tightness ? fmt::format("{:.3g}", *tightness) : "none is needed");
        tip("Visited / needed: 1 is perfect");
    }
    fact("Lists", fmt::format("{} entries, {}", figures.entries, graph::readableBytes(figures.listBytes)));
    fact("Missed", fmt::format("{}", figures.falseNegatives));
}

} // namespace tessera::viewer
