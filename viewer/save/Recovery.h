#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/session/OpenScene.h"

namespace tessera::viewer {

/// A file that this process holds locked (flock) until it ends, however it ends: process numbers are used again.
class FileLock {
public:
    /// Makes the file, and waits for others that hold it. Throws std::runtime_error.
    explicit FileLock(const std::filesystem::path& file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Whether a process holds a file, which need not exist.
    static bool isHeld(const std::filesystem::path& file);

private:
    int descriptor_;
};

/// Keeps the edits of the open scene that are not saved in a file, which is left where the program ends without asking:
/// a scene file "tessera-NAME.json" in a locked folder of this run. Other windows keep theirs beside it.
class Recovery {
public:
    /// Below a folder that need not be there; none: nothing is kept.
    explicit Recovery(std::optional<std::filesystem::path> folder);

    /// The file that was written last of those that programs which have ended left; none where there is none.
    std::optional<std::filesystem::path> left() const;
    /// Deletes a file that was left, and its folder with the last one.
    static void discard(const std::filesystem::path& file);

    /// Whether keep() has something to do.
    bool isBehind(const OpenScene& open) const;
    /// Writes the edits of a scene, with its environment as it is seen, in the place of what was kept before; only
    /// deletes that where all edits are saved. Throws as saveScene() does, and as making the folder does.
    void keep(const OpenScene& open);
    /// Deletes what was kept: everything is saved, or to be lost.
    void forget();

private:
    /// The folder of this run, which is made and locked where it is not there yet. Throws std::runtime_error.
    const std::filesystem::path& ownFolder();

    struct Kept {
        std::filesystem::path file;
        std::string source;
        std::uint64_t edits = 0;
    };
    std::optional<std::filesystem::path> folder_;
    std::optional<Kept> kept_;
    std::filesystem::path own_;
    std::optional<FileLock> lock_; ///< of own_, while that is there
};

} // namespace tessera::viewer
