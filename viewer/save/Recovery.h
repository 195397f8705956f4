#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/session/OpenScene.h"

namespace tessera::viewer {

/// A file locked by this process (flock) until it ends, for any reason. Process numbers would not do: they are reused.
class FileLock {
public:
    /// Creates and locks the file; waits for other processes that hold it. Throws std::runtime_error.
    explicit FileLock(const std::filesystem::path& file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Whether a process has locked a file, which need not exist.
    static bool isHeld(const std::filesystem::path& file);

private:
    int descriptor_;
};

/// Autosaves the unsaved edits of the open scene, in case the program ends unexpectedly: as a scene file
/// "tessera-NAME.json" in a locked folder of this run. Other windows have their own folders beside it.
class Recovery {
public:
    /// `folder` need not exist; none: nothing is autosaved.
    explicit Recovery(std::optional<std::filesystem::path> folder);

    /// The latest file left by programs that have ended; none if there is none.
    std::optional<std::filesystem::path> left() const;
    /// Deletes a file that was left, and its folder with the last one.
    static void discard(const std::filesystem::path& file);

    /// Whether keep() has something to do.
    bool isBehind(const OpenScene& open) const;
    /// Writes the edits of a scene, with its environment as displayed, and replaces the previous autosave; only deletes
    /// that if all edits are saved. Throws as saveScene() does, and if the folder cannot be created.
    void keep(const OpenScene& open);
    /// Deletes the autosave: its edits are saved or discarded.
    void forget();

private:
    /// The folder of this run, created and locked if it does not exist. Throws std::runtime_error.
    const std::filesystem::path& ownFolder();

    struct Kept {
        std::filesystem::path file;
        std::string source;
        std::uint64_t edits = 0;
    };
    std::optional<std::filesystem::path> folder_;
    std::optional<Kept> kept_;
    std::filesystem::path own_;
    std::optional<FileLock> lock_; ///< of own_, while that exists
};

} // namespace tessera::viewer
