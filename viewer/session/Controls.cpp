#include "viewer/session/Controls.h"

#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>

#include "viewer/session/Keys.h"

namespace tessera::viewer {
namespace {

constexpr float kDividerReach = 6.0f;   ///< screen coordinates to either side that grab it
constexpr double kZoomPerStep = 0.88;   ///< of the distance, a step of the wheel
constexpr double kZoomPerHeight = 0.05; ///< of the distance, a drag of the picture's height upwards

glm::vec2 fromCenter(const glm::vec2& point, const PictureArea& area) {
    return point - area.corner - 0.5f * area.size;
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

void Controls::handle(std::span<const InputEvent> events, State& state, const PictureArea& area, const Claims& claims) {
    for (const InputEvent& event : events) {
        switch (event.kind) {
        case InputEvent::Kind::Move:
            move(event, state, area);
            break;
        case InputEvent::Kind::Button:
            move(event, state, area);
            event.down ? press(event, state, area, claims) : release(event);
            break;
        case InputEvent::Kind::Scroll:
            if (!claims.mouse && state.open && area.contains(event.position))
                state.open->rig().zoom(std::pow(kZoomPerStep, double(event.scroll.y)), fromCenter(event.position, area),
                                       area.size.y);
            break;
        case InputEvent::Kind::Key:
            key(event, state, claims);
            break;
        case InputEvent::Kind::Focus:
            if (!event.down) {
                flying_ = {};
                drag_ = Drag::None;
            }
            break;
        case InputEvent::Kind::Character:
            break;
        }
    }
    if (state.open) state.open->rig().hold(flying_);
}

void Controls::press(const InputEvent& event, State& state, const PictureArea& area, const Claims& claims) {
    if (drag_ != Drag::None || claims.mouse || !area.contains(event.position)) return;
    button_ = event.code;
    if (event.code == GLFW_MOUSE_BUTTON_MIDDLE) {
        drag_ = Drag::Pan;
    } else if (event.code == GLFW_MOUSE_BUTTON_LEFT) {
        const float dividerX = area.corner.x + state.divider * area.size.x;
        if (state.compare == Compare::Split && std::abs(event.position.x - dividerX) <= kDividerReach) {
            drag_ = Drag::Divider;
        } else if (event.modifiers & GLFW_MOD_ALT) {
            drag_ = Drag::Pan;
        } else if (event.modifiers & GLFW_MOD_CONTROL) {
            drag_ = Drag::Zoom;
        } else {
            drag_ = Drag::Rotate;
        }
    }
}

void Controls::release(const InputEvent& event) {
    if (event.code == button_) drag_ = Drag::None;
}

void Controls::move(const InputEvent& event, State& state, const PictureArea& area) {
    const glm::dvec2 moved = event.position - pointer_;
    pointer_ = event.position;
    if (!state.open || moved == glm::dvec2(0.0) || area.size.y < 1.0f) return;
    CameraRig& rig = state.open->rig();
    switch (drag_) {
    case Drag::None:
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
    case Drag::Divider:
        state.divider = std::clamp((event.position.x - area.corner.x) / area.size.x, 0.0f, 1.0f);
        break;
    }
}

void Controls::key(const InputEvent& event, State& state, const Claims& claims) {
    // Keys that are let go are heard even while text is typed, so that none stays held.
    bool* held = flyKey(flying_, event.code);
    const bool commands = (event.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)) != 0;
    if (held != nullptr) *held = event.down && !claims.keyboard && !commands;
    if (!event.down || event.repeated || claims.keyboard) return;
    pressKey(state, event.code, event.modifiers);
}

} // namespace tessera::viewer
