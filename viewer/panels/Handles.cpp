#include "viewer/panels/Handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <GLFW/glfw3.h>
#include <imgui.h>

namespace tessera::viewer {
namespace {

constexpr ImU32 kFigureInk = IM_COL32(140, 195, 255, 230), kHeldInk = IM_COL32(255, 205, 60, 255);
constexpr ImU32 kUnderInk = IM_COL32(20, 20, 24, 160);    ///< keeps lines visible on white
constexpr ImU32 kRangeInk = IM_COL32(140, 195, 255, 110); ///< of ranges, and of other selected lights
/// Of the move arms along x, y and z.
constexpr ImU32 kArmInks[] = {IM_COL32(240, 80, 75, 255), IM_COL32(95, 205, 75, 255), IM_COL32(65, 110, 255, 255)};
constexpr float kHandleRadius = 4.5f, kLineWidth = 1.5f, kUnderWidth = 3.5f;

/// Earlier versions lack slanting arrows, and Dear ImGui then shows the plain one, without a direction.
constexpr bool kHasSlantingArrows = GLFW_VERSION_MAJOR > 3 || (GLFW_VERSION_MAJOR == 3 && GLFW_VERSION_MINOR >= 4);

ImGuiMouseCursor cursorOf(PointerShape shape) {
    switch (shape) {
    case PointerShape::LeftRight:
        return ImGuiMouseCursor_ResizeEW;
    case PointerShape::UpDown:
        return ImGuiMouseCursor_ResizeNS;
    case PointerShape::Falling:
        return kHasSlantingArrows ? ImGuiMouseCursor_ResizeNWSE : ImGuiMouseCursor_Hand;
    case PointerShape::Rising:
        return kHasSlantingArrows ? ImGuiMouseCursor_ResizeNESW : ImGuiMouseCursor_Hand;
    case PointerShape::AnyWay:
        break;
    }
    return ImGuiMouseCursor_Hand;
}

/// Draws at image positions, clipped to the image.
class PictureInk {
public:
    explicit PictureInk(const PictureArea& area) : area_(area), list_(*ImGui::GetBackgroundDrawList()) {
        const glm::vec2 end = area.corner + area.size;
        list_.PushClipRect({area.corner.x, area.corner.y}, {end.x, end.y});
    }
    ~PictureInk() { list_.PopClipRect(); }
    PictureInk(const PictureInk&) = delete;
    PictureInk& operator=(const PictureInk&) = delete;

    void faintLine(const glm::dvec2& from, const glm::dvec2& to) {
        list_.AddLine(at(from), at(to), kRangeInk, kLineWidth * area_.scale);
    }
    void line(const glm::dvec2& from, const glm::dvec2& to) {
        list_.AddLine(at(from), at(to), kUnderInk, kUnderWidth * area_.scale);
        list_.AddLine(at(from), at(to), kFigureInk, kLineWidth * area_.scale);
    }
    /// Drawn for all contours first, so that none covers another's ink.
    void underContour(const std::vector<ImVec2>& points) { contour(points, kUnderInk, kUnderWidth); }
    void inkContour(const std::vector<ImVec2>& points) { contour(points, kFigureInk, kLineWidth); }
    /// A square, or a circle for the light's direction.
    void handle(const LightHandle& handle, bool isPointed) {
        const ImVec2 place = at(handle.place);
        const auto fill = [&](float radius, ImU32 ink) {
            if (handle.turns())
                list_.AddCircleFilled(place, radius, ink);
            else
                list_.AddRectFilled({place.x - radius, place.y - radius}, {place.x + radius, place.y + radius}, ink);
        };
        fill((kHandleRadius + 1.0f) * area_.scale, kUnderInk);
        fill(kHandleRadius * area_.scale, isPointed ? kHeldInk : kFigureInk);
    }
    /// An arm, beginning outside the marker.
    void arm(const glm::dvec2& middle, const LightHandle& handle, bool isPointed) {
        constexpr double kMarkerRadius = 12.0, kHeadLength = 6.0, kHeadHalfWidth = 5.0;
        const ImU32 ink = kArmInks[handle.arm];
        const glm::dvec2 from = middle + kMarkerRadius * double(area_.scale) * handle.way;
        list_.AddLine(at(from), at(handle.place), kUnderInk, kUnderWidth * area_.scale);
        list_.AddLine(at(from), at(handle.place), ink, kLineWidth * area_.scale);
        const auto head = [&](double grown, ImU32 headInk) { // clockwise, as antialiasing requires
            const double scale = double(area_.scale);
            const glm::dvec2 along = (kHeadLength + grown) * scale * handle.way;
            const glm::dvec2 across = (kHeadHalfWidth + grown) * scale * glm::dvec2(-handle.way.y, handle.way.x);
            list_.AddTriangleFilled(at(handle.place + along), at(handle.place - along + across),
                                    at(handle.place - along - across), headInk);
        };
        head(1.5, kUnderInk);
        head(0.0, isPointed ? kHeldInk : ink);
    }
    void sun(const glm::dvec2& place) {
        constexpr int kRays = 8;
        constexpr double kRadius = 8.0, kRaysBegin = 11.0, kRaysEnd = 15.0;
        const double scale = area_.scale;
        list_.AddCircle(at(place), float(kRadius * scale), kFigureInk, 0, kLineWidth * area_.scale);
        for (int ray = 0; ray < kRays; ++ray) {
            const double angle = 2.0 * std::numbers::pi * ray / kRays;
            const glm::dvec2 way(std::cos(angle), std::sin(angle));
            line(place + kRaysBegin * scale * way, place + kRaysEnd * scale * way);
        }
    }

    ImVec2 at(const glm::dvec2& place) const {
        return {area_.corner.x + float(place.x), area_.corner.y + float(place.y)};
    }

private:
    void contour(const std::vector<ImVec2>& points, ImU32 ink, float width) {
        list_.AddPolyline(points.data(), int(points.size()), ink, ImDrawFlags_None, width * area_.scale);
    }

    const PictureArea& area_;
    ImDrawList& list_;
};

/// The handle that is held, else the one that a press would grab.
std::optional<LightHandle> pointedHandle(const State& state, const PictureArea& area, const LightFigure& figure) {
    if (state.heldHandle) {
        const auto held = std::ranges::find(figure.handles, *state.heldHandle, &LightHandle::number);
        return held == figure.handles.end() ? std::nullopt : std::optional(*held);
    }
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 pointer(io.MousePos.x, io.MousePos.y);
    if (io.WantCaptureMouse || ImGui::IsAnyMouseDown() || !area.contains(pointer)) return std::nullopt;
    return handleUnder(state, area, pointer);
}

/// Clamped to the image, even if the pointer has left it.
void drawBesidePointer(const std::string& text, const PictureArea& area) {
    const float pad = 5.0f * area.scale, beside = 16.0f * area.scale;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pointer = ImGui::GetIO().MousePos;
    const glm::vec2 end = area.corner + area.size;
    const float x = std::max(std::min(pointer.x + beside, end.x - size.x - 2.0f * pad), area.corner.x + pad);
    const float y = std::max(std::min(pointer.y + beside, end.y - size.y - 2.0f * pad), area.corner.y + pad);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({area.corner.x, area.corner.y}, {end.x, end.y});
    list.AddRectFilled({x - pad, y - pad}, {x + size.x + pad, y + size.y + pad}, IM_COL32(20, 21, 24, 200),
                       ImGui::GetStyle().FrameRounding);
    list.AddText({x, y}, IM_COL32(220, 222, 228, 255), text.c_str());
    list.PopClipRect();
}

} // namespace

void drawHandles(const State& state, const PictureArea& area) {
    const std::optional<LightFigure> figure = selectedFigure(state, area);
    if (!figure) return;
    const PictureView view = viewOf(state, area);
    PictureInk ink(area);
    const auto draw = [&](const std::vector<std::vector<glm::dvec3>>& outlinesWS, auto drawLine) {
        for (const std::vector<glm::dvec3>& outlineWS : outlinesWS)
            for (std::size_t i = 1; i < outlineWS.size(); ++i)
                if (const auto line = view.lineBetween(outlineWS[i - 1], outlineWS[i]))
                    (ink.*drawLine)(line->first, line->second);
    };
    for (const LightFigure& other : otherFigures(state, area)) {
        draw(other.rangeWS, &PictureInk::faintLine);
        draw(other.outlinesWS, &PictureInk::faintLine);
    }
    draw(figure->rangeWS, &PictureInk::faintLine);
    draw(figure->outlinesWS, &PictureInk::line);
    if (figure->sun) ink.sun(*figure->sun);
    const std::optional<LightHandle> pointed = pointedHandle(state, area, *figure);
    const auto isPointed = [&](const LightHandle& handle) { return pointed && pointed->number == handle.number; };
    if (const auto middle = view.placeOf(figure->middleWS)) // below the others, which an arm may cross
        for (const LightHandle& handle : figure->handles)
            if (handle.moves()) ink.arm(*middle, handle, isPointed(handle));
    for (const LightHandle& handle : figure->handles)
        if (!handle.moves()) ink.handle(handle, isPointed(handle));
    if (!pointed) return;
    ImGui::SetMouseCursor(cursorOf(pointerShapeOf(*pointed)));
    if (const std::string hint = hintOf(*pointed); !state.heldHandle && !hint.empty()) drawBesidePointer(hint, area);
}

void drawMaterialOutline(const State& state, const Facts& facts, const PictureArea& area) {
    if (state.magnification.isOn() || !state.showsMaterial || !facts.materialOutline ||
        facts.materialOutline->material != state.selectedMaterial)
        return;
    PictureInk ink(area);
    const glm::dvec2 scale = glm::dvec2(area.size) / glm::dvec2(facts.materialOutline->sizePixels);
    std::vector<std::vector<ImVec2>> lines;
    for (const Contour& contour : facts.materialOutline->contours) {
        std::vector<ImVec2>& points = lines.emplace_back();
        for (const glm::vec2& place : contour) points.push_back(ink.at(glm::dvec2(place) * scale));
    }
    for (const std::vector<ImVec2>& points : lines) ink.underContour(points);
    for (const std::vector<ImVec2>& points : lines) ink.inkContour(points);
}

void drawDragText(const State& state, const PictureArea& area) {
    if (state.dragText.empty()) return;
    if (!state.heldHandle) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW); // the environment is being rotated
    drawBesidePointer(state.dragText, area);
}

} // namespace tessera::viewer
