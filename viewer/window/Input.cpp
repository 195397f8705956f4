#include "viewer/window/Input.h"

#include <algorithm>

namespace tessera::viewer {
namespace {

bool isSwitch(const InputEvent& event) {
    return event.kind == InputEvent::Kind::Button || event.kind == InputEvent::Kind::Key;
}

/// Whether one frame can hold `next` after `taken`.
bool fits(const std::vector<InputEvent>& taken, const InputEvent& next) {
    const auto any = [&](auto&& conflicts) { return std::any_of(taken.begin(), taken.end(), conflicts); };
    if (next.kind == InputEvent::Kind::Move || next.kind == InputEvent::Kind::Scroll)
        return !any([](const InputEvent& event) { return event.kind == InputEvent::Kind::Button; });
    if (isSwitch(next))
        return !any([&](const InputEvent& event) { return event.kind == next.kind && event.code == next.code; });
    return true;
}

} // namespace

void InputQueue::push(const InputEvent& event) {
    // Of a pointer on its way only the end counts; how far it went follows from where it was.
    if (event.kind == InputEvent::Kind::Move && !events_.empty() && events_.back().kind == InputEvent::Kind::Move &&
        events_.back().modifiers == event.modifiers) {
        const double heardSeconds = events_.back().heardSeconds; // the path has waited since it began
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

std::vector<InputEvent> InputQueue::takeFrame() {
    std::vector<InputEvent> taken;
    while (!events_.empty() && fits(taken, events_.front())) {
        taken.push_back(events_.front());
        events_.pop_front();
    }
    return taken;
}

} // namespace tessera::viewer
