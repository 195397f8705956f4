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

/// Whether an edit is complete, or one of many that the same drag of a handle or a slider makes.
enum class Gesture : std::uint8_t { Once, GoesOn };

/// The edits of a scene since it was opened, all of them, in order: those that were made, then those that were undone
/// and can be redone. A new edit of the scene takes the place of the latter. One of the camera does not: where one
/// looks from changes nothing of them.
class History {
public:
    /// Exchanges what the scene has and what the edit holds. What it throws passes through; nothing has changed then.
    using Exchange = std::function<void(Edit& edit)>;

    /// Takes up an edit that was just made. One that continues a gesture is part of the gesture's first, of the same
    /// element: that one is kept, with the new text.
    void keep(std::string what, Edit edit, Gesture gesture = Gesture::Once);
    /// The gesture is over: what comes next is another step.
    void endGesture() { isOpen_ = false; }
    bool isGestureOpen() const { return isOpen_; }
    /// The edit that a gesture which goes on would continue; null: it would be a step of its own.
    const Edit* continued(const Edit& edit, Gesture gesture) const;

    /// What the next undo or redo takes back or brings back, as the user is told; null: there is none.
    const std::string* undoText() const { return position_ > 0 ? &steps_[position_ - 1].what : nullptr; }
    const std::string* redoText() const { return position_ < steps_.size() ? &steps_[position_].what : nullptr; }
    /// Undoes or redoes one step. Null where there is none; else the edit, after the exchange.
    const Edit* undo(const Exchange& exchange);
    const Edit* redo(const Exchange& exchange);
    std::size_t undoable() const { return position_; }
    std::size_t redoable() const { return steps_.size() - position_; }

    /// The scene was saved as it is now.
    void markSaved();
    /// No saved scene is what this one was opened as.
    void markUnsaved() { saved_.reset(); }
    /// Whether the scene is as it was saved, or opened.
    bool isSaved() const { return saved_ == version(); }
    /// Steps to the scene as it was saved, or as it was opened where it never was: negative ones are undone, positive
    /// ones redone. None where no step leads there: another edit has taken the place of those.
    std::optional<std::ptrdiff_t> stepsToSaved() const;

    /// Calls `change` with the edit of each step.
    void forEach(const std::function<void(Edit& edit)>& change) {
        for (Step& step : steps_) change(step.edit);
    }
    /// Whether all edits are so.
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
    std::size_t position_ = 0; ///< steps that are done
    bool isOpen_ = false;      ///< the latest step's gesture goes on
    Version latest_ = 0;
    std::optional<Version> saved_ = 0;
};

} // namespace tessera::viewer
