#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viewer/session/FieldLetters.h"

namespace tessera::viewer {

/// An entry of the dialog's list.
struct FileEntry {
    std::string name;
    bool isFolder = false;
    std::string meaning = {}; ///< of built-in scenes
    bool operator==(const FileEntry&) const = default;
};

/// A dialog for choosing a file to open, or a name to save under; it only reads folders. Typed text is a path, relative
/// to the shown folder, from "/" or from "~/". When opening, the text after the last separator limits the list to names
/// that begin with it.
class FileDialog {
public:
    enum class Purpose : std::uint8_t { Open, Save };

    /// `text` is the initial name, `reason` why a name is needed. If the folder has nothing to open, the built-in
    /// scenes are shown.
    FileDialog(Purpose purpose, const std::filesystem::path& folder, std::string text = {}, std::string reason = {});

    Purpose purpose() const { return purpose_; }
    const std::string& reason() const { return reason_; }
    /// The listed folder; none: the built-in scenes.
    const std::optional<std::filesystem::path>& folder() const { return listed_; }
    /// The parent folder, then folders, then files that can be opened or replaced.
    std::span<const FileEntry> entries() const { return entries_; }
    std::optional<std::size_t> chosen() const { return chosen_; } ///< in entries()
    /// Returns once whether an entry was chosen other than by choose(), and must scroll into view.
    bool takeMoved() { return std::exchange(isMoved_, false); }
    const std::string& text() const { return text_; }
    /// Why the folder cannot be read, or what is wrong with the text; empty: nothing.
    const std::string& fault() const { return fault_; }
    /// Whether the named file exists; accept() then needs `replaces` to overwrite it.
    bool confirmsReplacing() const { return confirmsReplacing_; }

    /// Whether keys must wait for the dialog's field. It gets the keyboard some frames after the dialog opens, and
    /// again after Enter or a click; a key pressed in between would be lost. Keys wait at most kMostWaits frames,
    /// because another widget may have the keyboard.
    bool keysWait() const { return !hasKeyboard_ && waits_ < kMostWaits; }
    /// To be called every frame.
    void noteKeyboard(bool hasKeyboard) {
        hasKeyboard_ = hasKeyboard;
        waits_ = hasKeyboard ? 0 : std::min(waits_ + 1, kMostWaits);
    }
    /// Another dialog takes precedence; afterwards the wait starts again.
    void leaveKeyboard() {
        hasKeyboard_ = false;
        waits_ = 0;
    }
    static constexpr int kMostWaits = 10; ///< frames; the field takes up to 4

    void type(const std::string& text);
    /// The text in the form of a text field, and text typed there.
    std::string inField() { return letters_.inField(text_); }
    void typeInField(std::string_view held) { type(letters_.fromField(held)); }
    /// Moves the choice by a number of entries, from the first or the last one if none is chosen.
    void step(int lines);
    void choose(std::size_t entry);
    /// Extends the text to the common prefix of all names that begin with it.
    void complete();
    void goTo(const std::filesystem::path& folder);
    /// Only for opening.
    void showBuiltin();
    /// Enters a chosen or typed folder and returns none, or returns the chosen file or built-in scene. `replaces`
    /// permits overwriting a file.
    std::optional<std::string> accept(bool replaces = false);

private:
    std::filesystem::path resolved(const std::string& text) const;
    void list();
    void enter(const std::filesystem::path& folder);
    std::optional<std::string> acceptText(bool replaces);
    std::optional<std::string> acceptName(bool replaces);

    Purpose purpose_;
    std::filesystem::path folder_;                ///< absolute; typed paths are relative to it
    bool isBuiltin_ = false;                      ///< the built-in scenes are shown instead
    std::optional<std::filesystem::path> listed_; ///< `folder_` joined with the folder part of the text
    std::string text_, reason_, fault_;
    FieldLetters letters_; ///< of the names it showed
    std::vector<FileEntry> entries_;
    std::optional<std::size_t> chosen_;
    bool isChosenByHand_ = false; ///< takes precedence over the text
    bool isMoved_ = false;        ///< takeMoved()
    bool confirmsReplacing_ = false;
    bool hasKeyboard_ = false;
    int waits_ = 0; ///< frames since the field lost the keyboard
};

/// The user's home folder; none if the environment does not define it.
std::optional<std::filesystem::path> homeFolder();

/// Folders of files without duplicates, in order.
std::vector<std::string> foldersOf(std::span<const std::string> files);

} // namespace tessera::viewer
