#pragma once
#include <string>

namespace tessera::validation {

/// Holds a folder against other processes as long as it lives: an exclusive flock() on the file bench.lock in it, which
/// says who holds it. The kernel releases the lock however the process ends, so that a file left behind by a killed
/// one holds nothing. Where there is no flock() nothing is held.
class FolderLock {
public:
    /// `folder` must exist. Throws std::runtime_error that names the holder when another process, or another lock of
    /// this one, holds it, and when no file can be made there.
    explicit FolderLock(const std::string& folder);
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock();

private:
    std::string file_;
    int descriptor_ = -1;
};

} // namespace tessera::validation
