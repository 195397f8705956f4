#pragma once
#include <string>

namespace tessera::validation {

/// Locks a folder against other processes during its lifetime: an exclusive flock() on its file bench.lock, which names
/// the holder. The kernel releases the lock however the process ends, so a file left by a killed process does not lock.
/// Does nothing on systems without flock().
class FolderLock {
public:
    /// `folder` must exist. Throws std::runtime_error if another process, or another lock of this one, holds it, naming
    /// the holder, and if the file cannot be created.
    explicit FolderLock(const std::string& folder);
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock();

private:
    std::string file_;
    int descriptor_ = -1;
};

} // namespace tessera::validation
