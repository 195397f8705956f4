#include "viewer/window/Input.h"

#include <algorithm>

#include <GLFW/glfw3.h>

namespace tessera::viewer {
namespace {

bool isSwitch(const InputEvent& event) {
    return event.kind == InputEvent::Kind::Button || event.kind == InputEvent::Kind::Key;
}

/// Whether it is a key press, or the character that it writes.
bool isKeyPress(const InputEvent& event) {
    return (event.kind == InputEvent::Kind::Key && event.down) || event.kind == InputEvent::Kind::Character;
}

/// Shift, Ctrl, Alt and Super.
bool isModifier(const InputEvent& event) {
    return event.kind == InputEvent::Kind::Key && event.code >= GLFW_KEY_LEFT_SHIFT &&
           event.code <= GLFW_KEY_RIGHT_SUPER;
}

/// Whether modifiers change its meaning.
bool readsModifiers(const InputEvent& event) {
    switch (event.kind) {
    case InputEvent::Kind::Key:
        return event.down && !isModifier(event);
    case InputEvent::Kind::Button:
    case InputEvent::Kind::Scroll:
    case InputEvent::Kind::Character:
        return true;
    case InputEvent::Kind::Move:
    case InputEvent::Kind::Focus:
        break;
    }
    return false;
}

/// Whether it is the press of a key that edits text without writing a character, such as Enter, Tab or an arrow.
bool isEditingKey(const InputEvent& event) {
    return event.kind == InputEvent::Kind::Key && event.down &&
           ((event.code >= GLFW_KEY_ESCAPE && event.code < GLFW_KEY_KP_0) || event.code == GLFW_KEY_KP_ENTER);
}

/// Whether one frame can hold `next` after `taken`.
bool fits(const std::vector<InputEvent>& taken, const InputEvent& next) {
    const auto any = [&](auto&& conflicts) { return std::any_of(taken.begin(), taken.end(), conflicts); };
    if (next.kind == InputEvent::Kind::Move || next.kind == InputEvent::Kind::Scroll)
        return !any([](const InputEvent& event) { return event.kind == InputEvent::Kind::Button; });
    const bool endsDrag = next.kind == InputEvent::Kind::Button && !next.down;
    if (endsDrag && any([](const InputEvent& event) { return event.kind == InputEvent::Kind::Move; })) return false;
    if (isModifier(next) && any(readsModifiers)) return false;
    if (next.kind == InputEvent::Kind::Character) return !any(isEditingKey);
    if (isSwitch(next))
        return !any([&](const InputEvent& event) { return event.kind == next.kind && event.code == next.code; });
    return true;
}

} // namespace

void InputQueue::push(const InputEvent& event) {
    // Merges successive moves: only the end position counts, and the distance follows from the start position.
    if (event.kind == InputEvent::Kind::Move && !events_.empty() && events_.back().kind == InputEvent::Kind::Move &&
        events_.back().modifiers == event.modifiers) {
        const double heardSeconds = events_.back().heardSeconds; // the response time counts from the first one
        events_.back() = event;
        events_.back().heardSeconds = heardSeconds;
        return;
    }
    events_.push_back(event);
}

bool InputQueue::isUrgent() const {
    return std::any_of(events_.begin(), events_.end(), [](const InputEvent& event) {
        return event.kind == InputEvent::Kind::Scroll || (isSwitch(event) && !event.repeated);
    });
}

std::vector<InputEvent> InputQueue::takeFrame(bool keysWait) {
    std::vector<InputEvent> taken;
    while (!events_.empty() && !(keysWait && isKeyPress(events_.front())) && fits(taken, events_.front())) {
        taken.push_back(events_.front());
        events_.pop_front();
    }
    return taken;
}

} // namespace tessera::viewer
