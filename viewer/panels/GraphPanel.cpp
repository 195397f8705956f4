#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

void passes(const graph::Plan& plan) {
    for (const graph::Plan::Pass& pass : plan.passes) {
        ImGui::BulletText("%s", pass.name.c_str());
        ImGui::Indent();
        if (!pass.reads.empty()) paragraph(fmt::format("reads {}", fmt::join(pass.reads, ", ")));
        if (!pass.writes.empty()) paragraph(fmt::format("writes {}", fmt::join(pass.writes, ", ")));
        ImGui::Unindent();
    }
}

void resources(const graph::Plan& plan) {
    for (const graph::Plan::Resource& resource : plan.resources) {
        std::string text = fmt::format("{}  {}", resource.name, resource.format);
        if (resource.width > 0) text += fmt::format("  {}x{}", resource.width, resource.height);
        if (resource.samples > 1) text += fmt::format("  {} samples", resource.samples);
        if (resource.bytes) text += "  " + graph::readableBytes(*resource.bytes);
        if (!resource.aliasOf.empty()) text += "  in the memory of " + resource.aliasOf;
        ImGui::Bullet();
        paragraph(text);
    }
    paragraph(fmt::format("{} in all, {} if none shared memory", graph::readableBytes(plan.bytes),
                          graph::readableBytes(plan.bytesWithoutAliasing)));
}

void leftOut(const graph::Plan& plan) {
    for (const graph::Plan::LeftOut& item : plan.leftOut) {
        const std::string saved = item.bytes > 0 ? fmt::format(" ({})", graph::readableBytes(item.bytes)) : "";
        ImGui::Bullet();
        paragraph(fmt::format("{}{}: {}", item.what, saved, item.why));
    }
}

void choices(const graph::Plan& plan) {
    for (const graph::Plan::Choice& choice : plan.choices) {
        ImGui::Bullet();
        paragraph(fmt::format("{}: {}; {}", choice.what, choice.chosen, choice.why));
    }
    for (const auto& [name, count] : plan.counters) fact(name.c_str(), fmt::format("{}", count));
}

void part(const char* title, bool open, const graph::Plan& plan, void (*draw)(const graph::Plan&)) {
    if (!ImGui::TreeNodeEx(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
    draw(plan);
    ImGui::TreePop();
}

} // namespace

void graphPanel(State& state, const Facts& facts) {
    state.wantsPlan = true;
    if (!facts.plan) return;
    part("Passes", true, *facts.plan, passes);
    part("Resources", false, *facts.plan, resources);
    part("Left out, and why", true, *facts.plan, leftOut);
    part("Choices", false, *facts.plan, choices);
}

} // namespace tessera::viewer
