#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

void compareRows(State& state) {
    static constexpr Choice kCompare[] = {{"off", "One picture"},
                                          {"split", "Two pictures with a divider to drag"},
                                          {"difference", "How much the two differ, amplified"}};
    const std::size_t now = std::size_t(state.compare);
    if (const auto chosen = choose("Compare", kCompare[now].name, kCompare, now)) state.compare = Compare(*chosen);
    if (state.compare == Compare::Off) return;
    row("Active side");
    constexpr const char* kMeaning = "Panels and keys set the technique, view and options of this side (Z)";
    ImGui::RadioButton("left", &state.activeSide, 0);
    tip(kMeaning);
    ImGui::SameLine();
    ImGui::RadioButton("right", &state.activeSide, 1);
    tip(kMeaning);
    if (state.compare == Compare::Split) {
        slider("Divider", state.divider, 0.0f, 1.0f, "%.2f");
    } else {
        row("Amplified");
        edit(state.amplification, 1.0f, 1e6f,
             [](float& times) { return slideNumber("##Amplified", times, 1.0f, 1e6f, "%.0f x", true); });
    }
}

std::string figure(double value) {
    return std::isnan(value) ? "-" : fmt::format("{:.3g}", value);
}

/// A click inspects the pixel with the largest error.
void worstRow(State& state, const validation::ErrorFigures& figures, glm::ivec2 sizePixels) {
    fact("max rel", fmt::format("{} at {}, {}", figure(figures.maxRel), figures.worstX, figures.worstY));
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (ImGui::IsItemClicked() && sizePixels.x > 0 && sizePixels.y > 0) {
        state.inspects = true;
        state.pinnedPlace = (glm::vec2(figures.worstX, figures.worstY) + 0.5f) / glm::vec2(sizePixels);
    }
    tip("Click to inspect that pixel");
}

void figureRows(State& state, const validation::ErrorFigures& figures, glm::ivec2 sizePixels) {
    fact("Bit-equal", fmt::format("{:.4f} % of {} pixels", 100.0 * figures.bitEqual, figures.covered));
    fact("relMse", figure(figures.relMse));
    fact("median rel", figure(figures.p50Rel));
    fact("p99 rel", fmt::format("{}, p99.9 {}", figure(figures.p99Rel), figure(figures.p999Rel)));
    worstRow(state, figures, sizePixels);
    fact("max abs", figure(figures.maxAbs));
    fact("rmse", figure(figures.rmse));
    fact("bias", figure(figures.bias));
    fact("FLIP", figures.flip ? figure(*figures.flip) : figures.flipReason);
    fact("PSNR", figures.psnr ? fmt::format("{:.1f} dB", *figures.psnr) : figures.psnrReason);
    fact("Bad pixels",
         fmt::format("{} NaN, {} inf, {} negative", figures.bad.nan, figures.bad.infinite, figures.bad.negative));
}

} // namespace

void comparePanel(State& state, const Facts& facts) {
    compareRows(state);
    if (state.compare == Compare::Off) return;
    const char* const until = facts.isCancelled ? ", not measured" : facts.figuresAreOld ? ", measuring ..." : "";
    ImGui::TextDisabled("Left against right%s", until);
    if (!facts.figures) return;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, facts.figuresAreOld ? 0.5f : 1.0f);
    figureRows(state, *facts.figures, facts.sizePixels);
    ImGui::PopStyleVar();
}

} // namespace tessera::viewer
