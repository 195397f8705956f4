#include "viewer/panels/ResourceBox.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "renderer/graph/Access.h"
#include "renderer/graph/Plan.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

constexpr Choice kChannels[] = {
    {"colours", "red, green and blue"}, {"red", ""}, {"green", ""}, {"blue", ""}, {"alpha", ""}};
constexpr Choice kWords[] = {{"whole numbers", ""}, {"floats", ""}, {"hexadecimal", ""}};

/// Returns whether another one was chosen.
template <typename Enum>
bool chooseOne(const char* label, Enum& value, std::span<const Choice> choices, std::string_view meaning) {
    const auto chosen = choose(label, choices[std::size_t(value)].name, choices, std::size_t(value), meaning);
    if (chosen) value = Enum(*chosen);
    return chosen.has_value();
}

/// A row that chooses one of several, counted from 0.
void numberRow(const char* label, int& value, int count, std::string_view meaning) {
    if (count < 2) return;
    row(label, meaning);
    slideNumber(fmt::format("##{}", label).c_str(), value, 0, count - 1, "%d");
}

void textureRows(ResourceView& view, const graph::TextureDesc& desc, const NumberRange& range) {
    const graph::FormatInfo& format = graph::formatInfo(desc.format);
    numberRow("Level", view.level, desc.levels, "Each is half as wide and high as the one before");
    numberRow("Layer", view.layer, desc.layers, "Of a cube its sides: +x, -x, +y, -y, +z, -z");
    if (format.components > 1)
        chooseOne("Channels", view.channels, std::span(kChannels).first(std::size_t(format.components) + 1),
                  "What the picture shows; the numbers below it are all of them");
    row("Range", "Numbers that are shown black and white");
    if (ImGui::Checkbox("of the data", &view.fitsRange) && !view.fitsRange) {
        view.least = float(range.least);
        view.most = float(range.most);
    }
    if (!view.fitsRange) {
        glm::dvec3 ends(view.least, view.most, 0.0);
        row("Black, white");
        const double speed = std::max(range.most - range.least, 1e-6) / 200.0;
        if (dragNumbers("##range", ends, 2, float(speed), -1e9, 1e9, "%.4g")) {
            view.least = float(ends.x);
            view.most = float(ends.y);
        }
    } else {
        ImGui::SameLine();
        ImGui::TextDisabled("%.4g to %.4g", range.least, range.most);
    }
    row("Curve");
    ImGui::Checkbox("of sRGB", &view.isCurved);
}

/// Draws the texture in the rest of the window, and the numbers of the texel under the pointer.
void picture(ResourceView& view, const Facts::Resource& resource) {
    const ResourceContents& contents = *resource.contents;
    const glm::vec2 texels(contents.sizeTexels);
    const ImVec2 room = ImGui::GetContentRegionAvail(), at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const glm::vec2 corner(at.x, at.y), size(std::max(room.x, line), std::max(room.y - line, line));
    // The texture is centred in an area of the frame's shape, which is magnified as a whole.
    const glm::vec2 part = texels * std::min(size.x / texels.x, size.y / texels.y) / size, rim = 0.5f * (1.0f - part);
    const auto screenOf = [&](const glm::vec2& share) {
        const glm::vec2 place = corner + size * view.magnification.shareOf(rim + part * share);
        return ImVec2(place.x, place.y);
    };
    // Takes the mouse, so that a drag does not move the window.
    ImGui::InvisibleButton("##picture", {size.x, size.y});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
    list.AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t(resource.picture)), screenOf({0.0f, 0.0f}),
                  screenOf({1.0f, 1.0f}));
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 share = (glm::vec2(io.MousePos.x, io.MousePos.y) - corner) / size;
    if (ImGui::IsItemActive()) view.magnification.pan(glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / size);
    const glm::ivec2 texel(glm::floor((view.magnification.placeAt(share) - rim) / part * texels));
    const bool isOver = ImGui::IsItemHovered() && glm::all(glm::greaterThanEqual(texel, glm::ivec2(0))) &&
                        glm::all(glm::lessThan(texel, contents.sizeTexels));
    const ImVec2 from = screenOf(glm::vec2(texel) / texels), to = screenOf(glm::vec2(texel + 1) / texels);
    constexpr float kSeenPoints = 4.0f; // smaller ones get no outline
    if (isOver && to.x - from.x >= kSeenPoints) list.AddRect(from, to, ImGui::GetColorU32(ImGuiCol_CheckMark));
    list.PopClipRect();
    if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) view.magnification.zoom(io.MouseWheel > 0.0f ? 1 : -1, share);
    const std::string zoom = view.magnification.isOn() ? fmt::format("x {}  ", view.magnification.times) : "";
    if (isOver)
        ImGui::TextUnformatted((zoom + contents.texelText(texel)).c_str());
    else
        ImGui::TextDisabled("%sPoint at a texel; the wheel magnifies", zoom.c_str());
}

void words(ResourceView& view, const ResourceContents& contents) {
    ResourceView::Words as = view.words.value_or(contents.likelyWords());
    if (chooseOne("As", as, kWords, "How the buffer's words of four bytes are read")) view.words = as;
    constexpr float kWordEms = 6.0f; ///< ten digits
    const float columnsFit = ImGui::GetContentRegionAvail().x / (kWordEms * ImGui::GetFontSize());
    // A power of two, so that the numbers at the left are round.
    const auto columns = std::bit_floor(std::size_t(std::clamp(columnsFit - 1.0f, 1.0f, 16.0f)));
    const std::size_t count = contents.words.size();
    if (!ImGui::BeginTable("##words", int(columns) + 1, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) return;
    ImGuiListClipper clipper;
    clipper.Begin(int((count + columns - 1) / columns));
    while (clipper.Step())
        for (int line = clipper.DisplayStart; line < clipper.DisplayEnd; ++line) {
            const std::size_t first = std::size_t(line) * columns;
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%zu", first);
            for (std::size_t i = first; i < first + columns; ++i) {
                ImGui::TableNextColumn();
                if (i < count) ImGui::TextUnformatted(ResourceContents::wordText(contents.words[i], as).c_str());
            }
        }
    ImGui::EndTable();
}

} // namespace

void drawResource(State& state, const Facts& facts, const PictureArea& area) {
    ResourceView& view = state.resource;
    if (view.name.empty()) return;
    const glm::vec2 size = 0.6f * area.size, corner = area.corner + area.size - size;
    ImGui::SetNextWindowPos({corner.x, area.corner.y}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({size.x, size.y}, ImGuiCond_Appearing);
    bool isOpen = true;
    if (ImGui::Begin(fmt::format("{}###resource", labelOf(view.name)).c_str(), &isOpen,
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoFocusOnAppearing)) {
        const bool isRead = facts.resource && facts.resource->contents->name == view.name;
        if (isRead && facts.picturesPerSecond && !view.image)
            ImGui::TextDisabled("Of the last idle image (Space: pause)");
        if (!isRead) {
            paragraph(facts.picturesPerSecond ? "Read when the clip is paused (Space)."
                                              : "Read as soon as the image is idle.");
        } else if (const ResourceContents& contents = *facts.resource->contents; !contents.fault.empty()) {
            paragraph(contents.fault);
        } else if (contents.isTexture()) {
            const auto& desc = std::get<graph::TextureDesc>(contents.desc);
            fact("Texture", fmt::format("{}, {}", graph::formatInfo(desc.format).name, graph::describeSize(desc)));
            textureRows(view, desc, facts.resource->range);
            picture(view, *facts.resource);
        } else {
            const bool isAll = contents.words.size() >= contents.bytes / 4;
            fact("Buffer", fmt::format("{}{}", graph::readableBytes(contents.bytes),
                                       isAll ? "" : fmt::format(", the first {} words", contents.words.size())));
            words(view, contents);
        }
    }
    ImGui::End();
    if (!isOpen) view = {};
}

} // namespace tessera::viewer
