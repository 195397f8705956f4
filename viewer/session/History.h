#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/session/Edits.h"

namespace tessera::viewer {

/// Whether an edit is complete, or one of many from the same drag of a handle or a slider.
enum class Gesture : std::uint8_t { Once, GoesOn };

/// All edits of a scene since it was opened, in order: done ones, then undone ones that can be redone. A new edit of
/// the scene discards the latter; an edit of the camera does not, because it leaves the scene unchanged.
class History {
public:
    /// Exchanges the values of the scene and of the edit. Exceptions pass through; nothing has changed then.
    using Exchange = std::function<void(Edit& edit)>;

    /// Records an edit that was just made. One that continues a gesture on the same element merges with the gesture's
    /// first edit: that one is kept, with the new text.
    void keep(std::string what, Edit edit, Gesture gesture = Gesture::Once);
    /// Ends the gesture: the next edit is another step.
    void endGesture() { isOpen_ = false; }
    bool isGestureOpen() const { return isOpen_; }
    /// The edit that the next edit of a gesture would continue; null: it would be a separate step.
    const Edit* continued(const Edit& edit, Gesture gesture) const;

    /// Description of the next undo or redo for the user; null: there is none.
    const std::string* undoText() const { return position_ > 0 ? &steps_[position_ - 1].what : nullptr; }
    const std::string* redoText() const { return position_ < steps_.size() ? &steps_[position_].what : nullptr; }
    /// Undoes or redoes one step. Returns the edit after the exchange; null if there is none.
    const Edit* undo(const Exchange& exchange);
    const Edit* redo(const Exchange& exchange);
    std::size_t undoable() const { return position_; }
    std::size_t redoable() const { return steps_.size() - position_; }

    /// Marks the current state as saved.
    void markSaved();
    /// No state counts as saved any more, not even the initial one.
    void markUnsaved() { saved_.reset(); }
    /// Whether the scene is as it was last saved or opened.
    bool isSaved() const { return saved_ == version(); }
    /// Steps to the saved state, or to the initial one if it was never saved: negative ones are undone, positive ones
    /// redone. None if no step leads there, because another edit has discarded them.
    std::optional<std::ptrdiff_t> stepsToSaved() const;

    /// Calls `change` with the edit of each step.
    void forEach(const std::function<void(Edit& edit)>& change) {
        for (Step& step : steps_) change(step.edit);
    }
    /// Whether the predicate holds for all edits.
    bool allOf(const std::function<bool(const Edit& edit)>& isSo) const {
        return std::ranges::all_of(steps_, [&](const Step& step) { return isSo(step.edit); });
    }

private:
    /// A state of the scene: equal numbers, equal scenes.
    using Version = std::uint64_t;
    struct Step {
        std::string what;
        Edit edit;
        std::optional<Version> makes; ///< none: the scene stays the same
    };
    Version versionAt(std::size_t position) const;
    Version version() const { return versionAt(position_); }

    std::vector<Step> steps_;
    std::size_t position_ = 0; ///< number of done steps
    bool isOpen_ = false;      ///< the latest step's gesture continues
    Version latest_ = 0;
    std::optional<Version> saved_ = 0;
};

} // namespace tessera::viewer
