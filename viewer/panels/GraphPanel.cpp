#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

/// The name of a resource; a click shows its contents.
void link(State& state, const graph::Plan& plan, const std::string& name) {
    const bool isShown = state.resource.name == name;
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
    const bool isClicked = ImGui::Selectable(labelOf(name).c_str(), isShown);
    ImGui::PopStyleColor();
    tip("Shows its contents");
    if (!isClicked) return;
    state.resource.show(isShown ? std::string() : name);
    const auto resource = std::ranges::find(plan.resources, name, &graph::Plan::Resource::name);
    // Radiance spans many orders of magnitude.
    state.resource.isCurved =
        resource != plan.resources.end() && (resource->format == "RGBA32F" || resource->format == "RGBA16F");
}

void links(State& state, const graph::Plan& plan, const char* verb, std::span<const std::string> names) {
    ImGui::PushID(verb);
    for (const std::string& name : names) {
        ImGui::TextDisabled("%s", verb);
        ImGui::SameLine();
        link(state, plan, name);
    }
    ImGui::PopID();
}

void passes(State& state, const graph::Plan& plan) {
    for (const graph::Plan::Pass& pass : plan.passes) {
        ImGui::PushID(&pass);
        ImGui::BulletText("%s", pass.name.c_str());
        ImGui::Indent();
        links(state, plan, "reads", pass.reads);
        links(state, plan, "writes", pass.writes);
        ImGui::Unindent();
        ImGui::PopID();
    }
}

void resourceRows(State& state, const graph::Plan& plan, const graph::Plan::Resource& resource) {
    ImGui::Bullet();
    link(state, plan, resource.name);
    std::string text(resource.format);
    if (resource.width > 0) text += fmt::format("  {}x{}", resource.width, resource.height);
    if (resource.samples > 1) text += fmt::format("  {} samples", resource.samples);
    if (resource.bytes) text += "  " + graph::readableBytes(*resource.bytes);
    if (!resource.aliasOf.empty()) text += "  in the memory of " + resource.aliasOf;
    ImGui::Indent(2.0f * ImGui::GetFontSize());
    paragraph(text);
    ImGui::Unindent(2.0f * ImGui::GetFontSize());
}

/// Textures first: they are inspected more often.
void resources(State& state, const graph::Plan& plan) {
    for (const bool areTextures : {true, false})
        for (const graph::Plan::Resource& resource : plan.resources)
            if ((resource.width > 0) == areTextures) resourceRows(state, plan, resource);
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
