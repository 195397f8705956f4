#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "renderer/graph/Plan.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

void plot(const char* id, const std::vector<float>& values, float height) {
    if (values.empty()) return;
    const float most = *std::max_element(values.begin(), values.end());
    ImGui::PlotLines(id, values.data(), int(values.size()), 0, nullptr, 0.0f, std::max(1.15f * most, 1e-3f),
                     {ImGui::GetContentRegionAvail().x, height});
}

std::string milliseconds(const std::optional<double>& ms) {
    return ms ? fmt::format("{:.1f}", *ms) : "-";
}

void passTable(const Timings& timings, int side, const TypicalTimes& typical) {
    if (!ImGui::BeginTable("passes", 4, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("GPU ms", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("CPU ms", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (const gpu::PassTiming& pass : typical.passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(pass.name.c_str());
        tip(pass.name);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(milliseconds(pass.gpuMs).c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(milliseconds(pass.cpuMs).c_str());
        ImGui::TableNextColumn();
        plot(("##" + pass.name).c_str(), timings.passMs(side, pass.name), ImGui::GetFontSize());
    }
    ImGui::EndTable();
}

} // namespace

void timingsPanel(State& state, const Facts& facts) {
    const int side = state.activeSide;
    const FrameTimes* frame = state.timings.latest(side);
    if (frame == nullptr) return;
    const std::optional<TypicalTimes> typical = state.timings.typical(side);
    fact("Frame", fmt::format("{:.1f} ms at scale {:.3g}", typical->ms, frame->scale));
    tip("The median of pictures like the latest: of its size, technique, view and settings");
    fact("Median of", fmt::format("{} picture{}, the latest {:.1f} ms", typical->frames,
                                  typical->frames == 1 ? "" : "s", frame->ms));
    plot("##frames", state.timings.frameMs(side), 3.0f * ImGui::GetFontSize());
    passTable(state.timings, side, *typical);
    fact("Targets", graph::readableBytes(facts.targetBytes));
    tip("Textures and buffers that frames share");
    ImGui::TextDisabled("%s", facts.renderer.c_str());
}

} // namespace tessera::viewer
