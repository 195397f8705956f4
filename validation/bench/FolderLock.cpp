#include "validation/bench/FolderLock.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#if __has_include(<sys/file.h>)
#include <array>
#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#define TESSERA_HAS_FLOCK 1
#else
#define TESSERA_HAS_FLOCK 0
#endif

namespace tessera::validation {

#if TESSERA_HAS_FLOCK

namespace {

[[noreturn]] void fail(const std::string& folder, int error) {
    throw std::runtime_error(fmt::format("cannot lock the folder '{}': {}; name another folder", folder,
                                         std::generic_category().message(error)));
}

std::string holderIn(int descriptor) {
    std::array<char, 256> text{};
    const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
    // Empty between the holder's lock and its first write.
    return length > 0 ? std::string(text.data(), std::size_t(length)) : "another process";
}

std::string ownName() {
    std::array<char, 128> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) return fmt::format("process {}", ::getpid());
    return fmt::format("process {} on {}", ::getpid(), host.data());
}

/// Whether the name still refers to the open file: its last holder may have deleted it before releasing the lock.
bool isFileNamed(const std::string& name, int descriptor) {
    struct stat opened {
    }, named{};
    return ::fstat(descriptor, &opened) == 0 && ::stat(name.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

/// Opens and locks the file; returns its descriptor.
int lockedFile(const std::string& folder, const std::string& file) {
    for (;;) {
        // Follows no link: the lock file is written and deleted, and a link's target may be a user's file.
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor < 0) fail(folder, errno);
        if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const int error = errno;
            const std::string holder = error == EWOULDBLOCK ? holderIn(descriptor) : "";
            ::close(descriptor);
            if (error == EINTR) continue;
            if (error != EWOULDBLOCK) fail(folder, error);
            throw std::runtime_error(fmt::format(
                "{} is in use by another bench, {}; wait for its end, or name another folder", folder, holder));
        }
        if (isFileNamed(file, descriptor)) return descriptor;
        ::close(descriptor);
    }
}

} // namespace

FolderLock::FolderLock(const std::string& folder)
    : file_((std::filesystem::path(folder) / "bench.lock").string()), descriptor_(lockedFile(folder, file_)) {
    const std::string name = ownName();
    // Informational: the lock holds without the name.
    if (::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, name.data(), name.size(), 0) < 0) return;
}

FolderLock::~FolderLock() {
    if (descriptor_ < 0) return;
    ::unlink(file_.c_str()); // first, so that no process can lock a file that is about to be deleted
    ::close(descriptor_);
}

#else

FolderLock::FolderLock(const std::string&) {}
FolderLock::~FolderLock() = default;

#endif

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

} // namespace tessera::validation
