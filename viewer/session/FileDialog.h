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

/// A line of the dialog's list.
struct FileEntry {
    std::string name;
    bool isFolder = false;
    std::string meaning = {}; ///< of built-in scenes
    bool operator==(const FileEntry&) const = default;
};

/// A dialog that asks for a file to open, or for a name to save under; it only reads folders. Typed text names a file
/// by a path, from the folder that is shown, from "/" or from "~/". When opening, text behind the last separator
/// narrows the list to names that begin with it.
class FileDialog {
public:
    enum class Purpose : std::uint8_t { Open, Save };

    /// `text` is the name to begin with, `reason` why a name is asked for. Where there is nothing to open in the
    /// folder, the built-in scenes are shown.
    FileDialog(Purpose purpose, const std::filesystem::path& folder, std::string text = {}, std::string reason = {});

    Purpose purpose() const { return purpose_; }
    const std::string& reason() const { return reason_; }
    /// What the list shows: a folder, or none for the built-in scenes.
    const std::optional<std::filesystem::path>& folder() const { return listed_; }
    /// First the folder above, then folders, then files that can be opened or saved over.
    std::span<const FileEntry> entries() const { return entries_; }
    std::optional<std::size_t> chosen() const { return chosen_; } ///< among them
    /// Once: whether another entry was chosen, other than by choose(), that is to be scrolled to.
    bool takeMoved() { return std::exchange(isMoved_, false); }
    const std::string& text() const { return text_; }
    /// Why the folder cannot be read, or what is wrong with the text; empty: nothing.
    const std::string& fault() const { return fault_; }
    /// The file that the text names is there, and is not written over unless accept() says so.
    bool asksToReplace() const { return asksToReplace_; }

    /// Whether keys are to wait for the dialog's field. It has the keyboard some frames after the dialog opens, and
    /// again some after Enter or a click; a key that came in between would be lost. They wait for kMostWaits frames at
    /// most, as something else may have the keyboard.
    bool keysWait() const { return !hasKeyboard_ && waits_ < kMostWaits; }
    /// In each frame: whether the field has the keyboard.
    void noteKeyboard(bool hasKeyboard) {
        hasKeyboard_ = hasKeyboard;
        waits_ = hasKeyboard ? 0 : std::min(waits_ + 1, kMostWaits);
    }
    /// Something else goes before it, and it begins anew then.
    void leaveKeyboard() {
        hasKeyboard_ = false;
        waits_ = 0;
    }
    static constexpr int kMostWaits = 10; ///< frames; the field takes up to 4

    void type(const std::string& text);
    /// The text as a field of the interface holds it, and what is typed there.
    std::string inField() { return letters_.inField(text_); }
    void typeInField(std::string_view held) { type(letters_.fromField(held)); }
    /// Chooses the entry so many lines on, from the first or the last where none is.
    void step(int lines);
    void choose(std::size_t entry);
    /// Lengthens the text by what all names that begin with it have in common.
    void complete();
    void goTo(const std::filesystem::path& folder);
    /// Only for opening.
    void showBuiltin();
    /// Goes into a folder that is chosen or typed, and returns nothing; or returns the file or built-in scene that is
    /// meant. `replaces` lets a file be written over.
    std::optional<std::string> accept(bool replaces = false);

private:
    std::filesystem::path resolved(const std::string& text) const;
    void list();
    void enter(const std::filesystem::path& folder);
    std::optional<std::string> acceptText(bool replaces);
    std::optional<std::string> acceptName(bool replaces);

    Purpose purpose_;
    std::filesystem::path folder_;                ///< that text counts from; absolute
    bool isBuiltin_ = false;                      ///< the built-in scenes in its place
    std::optional<std::filesystem::path> listed_; ///< `folder_`, and what the text goes on to
    std::string text_, reason_, fault_;
    FieldLetters letters_; ///< of names that it showed
    std::vector<FileEntry> entries_;
    std::optional<std::size_t> chosen_;
    bool isChosenByHand_ = false; ///< and goes before the text
    bool isMoved_ = false;        ///< takeMoved()
    bool asksToReplace_ = false;
    bool hasKeyboard_ = false;
    int waits_ = 0; ///< frames since the field lost the keyboard
};

/// The user's own folder; none where the environment names none.
std::optional<std::filesystem::path> homeFolder();

/// Folders of files, each once, in their order.
std::vector<std::string> foldersOf(std::span<const std::string> files);

} // namespace tessera::viewer
