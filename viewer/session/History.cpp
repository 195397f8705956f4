#include "viewer/session/History.h"

#include <cstdlib>
#include <utility>

namespace tessera::viewer {

const Edit* History::continued(const Edit& edit, Gesture gesture) const {
    if (gesture == Gesture::Once || !isOpen_ || position_ == 0) return nullptr;
    const Edit& latest = steps_[position_ - 1].edit;
    return areOfOneElement(latest, edit) ? &latest : nullptr;
}

void History::keep(std::string what, Edit edit, Gesture gesture) {
    if (continued(edit, gesture) != nullptr) {
        Step& step = steps_[position_ - 1];
        step.what = std::move(what);
        if (step.makes) step.makes = ++latest_;
        return;
    }
    std::optional<Version> makes;
    if (changesScene(edit)) {
        makes = ++latest_;
        steps_.erase(steps_.begin() + std::ptrdiff_t(position_), steps_.end());
    }
    steps_.insert(steps_.begin() + std::ptrdiff_t(position_), Step{std::move(what), std::move(edit), makes});
    ++position_;
    isOpen_ = gesture == Gesture::GoesOn;
}

const Edit* History::undo(const Exchange& exchange) {
    endGesture();
    if (position_ == 0) return nullptr;
    Edit& edit = steps_[position_ - 1].edit;
    exchange(edit);
    --position_;
    return &edit;
}

const Edit* History::redo(const Exchange& exchange) {
    endGesture();
    if (position_ == steps_.size()) return nullptr;
    Edit& edit = steps_[position_].edit;
    exchange(edit);
    ++position_;
    return &edit;
}

void History::markSaved() {
    endGesture(); // later edits of the same gesture are not saved
    saved_ = version();
}

std::optional<std::ptrdiff_t> History::stepsToSaved() const {
    std::optional<std::ptrdiff_t> nearest;
    for (std::size_t i = 0; i <= steps_.size(); ++i) {
        const std::ptrdiff_t steps = std::ptrdiff_t(i) - std::ptrdiff_t(position_);
        if (saved_.value_or(0) == versionAt(i) && (!nearest || std::abs(steps) < std::abs(*nearest))) nearest = steps;
    }
    return nearest;
}

History::Version History::versionAt(std::size_t position) const {
    while (position > 0 && !steps_[position - 1].makes) --position;
    return position > 0 ? *steps_[position - 1].makes : 0;
}

} // namespace tessera::viewer
