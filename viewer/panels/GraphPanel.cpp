#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

void passes(State&, const graph::Plan& plan) {
    for (const graph::Plan::Pass& pass : plan.passes) {
        ImGui::BulletText("%s", pass.name.c_str());
        ImGui::Indent();
        if (!pass.reads.empty()) paragraph(fmt::format("reads {}", fmt::join(pass.reads, ", ")));
        if (!pass.writes.empty()) paragraph(fmt::format("writes {}", fmt::join(pass.writes, ", ")));
        ImGui::Unindent();
    }
}

/// A click on the name shows what the resource holds.
void resourceRows(State& state, const graph::Plan::Resource& resource) {
    const bool isShown = state.resource.name == resource.name;
    ImGui::Bullet();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark)); // as a link
    const bool isClicked = ImGui::Selectable(labelOf(resource.name).c_str(), isShown);
    ImGui::PopStyleColor();
    if (isClicked) {
        state.resource.show(isShown ? std::string() : resource.name);
        // Light, of many magnitudes.
        state.resource.isCurved = resource.format == "RGBA32F" || resource.format == "RGBA16F";
    }
    tip("Shows what it holds");
    std::string text(resource.format);
    if (resource.width > 0) text += fmt::format("  {}x{}", resource.width, resource.height);
    if (resource.samples > 1) text += fmt::format("  {} samples", resource.samples);
    if (resource.bytes) text += "  " + graph::readableBytes(*resource.bytes);
    if (!resource.aliasOf.empty()) text += "  in the memory of " + resource.aliasOf;
    ImGui::Indent(2.0f * ImGui::GetFontSize());
    paragraph(text);
    ImGui::Unindent(2.0f * ImGui::GetFontSize());
}

/// Textures first, which more people look at.
void resources(State& state, const graph::Plan& plan) {
    for (const bool areTextures : {true, false})
        for (const graph::Plan::Resource& resource : plan.resources)
            if ((resource.width > 0) == areTextures) resourceRows(state, resource);
    paragraph(fmt::format("{} in all, {} if none shared memory", graph::readableBytes(plan.bytes),
                          graph::readableBytes(plan.bytesWithoutAliasing)));
}

void leftOut(State&, const graph::Plan& plan) {
    for (const graph::Plan::LeftOut& item : plan.leftOut) {
        const std::string saved = item.bytes > 0 ? fmt::format(" ({})", graph::readableBytes(item.bytes)) : "";
        ImGui::Bullet();
        paragraph(fmt::format("{}{}: {}", item.what, saved, item.why));
    }
}

void choices(State&, const graph::Plan& plan) {
    for (const graph::Plan::Choice& choice : plan.choices) {
        ImGui::Bullet();
        paragraph(fmt::format("{}: {}; {}", choice.what, choice.chosen, choice.why));
    }
    for (const auto& [name, count] : plan.counters) fact(name.c_str(), fmt::format("{}", count));
}

void part(const char* title, bool open, State& state, const graph::Plan& plan,
          void (*draw)(State&, const graph::Plan&)) {
    if (!ImGui::TreeNodeEx(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
    draw(state, plan);
    ImGui::TreePop();
}

} // namespace

void graphPanel(State& state, const Facts& facts) {
    state.wantsPlan = true;
    if (!facts.plan) return;
    part("Resources", true, state, *facts.plan, resources);
    part("Passes", false, state, *facts.plan, passes);
    part("Left out, and why", true, state, *facts.plan, leftOut);
    part("Choices", false, state, *facts.plan, choices);
}

} // namespace tessera::viewer
