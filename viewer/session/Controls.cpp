#include "viewer/session/Controls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <GLFW/glfw3.h>

#include "viewer/edit/LightList.h"
#include "viewer/edit/NumberText.h"
#include "viewer/session/Keys.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr float kDividerReach = 6.0f; ///< grab distance to either side, screen coordinates
constexpr float kPanelReach = 4.0f;   ///< the same inside the image's left edge, for the panels' edge
constexpr float kMarkerReach = 9.0f;  ///< the same around a light's marker and its handles
constexpr float kClickReach = 3.0f;   ///< largest movement of the pointer during a click
constexpr double kDoubleClickSeconds = 0.4;
constexpr double kTurnPerHeight = 180.0; ///< rotation of the environment in degrees, per drag of the image height
constexpr double kZoomPerHeight = 0.05;  ///< distance factor, per upward drag of the image height

glm::vec2 fromCenter(const glm::vec2& point, const PictureArea& area) {
    return point - area.corner - 0.5f * area.size;
}

bool isEmpty(const PictureArea& area) {
    return area.size.x < 1.0f || area.size.y < 1.0f;
}

bool hasSelectedLight(const State& state) {
    return state.open && state.selectedLight >= 0 && state.selectedLight < int(state.open->scene().lights.size());
}

scenes::Light lightShown(const State& state, int index) {
    return scenes::lightAtTime(state.open->scene().lights[std::size_t(index)], state.looks[0].settings.timeSeconds);
}

/// The light whose marker is under the pointer; the selected light takes precedence.
int markedLight(const State& state, const PictureArea& area, const glm::vec2& point) {
    if (!state.open || isEmpty(area)) return scenes::kNone;
    for (const LightMarker& marker : lightMarkers(state, area))
        if (glm::distance(area.corner + glm::vec2(marker.place), point) <= kMarkerReach * area.scale)
            return marker.light;
    return scenes::kNone;
}

std::string turnText(float degrees) {
    return "Environment " + numberText("%.1f\xc2\xb0", degrees);
}

bool* flyKey(FlyKeys& keys, int key) {
    switch (key) {
    case GLFW_KEY_W:
        return &keys.forward;
    case GLFW_KEY_S:
        return &keys.back;
    case GLFW_KEY_A:
        return &keys.left;
    case GLFW_KEY_D:
        return &keys.right;
    case GLFW_KEY_Q:
        return &keys.down;
    case GLFW_KEY_E:
        return &keys.up;
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
        return &keys.fast;
    default:
        return nullptr;
    }
}

} // namespace

bool PictureArea::contains(const glm::vec2& point) const {
    const glm::vec2 inside = point - corner;
    return inside.x >= 0.0f && inside.y >= 0.0f && inside.x < size.x && inside.y < size.y;
}

PictureArea partOf(const State& state, const PictureArea& area, int side) {
    if (state.compare != Compare::Split) return area;
    const float left = state.divider * area.size.x;
    if (side == 0) return {area.corner, {left, area.size.y}, area.scale};
    return {area.corner + glm::vec2(left, 0.0f), {area.size.x - left, area.size.y}, area.scale};
}

glm::vec2 placeAt(const State& state, const PictureArea& area, const glm::vec2& point) {
    return state.magnification.placeAt((point - area.corner) / area.size);
}

glm::vec2 pointOf(const State& state, const PictureArea& area, const glm::vec2& place) {
    return area.corner + state.magnification.shareOf(place) * area.size;
}

PictureView viewOf(const State& state, const PictureArea& area) {
    return {state.open->scene().cameras[std::size_t(state.open->camera())], area.size};
}

std::optional<LightFigure> selectedFigure(const State& state, const PictureArea& area) {
    if (!hasSelectedLight(state) || isEmpty(area) || state.magnification.isOn()) return std::nullopt;
    return lightFigure(lightShown(state, state.selectedLight), viewOf(state, area), area.scale);
}

std::vector<LightMarker> lightMarkers(const State& state, const PictureArea& area) {
    constexpr double kSunInset = 16.0, kFirstSun = 48.0, kSunStep = 32.0; // from the right edge, and downwards
    const Lights& lights = state.open->scene().lights;
    const PictureView view = viewOf(state, area);
    std::vector<LightMarker> markers;
    if (state.magnification.isOn()) return markers;
    const auto mark = [&](int index) {
        const scenes::Light light = lightShown(state, index);
        if (!scenes::infoOf(light.type).hasPosition()) return;
        if (const auto place = view.placeOf(light.positionWS)) markers.push_back({index, *place});
    };
    if (hasSelectedLight(state)) mark(state.selectedLight);
    std::size_t count = 0;
    for (const int index : state.allSelectedLights())
        if (index != state.selectedLight && index < int(lights.size()) && ++count <= kMostMarkers) mark(index);
    if (!state.showsMarkers) return markers;
    double sunY = kFirstSun * area.scale;
    for (int index = 0; index < int(std::min(lights.size(), kMostMarkers)); ++index) {
        const bool isSun = !scenes::infoOf(lights[std::size_t(index)].type).hasPosition();
        if (!isSun && !state.isLightSelected(index)) mark(index);
        if (!isSun || sunY + kSunInset * area.scale > double(area.size.y)) continue;
        markers.push_back({index, {double(area.size.x) - kSunInset * area.scale, sunY}, true});
        sunY += kSunStep * area.scale;
    }
    return markers;
}

std::vector<LightFigure> otherFigures(const State& state, const PictureArea& area) {
    std::vector<LightFigure> figures;
    if (!hasSelectedLight(state) || isEmpty(area)) return figures;
    const PictureView view = viewOf(state, area);
    for (const int index : state.allSelectedLights()) {
        if (index == state.selectedLight || index >= int(state.open->scene().lights.size())) continue;
        if (figures.size() == kMostFigures) break;
        figures.push_back(lightFigure(lightShown(state, index), view, area.scale));
    }
    return figures;
}

std::optional<LightHandle> handleUnder(const State& state, const PictureArea& area, const glm::vec2& point) {
    const std::optional<LightFigure> figure = selectedFigure(state, area);
    if (!figure) return std::nullopt;
    const glm::dvec2 place = point - area.corner;
    const auto found = handleAt(figure->handles, place, kMarkerReach * area.scale);
    if (!found) return std::nullopt;
    const LightHandle& handle = figure->handles[*found];
    const auto marker = figure->sun ? std::nullopt : viewOf(state, area).placeOf(figure->middleWS);
    if (marker && glm::distance(*marker, place) <= glm::distance(handle.place, place)) return std::nullopt;
    return handle;
}

bool isAtDivider(const State& state, const PictureArea& area, const glm::vec2& point) {
    const float dividerX = area.corner.x + state.divider * area.size.x;
    return state.compare == Compare::Split && area.contains(point) &&
           std::abs(point.x - dividerX) <= kDividerReach * area.scale;
}

bool isAtPanelEdge(const State& state, const PictureArea& area, const glm::vec2& point) {
    return state.showsPanel && area.contains(point) && point.x - area.corner.x < kPanelReach * area.scale;
}

void Controls::handle(std::span<const InputEvent> events, State& state, const PictureArea& area, const Claims& claims) {
    for (const InputEvent& event : events) {
        switch (event.kind) {
        case InputEvent::Kind::Move:
            move(event, state, area);
            break;
        case InputEvent::Kind::Button:
            move(event, state, area);
            event.down ? press(event, state, area, claims) : release(event, state, area);
            break;
        case InputEvent::Kind::Scroll:
            if (!claims.mouse && state.open && area.contains(event.position)) scroll(event, state, area);
            break;
        case InputEvent::Kind::Key:
            key(event, state, claims);
            break;
        case InputEvent::Kind::Focus:
            if (!event.down) {
                flying_ = {};
                endDrag(state);
            }
            break;
        case InputEvent::Kind::Character:
            break;
        }
    }
    if (state.open) state.open->rig().hold(flying_);
    const bool isPointed = state.inspects && !claims.mouse && !isEmpty(area) && area.contains(pointer_);
    state.pointedPlace = isPointed ? std::optional(placeAt(state, area, pointer_)) : std::nullopt;
    if (isPointed) state.pinnedPlace.reset();
}

void Controls::scroll(const InputEvent& event, State& state, const PictureArea& area) {
    if ((event.modifiers & GLFW_MOD_CONTROL) == 0 && !state.magnification.isOn())
        return state.open->rig().wheel(double(event.scroll.y), fromCenter(event.position, area), area.size.y);
    const int steps = event.scroll.y > 0.0f ? 1 : event.scroll.y < 0.0f ? -1 : 0;
    state.magnification.zoom(steps, (event.position - area.corner) / area.size);
}

void Controls::press(const InputEvent& event, State& state, const PictureArea& area, const Claims& claims) {
    if (drag_ != Drag::None || claims.mouse || state.hasDialog() || !area.contains(event.position)) return;
    button_ = event.code;
    pressedAt_ = event.position;
    const bool isOfPicture = !isAtPanelEdge(state, area, event.position) && !isAtDivider(state, area, event.position);
    if (state.magnification.isOn() && isOfPicture) {
        drag_ = Drag::Magnified;
    } else if (event.code == GLFW_MOUSE_BUTTON_MIDDLE) {
        drag_ = Drag::Pan;
    } else if (event.code == GLFW_MOUSE_BUTTON_RIGHT) {
        if (!(event.modifiers & GLFW_MOD_SHIFT)) {
            drag_ = Drag::Pan;
        } else if (state.open && state.open->scene().environment) {
            drag_ = Drag::Environment;
            state.dragText = turnText(state.open->environmentView().rotationDegrees);
        }
    } else if (event.code == GLFW_MOUSE_BUTTON_LEFT) {
        if (isAtPanelEdge(state, area, event.position)) {
            drag_ = Drag::PanelEdge;
            state.isPanelEdgeHeld = true;
        } else if (isAtDivider(state, area, event.position)) {
            drag_ = Drag::Divider;
            state.isDividerHeld = true;
        } else if (event.modifiers & GLFW_MOD_ALT) {
            drag_ = Drag::Pan;
        } else if (event.modifiers & GLFW_MOD_CONTROL) {
            drag_ = Drag::Zoom;
        } else if (const auto handle = handleUnder(state, area, event.position)) {
            takeHandle(*handle, state, area, event.position);
        } else if (const int light = markedLight(state, area, event.position); light != scenes::kNone) {
            drag_ = Drag::Light;
            state.selectedLight = light;
        } else {
            drag_ = Drag::Rotate;
        }
    }
    state.isDragging = drag_ != Drag::None;
}

void Controls::release(const InputEvent& event, State& state, const PictureArea& area) {
    if (event.code != button_) return;
    const bool isLeft = drag_ == Drag::Rotate || (drag_ == Drag::Magnified && button_ == GLFW_MOUSE_BUTTON_LEFT);
    const bool isClick = isLeft && glm::distance(event.position, pressedAt_) <= kClickReach * area.scale;
    if (isClick && area.size.x > 0.0f) click(event, state, area);
    endDrag(state);
}

void Controls::click(const InputEvent& event, State& state, const PictureArea& area) {
    const glm::vec2 place = placeAt(state, area, event.position);
    const bool isSecond = clicked_ && event.heardSeconds - clicked_->heardSeconds <= kDoubleClickSeconds &&
                          glm::distance(event.position, clicked_->place) <= kClickReach * area.scale;
    if (isSecond) {
        state.requests.turnAbout = place;
        clicked_.reset();
    } else {
        state.requests.pick = place;
        clicked_ = {event.position, event.heardSeconds};
    }
}

void Controls::endDrag(State& state) {
    drag_ = Drag::None;
    handle_.reset();
    state.isDragging = state.isDividerHeld = state.isPanelEdgeHeld = false;
    state.heldHandle.reset();
    state.dragText.clear();
    if (state.open) state.open->endGesture();
}

void Controls::takeHandle(const LightHandle& handle, State& state, const PictureArea& area, const glm::vec2& point) {
    drag_ = Drag::Handle;
    handledLight_ = state.selectedLight;
    const scenes::Light& light = state.open->scene().lights[std::size_t(handledLight_)];
    handle_.emplace(light, *selectedFigure(state, area), handle, viewOf(state, area), point - area.corner);
    state.heldHandle = handle.number;
    state.dragText = handle_->text(light, state.active().settings.timeSeconds);
}

void Controls::dragHandle(State& state, const PictureArea& area, const glm::vec2& point) {
    // The light may have been deleted by Del, or the scene replaced.
    if (state.selectedLight != handledLight_ || !hasSelectedLight(state)) return endDrag(state);
    scenes::Light light = state.open->scene().lights[std::size_t(handledLight_)];
    const bool isOneSided = flying_.fast; // Shift
    const double timeSeconds = state.active().settings.timeSeconds;
    handle_->drag(light, timeSeconds, viewOf(state, area), point - area.corner, isOneSided);
    state.dragText = handle_->text(light, timeSeconds);
    state.open->changeLight(std::size_t(handledLight_), std::move(light), Gesture::GoesOn);
}

void Controls::move(const InputEvent& event, State& state, const PictureArea& area) {
    const glm::dvec2 moved = event.position - pointer_;
    pointer_ = event.position;
    if (drag_ == Drag::PanelEdge) {
        constexpr float kMostShare = 0.8f; // of the window's width: some of the image stays visible
        const float most = std::min(kMostPanelWidth, kMostShare * (area.corner.x + area.size.x) / area.scale);
        state.panelWidth =
            std::clamp(std::round(pointer_.x / area.scale), kLeastPanelWidth, std::max(most, kLeastPanelWidth));
        return;
    }
    if (!state.open || moved == glm::dvec2(0.0) || isEmpty(area)) return;
    CameraRig& rig = state.open->rig();
    switch (drag_) {
    case Drag::None:
    case Drag::PanelEdge:
        break;
    case Drag::Rotate:
        rig.rotate(moved, area.size.y);
        break;
    case Drag::Pan:
        rig.pan(moved, area.size.y);
        break;
    case Drag::Zoom:
        rig.zoom(std::pow(kZoomPerHeight, -moved.y / area.size.y), glm::dvec2(0.0), area.size.y);
        break;
    case Drag::Light: {
        if (!hasSelectedLight(state)) break;
        const auto index = std::size_t(state.selectedLight);
        scenes::Light light = state.open->scene().lights[index];
        moveLight(light, state.active().settings.timeSeconds, rig.pose(), rig.start(), moved, area.size.y);
        state.open->changeLight(index, std::move(light), Gesture::GoesOn);
        break;
    }
    case Drag::Handle:
        dragHandle(state, area, event.position);
        break;
    case Drag::Environment: {
        scenes::EnvironmentView view = state.open->environmentView();
        const double degrees = double(view.rotationDegrees) + kTurnPerHeight * moved.x / area.size.y;
        view.rotationDegrees = float(std::remainder(degrees, 360.0));
        viewEnvironment(state, view, Gesture::GoesOn);
        state.dragText = turnText(state.open->environmentView().rotationDegrees);
        break;
    }
    case Drag::Magnified:
        state.magnification.pan(glm::vec2(moved) / area.size);
        break;
    case Drag::Divider:
        state.divider = std::clamp((event.position.x - area.corner.x) / area.size.x, 0.0f, 1.0f);
        break;
    }
}

void Controls::key(const InputEvent& event, State& state, const Claims& claims) {
    // Key releases are processed even while text is typed, so that no key stays held.
    bool* held = flyKey(flying_, event.code);
    const bool commands = (event.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)) != 0;
    if (held != nullptr) *held = event.down && !claims.keyboard && !commands && !state.hasDialog();
    if (!event.down || event.repeated) return;
    // Keys that abbreviate words are identified by their letter, others by their position: W A S D.
    const int written = event.letter != 0 ? event.letter : event.code;
    if (state.question) {
        for (const AnswerChoice& choice : answersTo(state.question->about))
            if (choice.key == written && !commands) state.requests.answer = choice.answer;
        return;
    }
    if (state.files) {
        if (event.code == GLFW_KEY_ESCAPE) state.files.reset();
        return;
    }
    if (claims.keyboard) return;
    pressKey(state, (event.modifiers & GLFW_MOD_CONTROL) != 0 ? written : event.code, event.modifiers);
}

} // namespace tessera::viewer
